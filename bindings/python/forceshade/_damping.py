# SPDX-License-Identifier: BSD-3-Clause
"""Damping: forces that know speed."""

from __future__ import annotations

import operator
from dataclasses import InitVar, dataclass, fields
from fractions import Fraction
from math import frexp, inf
from typing import Optional

import numpy as np
import numpy.typing as npt

from . import _arrays, _forceshade
from ._arrays import Floats, Rounding

DAMPING_STATE = np.dtype(
    [("has_position", np.uint8), ("periods", np.uint8), ("position", np.float32, (3,)), ("velocity", np.float32, (3,))], align=True
)
"""The type of the states of Damping.advance(): what DampingState has, as numbers. One that is 0 begins a path."""

Periods = Optional[npt.ArrayLike]


def share_of(time: float, rate: float) -> float:
    """1/(1 + rate time), rounded once to binary32."""
    exact = 1 / (1 + Fraction(repr(rate)) * Fraction(repr(time)))
    unit = Fraction(2) ** (frexp(float(exact))[1] - 24)
    return float(round(exact / unit) * unit)


def periods_of(periods: Periods, shape: tuple[int, ...]) -> npt.NDArray[np.uint32] | None:
    """One for each position."""
    if periods is None:
        return None
    array = _arrays.array_of(periods, "periods")
    if array.dtype.kind not in "iu":
        raise TypeError(f"periods are of type {array.dtype}; expected integers")
    if (array < 0).any() or (array >= 2**32).any():
        raise ValueError("periods: expected numbers from 0 to 4294967295")
    if array.shape not in ((), shape):
        raise ValueError(f"periods have the shape {array.shape}; expected {shape}, or one number")
    return np.array(np.broadcast_to(array, shape), np.uint32, order="C")


@dataclass(frozen=True)
class DampingState:
    """All that damping remembers of a path. At the beginning there is no position, and all else is 0."""

    position: tuple[float, float, float] | None = None
    """mm: the last valid one, as it is read."""
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """mm/s."""
    periods: int = 0
    """Since that position; 17 stands for all above 16."""


def read_state(its: _forceshade.Session | _forceshade.Scene) -> DampingState:
    has_position, position, velocity, periods = its._damping_state()
    return DampingState(tuple(position) if has_position else None, tuple(velocity), periods)  # type: ignore[arg-type]


@dataclass(frozen=True)
class Damping:
    """Damping behind any renderer (docs/damping.md): the force that it gave, the positions, and the speed of the hand.

    rate: r, Hz, of the device, whose periods the ticks are: 1 to 2^17.
    damping: B, N s/mm along the force: 0, or 2^-20 to 16; 1 N s/mm is 1000 N s/m.
    drag: B_t, N s/mm across the force: 0, or 2^-20 to 16.
    share: that of the new velocity in the filter: 2^-10 to 1, which is no filter.
    time: in its place the filter's time constant, s: share is 1/(1 + rate time).
    most: S, the most by which damping lengthens the force: 1 to 1024, or infinity.
    full_at: F_0, N, the force from which on drag is full: 2^-10 to 1024.

    They are rounded to binary32 without a word. With damping and drag 0, forces stay what they are. It does not change; two with the
    same numbers are equal. Raises ValueError for a number outside its range, TypeError for what is none.

    >>> import forceshade
    >>> wall = forceshade.Law("wall", stiffness=0.5)
    >>> session = forceshade.Session(wall, damping=Damping(rate=1000, damping=0.001))
    >>> [session.step(0, 0, z)[2] for z in (0, -0.25, -0.5, -0.5)]    # inwards at 250 mm/s, and at rest
    [0.0, 0.25, 0.5, 0.25]
    """

    rate: float
    damping: float = 0.0
    drag: float = 0.0
    share: float = 1.0
    most: float = 2.0
    full_at: float = 0.25
    time: InitVar[float | None] = None

    def __post_init__(self, time: float | None) -> None:
        given = {field.name: getattr(self, field.name) for field in fields(self)}
        for name, value in {**given, "time": 0.0 if time is None else time}.items():
            _arrays.real_of(value, name)
        if time is not None:
            if given["share"] != 1:
                raise ValueError("share and time: expected one of them")
            if not 0 <= time < inf:
                raise ValueError(f"time is {time} s; expected 0 or more")
            if 1 <= given["rate"] < inf:  # any other is refused below
                given["share"] = share_of(float(time), float(given["rate"]))
        for name, value in given.items():
            object.__setattr__(self, name, float(str(np.float32(_arrays.narrow_of(value, name)))))
        _forceshade.check_damping(self._numbers())

    def _numbers(self) -> tuple[float, ...]:
        return self.rate, self.share, self.damping, self.most, self.drag, self.full_at

    def _read(
        self, positions: npt.ArrayLike, forces: npt.ArrayLike, out: Floats | None, status: object, rounding: Rounding
    ) -> tuple[Floats, Floats, npt.NDArray[np.uint8] | None]:
        """Positions, a copy of the forces or `out` with them, and the statuses."""
        at, springs = _arrays.as_positions(positions, rounding), _arrays.as_floats(forces, "forces", rounding)
        if springs.shape != at.shape:
            raise ValueError(f"forces have the shape {springs.shape}; expected that of the positions, {at.shape}")
        to = _arrays.output(out, springs)
        said = _arrays.statuses(status, at, to)
        if _arrays.shares(to, at):
            raise ValueError("out and positions overlap; expected memory of its own, or the forces")
        to[...] = springs
        return at, to, said

    def steps(
        self,
        positions: npt.ArrayLike,
        forces: npt.ArrayLike,
        *,
        state: npt.NDArray[np.void] | None = None,
        periods: Periods = None,
        out: Floats | None = None,
        status: npt.NDArray[np.uint8] | None = None,
        rounding: Rounding = None,
    ) -> Floats:
        """The damped forces (N) of one path, from the forces that any renderer gave at its positions (mm), one after the other.

        positions, forces: float32 of the shape (..., 3). periods: an array of integers (...), or one for all: those since the
        position before, 1 where none was missed; 0 answers the same reading of a device again.
        state: an array of one DAMPING_STATE: where the path is, and afterwards what the last tick left. Without it, a path begins.
        status: a uint8 array (...) with the renderer's statuses, and afterwards those of the damped forces. Without it, a force where
        the renderer could not decide is damped as any other.
        out: for the damped forces; it may be `forces` itself. rounding, and what is raised, are those of Subject.forces().

        >>> import forceshade
        >>> at = [[0, 0, 0], [0, 0, -0.25], [0, 0, -0.5]]
        >>> Damping(rate=1000, damping=0.0005).steps(at, forceshade.Law("wall", stiffness=0.5).forces(at))[:, 2]
        array([0.   , 0.25 , 0.375], dtype=float32)
        """
        at, to, said = self._read(positions, forces, out, status, rounding)
        one_path = np.zeros((1, 3), np.float32)
        kept = _arrays.states(np.zeros(1, DAMPING_STATE) if state is None else state, DAMPING_STATE, one_path, at, to, said)
        _forceshade.damp_path(self._numbers(), kept, periods_of(periods, at.shape[:-1]), at, to, said)
        return to

    def advance(
        self,
        states: npt.NDArray[np.void],
        positions: npt.ArrayLike,
        forces: npt.ArrayLike,
        *,
        periods: Periods = None,
        out: Floats | None = None,
        status: npt.NDArray[np.uint8] | None = None,
        rounding: Rounding = None,
        threads: int = 1,
    ) -> Floats:
        """The damped forces (N) of one tick of each of many paths, as Subject.advance() gives their forces without damping.

        states: an array of type DAMPING_STATE of the shape of the positions without the last axis, without gaps: where each path is,
        and afterwards what the tick left. numpy.zeros(n, forceshade.DAMPING_STATE) begins n paths.
        The other arguments are those of steps(); threads: that of Subject.advance(). Each path has the forces of a damped Session of
        its own, bit for bit.
        """
        at, to, said = self._read(positions, forces, out, status, rounding)
        its = _arrays.states(states, DAMPING_STATE, at, at, to, said)
        of = _arrays.count_of_threads(threads)
        _forceshade.damp_paths(self._numbers(), its, periods_of(periods, at.shape[:-1]), at, to, said, of)
        return to

    def reference_steps(
        self,
        positions: npt.ArrayLike,
        forces: npt.ArrayLike,
        *,
        periods: Periods = None,
        status: npt.NDArray[np.uint8] | None = None,
        rounding: Rounding = None,
    ) -> Floats:
        """The same by the definition, in rational numbers, which shares nothing with what steps() computes; slow. From the beginning of a
        path. With Subject.reference_forces() as its forces, nothing of the fast side is left."""
        at, to, said = self._read(positions, forces, None, status, rounding)
        _forceshade.damp_exactly(self._numbers(), periods_of(periods, at.shape[:-1]), at, to, said)
        return to


def numbers_of(damping: Damping | None) -> tuple[float, ...] | None:
    if damping is not None and not isinstance(damping, Damping):
        raise TypeError(f"damping: expected a Damping, got {damping!r}")
    return None if damping is None else damping._numbers()


def numbers_of_state(state: DampingState | None, damping: Damping | None) -> _forceshade._DampingState | None:
    """The numbers of the state from which a session with this damping is to go on; None for one without."""
    if state is not None and (damping is None or not isinstance(state, DampingState)):
        raise TypeError(f"damping_state: expected {'none without damping' if damping is None else 'a DampingState'}, got {state!r}")
    if damping is None:
        return None
    its = state or DampingState()
    try:
        position, velocity = (tuple(map(float, three)) for three in (its.position or (0, 0, 0), its.velocity))
        if len(position) == len(velocity) == 3:
            periods = operator.index(its.periods)
            return its.position is not None, position, velocity, periods if 0 <= periods < 255 else 255
    except (TypeError, ValueError):
        pass
    raise TypeError(f"damping_state: expected one that a session gave, got {its}")
