# SPDX-License-Identifier: BSD-3-Clause
"""Statuses and states beside forces: wherever they lie, in place, after a resume, and of a tick that used up its moves."""

import itertools

import numpy as np
import pytest
from conftest import TETRAHEDRON, same_bits

import forceshade
from forceshade import Session, State, Status

SHAPE = (6, 8)


def strip():
    """Flat, of more triangles in a row than a tick has moves."""
    x = np.arange(301, dtype=np.float32)
    vertices = np.stack([np.repeat(x, 2), np.tile(np.float32([0, 9]), 301), np.zeros(602, np.float32)], axis=1)
    a = np.arange(0, 600, 2, dtype=np.uint32)
    faces = np.concatenate([np.stack([a, a + 2, a + 3], axis=1), np.stack([a, a + 3, a + 1], axis=1)])
    return forceshade.Mesh(vertices, faces, stiffness=0.5, shading="none")


ROUGH = forceshade.Mesh(*TETRAHEDRON, stiffness=0.5, shading="none", friction=(0.6, 0.3))
BUMP = forceshade.Law("bump-2p", stiffness=0.5)


def walk(ticks=1):
    """Positions of SHAPE, for so many ticks; about the tetrahedron, with some that are invalid."""
    random = np.random.default_rng(4)
    at = np.full((*SHAPE, 3), 3, np.float32)
    for _ in range(ticks):
        at = np.clip(at + random.uniform(-1, 1, at.shape), -2, 4).astype(np.float32)
        at[random.random(SHAPE) < 0.1, 1] = np.nan
        yield at
        at = np.nan_to_num(at, nan=1)


def layouts(shape, dtype, tail=()):
    """Arrays of one shape that lie in memory in other ways."""
    rows, columns = shape
    yield np.zeros((rows, columns, *tail), dtype)
    yield np.swapaxes(np.zeros((columns, rows, *tail), dtype), 0, 1)
    yield np.zeros((2 * rows, columns, *tail), dtype)[::2]
    yield np.zeros((rows, 3 * columns, *tail), dtype)[::-1, ::-3]
    yield np.zeros((rows, columns), [("before", np.float32), ("here", dtype, tail), ("behind", np.float32)])["here"]


def one_by_one(subject, at):
    """Forces and statuses of a path through all positions, a step for each."""
    session = Session(subject)
    answers = [(session.step(*p), int(session.status)) for p in at.reshape(-1, 3)]
    return np.float32([force for force, _ in answers]).reshape(at.shape), np.uint8([status for _, status in answers]).reshape(SHAPE)


CALLS = {
    "forces": (BUMP, lambda at, out, status: BUMP.forces(at, out=out, status=status)),
    "steps": (ROUGH, lambda at, out, status: Session(ROUGH).steps(at, out=out, status=status)),
}


@pytest.mark.parametrize("call", CALLS)
def test_lie_wherever_their_arrays_lie(call):
    subject, answer = CALLS[call]
    (at,) = walk()
    forces, statuses = one_by_one(subject, at)
    assert set(statuses.ravel()) >= {1, 2}
    arrays = (layouts(SHAPE, np.float32, (3,)), layouts(SHAPE, np.float32, (3,)), layouts(SHAPE, np.uint8))
    for placed, out, status in itertools.product(*map(list, arrays)):
        placed[...] = at
        answer(placed, out, status)
        assert same_bits(out, forces) and (status == statuses).all()
        answer(placed, placed, status)  # in place
        assert same_bits(placed, forces) and (status == statuses).all()


def test_of_paths_lie_wherever_their_arrays_lie():
    for places in itertools.product(range(5), range(5), range(5)):
        states, sessions = np.zeros(SHAPE, forceshade.STATE), [Session(ROUGH) for _ in range(48)] if sum(places) == 12 else None
        copied = states.copy()
        for at in walk(3):
            placed, out, status = (
                list(layouts(SHAPE, *of))[place]
                for of, place in zip([(np.float32, (3,)), (np.float32, (3,)), (np.uint8,)], places)
            )
            placed[...] = at
            ROUGH.advance(states, placed, out=out, status=status)
            plain = np.zeros(SHAPE, np.uint8)
            assert same_bits(ROUGH.advance(copied, at, status=plain), out) and (plain == status).all() and (copied == states).all()
            for session, p, force, said in zip(sessions or (), at.reshape(-1, 3), out.reshape(-1, 3), status.ravel()):
                assert same_bits(session.step(*p), force) and session.status == said


def test_of_a_slipping_path_are_kept_in_its_state():
    states, session = np.zeros((), forceshade.STATE), Session(ROUGH)
    slipping = 0
    for at in walk(150):
        p = np.nan_to_num(at[0, 0], nan=1)
        force = ROUGH.advance(states, p)
        assert same_bits(force, session.step(*p)) and session.state.slipping == states["slipping"]
        slipping += int(states["slipping"])
    assert slipping > 10


def test_of_a_session_are_those_of_its_last_step():
    its, session = strip(), Session(strip())
    far = [[0.25, 1, 2], [0.25, 1, -1], [290.25, 1, -1]]  # along the strip, farther than a tick goes
    for said, step in ((Status.FREE, far[0]), (Status.CONTACT, far[1]), (Status.UNFINISHED, far[2]), (Status.INVALID, [np.nan, 0, 0])):
        session.step(*step)
        assert session.status is said
    for count, said in ((1, Status.FREE), (2, Status.CONTACT), (3, Status.UNFINISHED)):
        session.reset()
        assert session.status is Status.FREE and session.state == State()
        session.steps(far[:count])
        assert session.status is said
        assert session.answers(np.zeros((0, 3), np.float32)).shape == (0,) and session.status is said
    kept, session = session.state, Session(its)
    session.step(*far[1])
    session.resume(kept)
    assert session.status is Status.FREE and session.state == kept
    states, status = np.zeros(3, forceshade.STATE), np.zeros(3, np.uint8)
    for at in far:
        its.advance(states, [at, at, [np.nan, 0, 0]], status=status)
    assert status.tolist() == [Status.UNFINISHED, Status.UNFINISHED, Status.INVALID]
    scene = forceshade.Scene([strip()])
    for said, step in zip((Status.FREE, Status.CONTACT, Status.UNFINISHED, Status.FREE), [*far, [0, 0, 1]]):
        scene.step(step, [forceshade.Pose()])
        assert scene.status is said
