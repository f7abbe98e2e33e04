# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: one path of the hand each, through objects that move."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from . import _arrays, _forceshade
from ._arrays import Floats, Rounding
from ._damping import Damping, DampingState, numbers_of, numbers_of_state, periods_of, read_state
from ._subject import Status, Subject, expect_damping


class Pose(NamedTuple):
    """The pose of an object: its point a is at R a + translation in the world, R the exact rotation of the quaternion."""

    translation: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """mm, each within 10 000."""
    rotation: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    """w, x, y, z, of any length: each 0 or of a size from 2^-30 to 2, and not all 0."""


class Scene(_forceshade.Scene):
    """One path of the hand through objects that are placed anew in every step (docs/scenes.md).

    objects: 1 to 32 laws, height maps and meshes, of which one may come several times. The force is the exact sum of theirs,
    turned into the world's axes, rounded once. For one thread at a time, as a Session is.
    damping: of this force, by the speed of the hand in the world (docs/damping.md). It is needed, and counts alone, where the file
    of an object has the table [damping].

    >>> import forceshade
    >>> wall = forceshade.Law("wall", stiffness=0.5)
    >>> scene = Scene([wall, wall])
    >>> scene.step((-1, 0, -2), [Pose(), Pose(rotation=(1, 0, 1, 0))])    # the second one on its side
    array([0.5, 0. , 1. ], dtype=float32)
    """

    def __init__(self, objects: Sequence[Subject], *, damping: Damping | None = None) -> None:
        subjects = list(objects)
        for one in subjects:
            if not isinstance(one, Subject):
                raise TypeError(f"expected objects that are a Law, HeightMap or Mesh, got {type(one).__name__}")
        expect_damping(subjects, damping)
        super().__init__(subjects, numbers_of(damping))
        self._objects, self._damping = tuple(subjects), damping

    def __reduce__(self) -> str:
        raise TypeError("a Scene cannot be pickled or copied; expected a new one")

    def __repr__(self) -> str:
        return f"<Scene of {', '.join(repr(one) for one in self._objects)}>"

    @property
    def objects(self) -> tuple[Subject, ...]:
        """The subjects that it renders."""
        return self._objects

    @property
    def damping(self) -> Damping | None:
        """The damping behind it."""
        return self._damping

    @property
    def damping_state(self) -> DampingState | None:
        """What its damping remembers after the last step; None without damping."""
        return None if self._damping is None else read_state(self)

    def resume_damping(self, state: DampingState) -> None:
        """Lets its damping go on from a state."""
        its = numbers_of_state(state, self._damping)
        if its is not None:
            self._resume_damping(its)

    @property
    def status(self) -> Status:
        """The status of the last position."""
        return Status(self._status)

    def step(
        self, position: npt.ArrayLike, poses: Sequence[Pose] | npt.ArrayLike, *, periods: int = 1, rounding: Rounding = None
    ) -> Floats:
        """The force (N) at the next position of the hand (mm, in the world), an array (3,).

        poses: one Pose for each object, or an array (n, 7): translation in mm and quaternion w, x, y, z. A position or pose outside
        its domain gives no force, and the status INVALID. periods: those since the step before, for damping.
        """
        at = _arrays.as_positions(position, rounding)
        if at.shape != (3,):
            raise ValueError(f"position has the shape {at.shape}; expected (3,): x, y, z in mm")
        if isinstance(poses, Sequence):
            poses = [(*pose.translation, *pose.rotation) if isinstance(pose, Pose) else pose for pose in poses]
        placed = _arrays.as_floats(poses, "poses", rounding)
        if placed.shape != (len(self._objects), 7):
            raise ValueError(f"poses have the shape {placed.shape}; expected ({len(self._objects)}, 7): one for each object")
        since = periods_of(periods, ())
        return np.array(self._step(at.tolist(), placed, 1 if since is None else int(since)), np.float32)

    @property
    def forces(self) -> Floats:
        """The force (N) of each object in the last step, in the object's own axes and without damping: an array (n, 3)."""
        return np.array(self._forces(), np.float32)
