# SPDX-License-Identifier: BSD-3-Clause
"""Sessions: one path of the hand each."""

from __future__ import annotations

import enum
import operator
from dataclasses import astuple, dataclass
from fractions import Fraction

import numpy as np
import numpy.typing as npt

from . import _arrays, _forceshade
from ._arrays import Floats, Rounding
from ._damping import Damping, DampingState, Periods, numbers_of, numbers_of_state, periods_of, read_state
from ._points import point_on
from ._subject import ANSWER, Status, Subject, expect_damping
from ._subjects import Mesh


class Place(enum.IntEnum):
    """The place of a god-object."""

    NOWHERE = 0
    """No valid position has come yet."""
    IN_THE_OPEN = 1
    AT_VERTEX = 2
    ON_EDGE = 3
    IN_TRIANGLE = 4


class Meeting(enum.IntEnum):
    """What else a god-object's place lies in, on a mesh that is not regular (docs/soups.md)."""

    NOTHING = 0
    """The place says all."""
    LINE = 1
    """The line of triangles (i, j), where the weight of corner further[0] of i is parameter[0]."""
    EDGE = 2
    """Edge (a, b) and edge `further` meet."""
    TRIANGLE = 3
    """Edge (a, b) and triangle further[0] meet."""
    TRIANGLES = 4
    """Triangles (i, j) and further[0] meet."""
    FOOT_IN_TRIANGLE = 5
    """The point of triangle i's plane that is nearest to `position`."""
    FOOT_ON_EDGE = 6
    """That of edge (a, b)."""
    FOOT_ON_LINE = 7
    """That of the line of triangles (i, j), whose grid is that of corner further[0] of i."""


@dataclass(frozen=True)
class State:
    """All that a session remembers of its path: the god-object of a mesh, exact and the same on every machine.

    A law or a height map remembers nothing, which is Place.NOWHERE. What a place does not use is 0, and so are the last three on a
    regular mesh.
    """

    place: Place = Place.NOWHERE
    side: int = 0
    """The side of the surface: 0 front, 1 back."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """mm; in the open, and of the hand whose foot it is."""
    index: tuple[int, int] = (0, 0)
    """Vertex v: (v, 0). Edge from a to b: (a, b), a < b. Triangle i: (i, 0), or (i, j)."""
    parameter: tuple[int, int] = (0, 0)
    """In units of 2^-24. Edge: a + m (b - a): (m, 0). Triangle: a + k (b - a) + l (c - a): (k, l). Line: (k, 0)."""
    slipping: bool = False
    """Friction has let it slip, and does not hold it yet."""
    meeting: Meeting = Meeting.NOTHING
    further: tuple[int, int] = (0, 0)
    cell: tuple[int, int] = (0, 0)
    """The name of the cell, with `side`: a triangle, and the number of its piece."""


class Session(_forceshade.Session):
    """One path of the hand through a subject: each force follows from the positions so far.

    damping: behind the subject (docs/damping.md); step() is then one period of its rate. One whose file has the table [damping]
    needs it: subject.damping_at(rate) for what the file says.

    For one thread at a time: a second one that uses it meanwhile gets forceshade.Error.

    >>> import forceshade
    >>> session = Session(forceshade.Law("wall", stiffness=0.5))
    >>> session.step(0, 0, -2), session.status.name
    ((0.0, 0.0, 1.0), 'CONTACT')
    """

    def __init__(self, subject: Subject, *, damping: Damping | None = None) -> None:
        if not isinstance(subject, Subject):
            raise TypeError(f"expected a Law, HeightMap or Mesh, got {type(subject).__name__}")
        expect_damping([subject], damping)
        super().__init__(subject, numbers_of(damping))
        self._subject, self._damping = subject, damping

    def __reduce__(self) -> str:
        raise TypeError("a Session cannot be pickled or copied; expected a new one, and resume() with the state of this one")

    def __repr__(self) -> str:
        return f"<Session of {self._subject!r}>"

    @property
    def subject(self) -> Subject:
        """The subject that it renders."""
        return self._subject

    @property
    def damping(self) -> Damping | None:
        """The damping behind it."""
        return self._damping

    @property
    def status(self) -> Status:
        """The status of the last position."""
        return Status(self._status)

    def steps(
        self,
        positions: npt.ArrayLike,
        *,
        out: Floats | None = None,
        status: npt.NDArray[np.uint8] | None = None,
        periods: Periods = None,
        rounding: Rounding = None,
    ) -> Floats:
        """The forces (N) at the next positions of the path (mm), one after the other; arguments as of Subject.forces().

        periods: for damping, as of Damping.steps(): those since the position before, an array of integers, or one for all.
        """
        at = _arrays.as_positions(positions, rounding)
        to = _arrays.output(out, at)
        self._steps(at, to, _arrays.statuses(status, at, to), periods_of(periods, at.shape[:-1]))
        return to

    def answers(self, positions: npt.ArrayLike, *, periods: Periods = None, rounding: Rounding = None) -> npt.NDArray[np.void]:
        """The same steps, with the statuses: a structured array of type ANSWER."""
        at = _arrays.as_positions(positions, rounding)
        made = np.empty(at.shape[:-1], ANSWER)
        self._steps(at, made["force"], made["status"], periods_of(periods, at.shape[:-1]))
        return made

    def reset(self) -> None:
        """Goes back to the beginning of a path."""
        self.resume(State())

    @property
    def state(self) -> State:
        """Its memory after the last step."""
        place, side, slipping, position, index, parameter, meeting, further, cell = self._state()
        lists = tuple(position), tuple(index), tuple(parameter)
        return State(Place(place), side, *lists, slipping, Meeting(meeting), tuple(further), tuple(cell))  # type: ignore[arg-type]

    @property
    def damping_state(self) -> DampingState | None:
        """What its damping remembers after the last step; None without damping."""
        return None if self._damping is None else read_state(self)

    @property
    def point(self) -> tuple[float, float, float] | None:
        """The god-object's point after the last step, mm: each coordinate the binary64 number nearest to the exact one.
        None before a valid position has come, and for a law or a height map, which have no god-object.

        >>> import forceshade
        >>> session = Session(forceshade.Mesh([[-8, -8, 0], [8, -8, 0], [8, 8, 0]], [[0, 1, 2]]))
        >>> session.step(3, 1, 2), session.step(3, 1, -2), session.point
        ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (3.0, 1.0, 0.0))
        """
        at = self.state
        if not isinstance(self._subject, Mesh) or at.place == Place.NOWHERE:
            return None
        if at.place == Place.IN_THE_OPEN:
            return at.position
        position, size = [Fraction(x) for x in at.position], at.place - 1
        x, y, z = map(float, point_on(self._subject, at.meeting, at.index, at.parameter, at.further, position, size))
        return x, y, z

    def resume(self, state: State, damping_state: DampingState | None = None) -> None:
        """Goes on from a state of the same subject, and its damping from a state of its own, or from the beginning. A state that is
        invalid for this mesh, or that no tick leaves, counts as that of a beginning, which `state` then is."""
        if not isinstance(state, State):
            raise TypeError(f"expected the state of a session, got {type(state).__name__}")
        place, side, position, index, parameter, slipping, meeting, further, cell = astuple(state)
        speed = numbers_of_state(damping_state, self._damping)
        try:
            numbers = list(position), list(index), list(parameter), operator.index(meeting), list(further), list(cell)
            self._resume((operator.index(place), operator.index(side), bool(slipping), *numbers))
        except TypeError:
            raise TypeError(f"state: expected one that a session gave, got {state}") from None
        if speed is not None:
            self._resume_damping(speed)
