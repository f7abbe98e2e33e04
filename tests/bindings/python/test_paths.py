# SPDX-License-Identifier: BSD-3-Clause
"""Batches that threads share, and many paths over one subject."""

import numpy as np
import pytest
from conftest import positions, same_bits

import forceshade


@pytest.mark.parametrize("threads", [2, 3, 1000])
def test_threads_give_the_same_bits(bump, threads):
    at = positions(7000)
    status, shared = np.zeros(7000, np.uint8), np.zeros(7000, np.uint8)
    expected = bump.forces(at, status=status)
    assert same_bits(bump.forces(at, status=shared, threads=threads), expected)
    assert (status == shared).all() and set(status) == {0, 1, 2}
    every_other = at.reshape(70, 100, 3)[::2, ::-1]
    assert same_bits(bump.forces(every_other, threads=threads), expected.reshape(70, 100, 3)[::2, ::-1])
    assert same_bits(bump.forces(at, out=at, threads=threads), expected)


def walks(shape, ticks):
    """A random walk for each path near the tetrahedron, now and then out of the domain."""
    random = np.random.default_rng(3)
    at = np.full((*shape, 3), 3, np.float32)
    for _ in range(ticks):
        at = (np.clip(at, -1, 3) + random.uniform(-1, 1, at.shape)).astype(np.float32)
        at[random.random(shape) < 0.01, 1] = np.nan
        yield at


def test_each_path_has_the_forces_of_its_own_session(tetrahedron):
    shape = (40, 60)
    states, sessions = np.zeros(shape, forceshade.STATE), [forceshade.Session(tetrahedron) for _ in range(2400)]
    seen = set()
    for tick, at in enumerate(walks(shape, 12)):
        status = np.zeros(shape, np.uint8)
        forces = tetrahedron.advance(states, at, status=status, threads=1 + tick % 2)
        for session, force, said, p, state in zip(sessions, *(a.reshape(2400, -1) for a in (forces, status, at)), states.ravel()):
            assert same_bits(session.step(*p), force) and session.status == said[0]
            its = session.state
            assert (its.place, its.side, its.slipping) == (state["place"], state["side"], state["slipping"])
            assert its.position == tuple(state["position"])
            assert its.index == tuple(state["index"]) and its.parameter == tuple(state["parameter"])
        seen |= {(int(place), int(said)) for place, said in zip(states["place"].ravel(), status.ravel())}
        if tick == 6:
            kept = states.copy()
            states[::3] = 0  # these begin again
            for session in np.array(sessions).reshape(shape)[::3].ravel():
                session.reset()
    assert seen >= {(0, 2), (1, 0), (1, 2), (4, 1), (4, 2)}  # places with statuses: nowhere, in the open and in a triangle
    at = np.zeros((*shape, 3), np.float32)
    assert same_bits(tetrahedron.advance(kept.copy(), at), tetrahedron.advance(kept, at, threads=4))  # a copy keeps paths


@pytest.mark.parametrize(
    "states, kind, words",
    [
        (np.zeros(3, forceshade.STATE), ValueError, "states has the shape (3,); expected (2,)"),
        (np.zeros(2, np.uint8), TypeError, "states is of type uint8; expected {"),
        (forceshade.State(), TypeError, "states: expected a NumPy array, got State"),
        (np.zeros(4, forceshade.STATE)[::2], ValueError, "states have gaps between them; expected an array that lies without gaps"),
        (np.broadcast_to(np.zeros((), forceshade.STATE), 2), ValueError, "states is read-only"),
    ],
)
def test_other_states_are_refused(tetrahedron, states, kind, words):
    with pytest.raises(kind) as caught:
        tetrahedron.advance(states, np.zeros((2, 3), np.float32))
    assert words in str(caught.value)


def test_states_that_overlap_are_refused(tetrahedron):
    states = np.zeros(2, forceshade.STATE)
    with pytest.raises(ValueError, match="states overlap the positions, out or status"):
        tetrahedron.advance(states, states["position"])
    with pytest.raises(ValueError, match="states overlap the positions, out or status"):
        tetrahedron.advance(states, np.zeros((2, 3), np.float32), status=states["side"])


@pytest.mark.parametrize(
    "threads, kind, words",
    [(0, ValueError, "expected 1 or more, got 0"), (-2, ValueError, "got -2"), (1.5, TypeError, "got 1.5"),
     (True, TypeError, "got True"), ("2", TypeError, "got '2'")],
)
def test_other_threads_are_refused(bump, tetrahedron, threads, kind, words):
    at = np.zeros((2, 3), np.float32)
    for call in (lambda: bump.forces(at, threads=threads), lambda: tetrahedron.advance(np.zeros(2, forceshade.STATE), at, threads=threads)):
        with pytest.raises(kind) as caught:
            call()
        assert "threads: " in str(caught.value) and words in str(caught.value)
