# SPDX-License-Identifier: BSD-3-Clause
"""Fixtures of the tests of the package for Python."""

import os
import pathlib
import signal

import numpy as np
import pytest

import forceshade

ROOT = pathlib.Path(__file__).resolve().parents[3]
GOLDEN = ROOT / "tests" / "golden"
signal.signal(signal.SIGINT, signal.default_int_handler)  # which a script that starts the tests in the background ignores


def same_bits(a, b):
    return np.array_equal(np.asarray(a, np.float32).view(np.uint32), np.asarray(b, np.float32).view(np.uint32))


def command():
    """The command of this build, for tests of its files."""
    path = os.environ.get("FORCESHADE_COMMAND", "")
    if not os.access(path, os.X_OK):
        pytest.skip("the command forceshade is not built: ninja forceshade")
    return path


@pytest.fixture
def bump():
    return forceshade.Law("bump-2p", radius=15.24, width=25.4, stiffness=0.5)


@pytest.fixture
def wall():
    return forceshade.Law("wall", stiffness=0.5)


TETRAHEDRON = (
    np.array([[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]], np.float32),
    np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], np.uint32),
)


@pytest.fixture
def tetrahedron():
    return forceshade.Mesh(*TETRAHEDRON, stiffness=0.5, shading="none")


def positions(count=4096, seed=1):
    """Positions around the thesis's bump, some on its surface's height and some invalid."""
    draw = np.random.default_rng(seed)
    at = draw.uniform([-20, -20, -8], [20, 20, 12], (count, 3)).astype(np.float32)
    at[::997] = np.nan
    at[::1009, 0] = 20000
    return at
