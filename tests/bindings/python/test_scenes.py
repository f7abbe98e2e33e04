# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: forces of objects that move, and what is refused."""

import copy

import numpy as np
import pytest

import forceshade
from forceshade import Pose, Scene, Status

WALL = forceshade.Law("wall", stiffness=0.5)
ON_ITS_SIDE = Pose(rotation=(1, 0, 1, 0))  # z becomes x


def test_adds_the_forces_of_its_objects():
    scene = Scene([WALL, WALL])
    assert scene.step((-1, 0, -2), [Pose(), ON_ITS_SIDE]).tolist() == [0.5, 0, 1]
    assert scene.status is Status.CONTACT
    assert scene.forces.tolist() == [[0, 0, 1], [0, 0, 0.5]]
    assert scene.objects == (WALL, WALL)


def test_takes_poses_as_an_array_too():
    one, other = Scene([WALL]), Scene([WALL])
    pose = Pose((0, 0, 2), (1, 0, 0, 0))
    array = np.array([[0, 0, 2, 1, 0, 0, 0]], np.float32)
    assert one.step((0, 0, 1), [pose]).tolist() == other.step((0, 0, 1), array).tolist() == [0, 0, 0.5]


def test_an_invalid_pose_gives_no_force():
    scene = Scene([WALL])
    assert scene.step((0, 0, -1), [Pose(rotation=(0, 0, 0, 0))]).tolist() == [0, 0, 0]
    assert scene.status is Status.INVALID


def test_refuses_what_is_wrong():
    with pytest.raises(ValueError, match="number of objects is 0; expected 1 to 32"):
        Scene([])
    with pytest.raises(TypeError, match="expected objects that are a Law, HeightMap or Mesh, got str"):
        Scene(["wall"])
    scene = Scene([WALL, WALL])
    with pytest.raises(ValueError, match=r"shape \(1, 7\); expected \(2, 7\)"):
        scene.step((0, 0, 0), [Pose()])
    with pytest.raises(ValueError, match=r"shape \(2, 3\)"):
        scene.step([(0, 0, 0), (0, 0, 0)], [Pose(), Pose()])
    with pytest.raises(TypeError, match="cannot be pickled or copied"):
        copy.copy(scene)
