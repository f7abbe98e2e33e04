# SPDX-License-Identifier: BSD-3-Clause
"""The members of every subject, whatever it renders."""

from __future__ import annotations

import enum
import numbers
import os
from collections.abc import Iterable
from typing import Any, Callable, NamedTuple, SupportsFloat, Union

import numpy as np
import numpy.typing as npt

from . import _arrays, _exact, _forceshade
from ._arrays import Floats, Rounding
from ._damping import Damping

Quantity = Union[SupportsFloat, str]
File = Union[str, "os.PathLike[str]"]


class Status(enum.IntEnum):
    """The status of a position."""

    FREE = 0
    """Outside: no force."""
    CONTACT = 1
    """Inside."""
    INVALID = 2
    """A coordinate is NaN or beyond 10 000 mm: no force."""
    UNFINISHED = 3
    """A contact whose god-object used up the moves or looks of one tick; the next tick goes on from there. On meshes alone."""


ANSWER = np.dtype([("force", np.float32, (3,)), ("status", np.uint8)], align=True)
"""The type of what answers() gives: `force` in N, and `status`, a number of Status."""

STATE = np.dtype(
    [
        ("place", np.uint8),
        ("side", np.uint8),
        ("slipping", np.uint8),
        ("meeting", np.uint8),
        ("position", np.float32, (3,)),
        ("index", np.uint32, (2,)),
        ("parameter", np.uint32, (2,)),
        ("further", np.uint32, (2,)),
        ("cell", np.uint32, (2,)),
    ],
    align=True,
)
"""The type of the states of advance(): what State has, as numbers. One that is 0 begins a path."""


class Identity(NamedTuple):
    """The identity of a subject, as certificates and recordings have it."""

    kind: str
    """"law", "height map" or "mesh"."""
    name: str
    """That of the law, or of the file; "samples" or "triangles" where there was no file."""
    parameters: dict[str, float | str]
    """By their keys, which end in their units: "stiffness_N_per_mm"."""
    digest: str
    """SHA-256 of what name and parameters leave out, in hexadecimal digits; empty for a law."""


def text_of(value: object, name: str, what: str) -> str:
    if isinstance(value, str):
        return word_of(value, name)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name}: expected a number or a text such as {what}, got {value!r}")
    try:
        return _arrays.decimal_of(value)
    except OverflowError:
        raise ValueError(f"{name}: expected a number that binary64 holds, got one of more than 300 digits") from None


def length_of(value: Quantity, name: str) -> float:
    """In mm: the binary32 number nearest to what stands there, as the command reads it."""
    return _forceshade.length(name, text_of(value, name, '"600mil"'))


def stiffness_of(value: Quantity) -> float:
    return _forceshade.stiffness("stiffness", text_of(value, "stiffness", '"500N/m"'))


def expect_damping(subjects: Iterable[Subject], damping: Damping | None) -> None:
    """Refuses to leave out the damping of a file."""
    if damping is None and any(subject._is_damped for subject in subjects):
        raise ValueError("damping: a subject's file has the table [damping]; expected its damping_at(rate), or another Damping")


def word_of(value: object, name: str) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{name}: expected a word, got {value!r}")
    if not value.isascii() and value.encode("utf-8", "ignore").decode() != value:
        raise ValueError(f"{name}: expected characters that UTF-8 has, got {value!r}")
    return value


def path_of(file: object) -> str:
    """Its name, where it can be opened; else the system's OSError."""
    path = os.fsdecode(os.fspath(file))  # type: ignore[call-overload]
    with open(path, "rb"):
        return path


def remade(digest: str, make: Callable[..., Subject], arguments: tuple[Any, ...], options: dict[str, Any]) -> Subject:
    """A pickled subject, made again. Raises Error where a file that it was read from has changed since."""
    made = make(*arguments, **options)
    if made.digest != digest:
        raise _forceshade.Error(f"{arguments[0]} has changed since this was pickled: expected the digest {digest}, got {made.digest}")
    return made


class Subject(_forceshade.Subject):
    """A law, a height map or a mesh: Law, HeightMap and Mesh make one. It does not change; threads may share it.

    Two are equal where each force of theirs is: of the same kind, parameters and digest, whatever files they came from. Pickled,
    one takes its arrays with it, and of files their paths.
    """

    _reference_of: _forceshade.Reference | None = None
    _made_by: tuple[Callable[..., Subject], tuple[Any, ...], dict[str, Any]]

    @property
    def identity(self) -> Identity:
        """Kind, name, parameters and digest, as certificates and recordings have them."""
        return Identity(self._kind, self._name, self._parameters, self._digest)

    @property
    def digest(self) -> str:
        """SHA-256 of all numbers of a height map or mesh, in hexadecimal digits; empty for a law."""
        return self._digest

    @property
    def stiffness(self) -> float:
        """K, N/mm."""
        return float(self._parameters["stiffness_N_per_mm"])

    def damping_at(self, rate: float) -> Damping:
        """The damping of its file, the table [damping], at a rate (Hz); off where it has none. For the `damping` of a Session."""
        rate, share, damping, most, drag, full_at = self._damping_at(Damping(rate).rate)
        return Damping(rate=rate, share=share, damping=damping, most=most, drag=drag, full_at=full_at)

    def forces(
        self,
        positions: npt.ArrayLike,
        *,
        out: Floats | None = None,
        status: npt.NDArray[np.uint8] | None = None,
        rounding: Rounding = None,
        threads: int = 1,
    ) -> Floats:
        """The forces (N) at positions (mm), each the binary32 number nearest to the exact one.

        positions: float32 of the shape (..., 3), wherever it lies in memory: nothing is copied. Numbers of other types, and
        lists, are rounded to float32 first, with a RoundingWarning where that changes one; with rounding="nearest" without it.
        out: a float32 array of the same shape, into which the forces go; it may be `positions` itself.
        status: a uint8 array of the shape of the positions without the last axis, into which a number of Status goes for each.
        threads: that share the work, where there are many positions: at most one for each 1024. The forces are the same bits.

        Returns out, or a new array. Raises TypeError for what are no numbers, ValueError for a wrong shape, and Error for
        a mesh, whose forces depend on the path.

        >>> import numpy, forceshade
        >>> wall = forceshade.Law("wall", stiffness=0.5)
        >>> wall.forces(numpy.array([[0, 0, -2], [0, 0, 1]], numpy.float32))
        array([[0., 0., 1.],
               [0., 0., 0.]], dtype=float32)
        """
        at = _arrays.as_positions(positions, rounding)
        to = _arrays.output(out, at)
        self._forces(at, to, _arrays.statuses(status, at, to), _arrays.count_of_threads(threads))
        return to

    def advance(
        self,
        states: npt.NDArray[np.void],
        positions: npt.ArrayLike,
        *,
        out: Floats | None = None,
        status: npt.NDArray[np.uint8] | None = None,
        rounding: Rounding = None,
        threads: int = 1,
    ) -> Floats:
        """One tick of each of many paths, as of the hands in a learning loop: the forces (N) at the next positions (mm).

        states: an array of type STATE of the shape of the positions without the last axis, without gaps: where each path is,
        and afterwards what the tick left. numpy.zeros(n, forceshade.STATE) begins n paths; writing 0 into some begins these
        again; a copy keeps them. A state that is invalid for this mesh counts as that of a beginning. Of a law or a height map,
        which remember nothing, they stay as they are.
        The other arguments, and what is raised, are those of forces().

        Each path has the forces that a Session of its own gives, bit for bit.

        >>> import numpy, forceshade
        >>> floor = forceshade.Mesh([[-9, -9, 0], [9, -9, 0], [9, 9, 0]], [[0, 1, 2]], stiffness=0.5)
        >>> states = numpy.zeros(2, forceshade.STATE)
        >>> above = floor.advance(states, [[3, 0, 1], [4, 1, 2]])
        >>> floor.advance(states, [[3, 0, -2], [4, 1, 1]])
        array([[0., 0., 1.],
               [0., 0., 0.]], dtype=float32)
        >>> [forceshade.Place(place).name for place in states["place"]]
        ['IN_TRIANGLE', 'IN_THE_OPEN']
        """
        at = _arrays.as_positions(positions, rounding)
        to = _arrays.output(out, at)
        said = _arrays.statuses(status, at, to)
        self._advance(_arrays.states(states, STATE, at, to, said), at, to, said, _arrays.count_of_threads(threads))
        return to

    def answers(self, positions: npt.ArrayLike, *, rounding: Rounding = None) -> npt.NDArray[np.void]:
        """The forces with their statuses: a structured array of type ANSWER, of the positions' shape without the last axis.

        >>> import forceshade
        >>> answers = forceshade.Law("wall", stiffness=0.5).answers([[0, 0, -2], [0, 0, 1], [0, 0, 20000]])
        >>> [forceshade.Status(status).name for status in answers["status"]]
        ['CONTACT', 'FREE', 'INVALID']
        """
        at = _arrays.as_positions(positions, rounding)
        made = np.empty(at.shape[:-1], ANSWER)
        self._forces(at, made["force"], made["status"])
        return made

    def reference(
        self, x: SupportsFloat, y: SupportsFloat, z: SupportsFloat, *, digits: int = 50, rounding: Rounding = None
    ) -> _exact.ExactForce:
        """The exact force (N) at one position (mm) by its definition, which shares nothing with what force() computes; slow.

        Each component is a fractions.Fraction where it is a rational number (of a denominator up to 10^40), else a text of
        `digits` correctly rounded significant decimal digits (1 to 10 000).

        >>> import forceshade
        >>> exact = forceshade.Law("bump-2p", radius=15.24, width=25.4, stiffness=0.5).reference(3, 0, -0.5, digits=30)
        >>> exact.x, exact.y
        ('1.34906431533465554429044623806', Fraction(0, 1))
        """
        return _exact.force_of(self._reference(), x, y, z, digits, rounding)

    def reference_forces(self, positions: npt.ArrayLike, *, rounding: Rounding = None) -> npt.NDArray[np.void]:
        """The exact forces, rounded once to binary32, with their statuses, as answers() gives them; 100 000 a
        second of a height map, a million of a law.

        The positions of a mesh are a path in their order, from its beginning.
        """
        at = _arrays.as_positions(positions, rounding)
        made = np.empty(at.shape[:-1], ANSWER)
        self._reference().rounded(at, made["force"], made["status"])
        return made

    def __copy__(self) -> Subject:
        return self  # it does not change

    def __deepcopy__(self, memo: object) -> Subject:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return remade, (self._digest, *self._made_by)

    def _what_it_is(self) -> tuple[Any, ...]:
        name = self._name if self._kind == "law" else ""  # a map's or mesh's is that of a file
        return self._kind, name, tuple(sorted(self._parameters.items())), self._digest

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Subject):
            return NotImplemented
        return self._what_it_is() == other._what_it_is()

    def __hash__(self) -> int:
        return hash(self._what_it_is())

    def _reference(self) -> _forceshade.Reference:
        if self._reference_of is None:
            self._reference_of = _forceshade.Reference(self)
        return self._reference_of
