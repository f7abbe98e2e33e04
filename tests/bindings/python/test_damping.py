# SPDX-License-Identifier: BSD-3-Clause
"""Damping behind sessions, scenes, and forces in arrays."""

import copy
import dataclasses
import os
import pickle
import re
from collections import Counter
from fractions import Fraction

import numpy as np
import pytest
from conftest import ROOT, TETRAHEDRON, same_bits
from test_misuse import read_only, refused

import forceshade
from forceshade import DAMPING_STATE, Damping, DampingState
from forceshade._damping import periods_of

F = np.float32
OIL = Damping(rate=1000, damping=0.01, drag=0.002, share=0.3)
SUBJECTS = {
    "law": forceshade.Law("bump-2p-shaded", width=6),
    "map": forceshade.HeightMap(np.random.default_rng(3).random((9, 9), F), pitch=1, stiffness=0.3),
    "mesh": forceshade.Mesh(*TETRAHEDRON, stiffness=0.5),
    "friction": forceshade.Mesh(*TETRAHEDRON, stiffness=0.5, materials=([{"friction": (0.5, 0.25)}], [0] * 4)),
}


def walk(count, seed=1):
    """A path around all subjects, now and then at rest or out of the domain, and the periods of its steps."""
    draw = np.random.default_rng(seed)
    at = (np.cumsum(draw.normal(0, 0.1, (count, 3)), axis=0) % 4 - 1).astype(F)
    at[1::50] = at[::50]
    at[draw.random(count) < 0.01, 1] = np.nan
    return at, np.where(draw.random(count) < 0.1, draw.integers(0, 20, count), 1)


def dense(state):
    """A row of DAMPING_STATE as a DampingState."""
    at = tuple(map(float, state["position"])) if state["has_position"] else None
    return DampingState(at, tuple(map(float, state["velocity"])), int(state["periods"]))


@pytest.mark.parametrize("name", SUBJECTS)
def test_a_damped_session_is_the_definition(name):
    subject, (at, periods) = SUBJECTS[name], walk(5000)
    session = forceshade.Session(subject, damping=OIL)
    found = session.answers(at, periods=periods)
    exact = subject.reference_forces(at)
    expected = OIL.reference_steps(at, exact["force"], status=exact["status"], periods=periods)
    assert same_bits(found["force"], expected) and (found["status"] == exact["status"]).all()
    assert not same_bits(expected, subject.reference_forces(at)["force"]) and set(found["status"]) >= {0, 1, 2}
    assert session.damping is OIL and session.damping_state.position is not None

    alone, bare = np.zeros(1, DAMPING_STATE), forceshade.Session(subject)
    springs = bare.answers(at)
    out = springs["force"]
    OIL.steps(at[:999], out[:999], state=alone, periods=periods[:999], out=out[:999], status=springs["status"][:999])
    OIL.steps(at[999:], out[999:], state=alone, periods=periods[999:], out=out[999:], status=springs["status"][999:])
    assert same_bits(out, expected) and (springs["status"] == found["status"]).all()
    assert dense(alone[0]) == session.damping_state and bare.damping is None and bare.damping_state is None


def test_materials_limit_damping():
    at, periods = walk(500)
    forces = {}
    for name, material in {"all": {}, "some": {"damping": 0.005, "drag": 0.001}, "none": {"damping": 0, "drag": 0.0}}.items():
        mesh = forceshade.Mesh(*TETRAHEDRON, stiffness=0.5, materials=([material], [0] * 4))
        forces[name] = forceshade.Session(mesh, damping=OIL).steps(at, periods=periods)
    less = Damping(rate=1000, damping=0.005, drag=0.001, share=0.3)
    assert same_bits(forces["all"], forceshade.Session(SUBJECTS["mesh"], damping=OIL).steps(at, periods=periods))
    assert same_bits(forces["some"], forceshade.Session(SUBJECTS["mesh"], damping=less).steps(at, periods=periods))
    assert same_bits(forces["none"], forceshade.Session(SUBJECTS["mesh"]).steps(at))
    assert not same_bits(forces["some"], forces["all"]) and not same_bits(forces["some"], forces["none"])
    with pytest.raises(ValueError, match="damping of a material is 20 N·s/mm; expected 0 or inf, or "):
        forceshade.Mesh(*TETRAHEDRON, materials=([{"damping": 20}], [0] * 4))
    for number, kind, words in ((1e39, ValueError, "is 1e+39; expected a number that binary32 holds"),
                                (True, TypeError, ": expected a number, got True"),
                                (np.complex64(1), TypeError, f": expected a number, got {np.complex64(1)!r}")):  # fmt: skip
        with pytest.raises(kind, match=re.escape("materials[0]: drag" + (words if words[0] == ":" else " " + words))):
            forceshade.Mesh(*TETRAHEDRON, materials=([{"drag": number}], [0] * 4))
    above = Fraction(1) + Fraction(1, 2**24) + Fraction(1, 2**70)
    fine, near = (forceshade.Mesh(*TETRAHEDRON, materials=([{"drag": it}], [0] * 4)) for it in (above, 1 + 2**-23))
    assert fine == near, "rounded once"


def test_a_step_is_one_period_and_steps_are_its_sum():
    one, many = (forceshade.Session(SUBJECTS["mesh"], damping=OIL) for _ in range(2))
    at, _ = walk(500)
    forces, status = np.empty((500, 3), F), np.zeros(500, np.uint8)
    assert many.steps(at.reshape(5, 100, 3), out=forces.reshape(5, 100, 3), status=status.reshape(5, 100)).base is forces
    for p, force, said in zip(at, forces, status):
        assert same_bits(one.step(*map(float, p)), force) and one.status == said
    assert one.damping_state == many.damping_state


def test_a_state_goes_out_and_in():
    at, periods = walk(600)
    at[298:300] = np.nan  # so that periods have passed since the last valid one
    session, other = (forceshade.Session(SUBJECTS["friction"], damping=OIL) for _ in range(2))
    session.steps(at[:300], periods=periods[:300])
    other.resume(session.state, session.damping_state)
    kept = pickle.loads(pickle.dumps(session.damping_state))
    rest = session.steps(at[300:], periods=periods[300:])
    assert same_bits(other.steps(at[300:], periods=periods[300:]), rest)
    other.resume(session.state, kept)
    assert other.damping_state == kept and kept.periods > 1
    nowhere = DampingState((3, 4, float("nan")))
    for begin in (other.reset, lambda: other.resume(session.state), lambda: other.resume(session.state, nowhere)):
        other.resume(session.state, kept)
        begin()
        assert other.damping_state == DampingState()


def test_each_path_has_the_forces_of_its_own_damped_session(tetrahedron):
    shape, draw = (40, 60), np.random.default_rng(2)
    states, speeds = np.zeros(shape, forceshade.STATE), np.zeros(shape, DAMPING_STATE)
    sessions = [forceshade.Session(tetrahedron, damping=OIL) for _ in range(2400)]
    for tick in range(8):
        at, periods, status = draw.uniform(-1, 3, (*shape, 3)).astype(F), draw.integers(0, 4, shape), np.zeros(shape, np.uint8)
        at[draw.random(shape) < 0.01] = np.nan
        forces = tetrahedron.advance(states, at, status=status)
        OIL.advance(speeds, at, forces, periods=periods, out=forces, status=status, threads=1 + tick % 2)
        for session, p, e, force, said in zip(sessions, at.reshape(-1, 1, 3), periods.ravel(), forces.reshape(-1, 3), status.ravel()):
            assert same_bits(session.steps(p, periods=e)[0], force) and session.status == said
    assert [session.damping_state for session in sessions] == [dense(state) for state in speeds.ravel()]
    # Rows of which each has to be answered alone.
    its = [array[::2, ::-1] for array in (at, forces, periods)]
    kept, other = (speeds[::2, ::-1].copy() for _ in range(2))
    found = OIL.advance(kept, its[0], its[1], periods=its[2], threads=2)
    expected = OIL.advance(other, its[0].copy(), its[1].copy(), periods=its[2].copy())
    assert same_bits(found, expected) and (kept == other).all() and not same_bits(found, its[1])
    assert same_bits(OIL.steps(its[0], its[1], periods=its[2]), OIL.reference_steps(its[0], its[1], periods=its[2].copy()))


def test_a_scene_is_damped_by_the_speed_of_the_hand():
    objects = [SUBJECTS["law"], SUBJECTS["mesh"]]
    scene, bare = forceshade.Scene(objects, damping=OIL), forceshade.Scene(objects)
    (at, periods), turned = walk(400), 0
    forces, status, found = np.zeros((400, 3), F), np.zeros(400, np.uint8), np.zeros((400, 3), F)
    for i, (p, e) in enumerate(zip(at, periods)):
        poses = [forceshade.Pose((0, 0, i / 512)), forceshade.Pose((1, 0, 0), (1, 0, i / 512, 0))]
        found[i], forces[i] = scene.step(p, poses, periods=int(e)), bare.step(p, poses)
        status[i] = bare.status
        assert scene.status == bare.status and same_bits(scene.forces, bare.forces)
        turned += scene.status == 1
        if i == 200:
            kept, scene = scene.damping_state, forceshade.Scene(objects, damping=scene.damping)
            scene.step(p, poses)
            scene.resume_damping(kept)
            bare.step(p, poses)
    assert same_bits(found, OIL.reference_steps(at, forces, status=status, periods=periods)) and turned > 100
    assert bare.damping is None and bare.damping_state is None and not same_bits(found, forces)


def test_the_table_of_a_file_counts_at_a_rate(tmp_path, wall):
    table = '[damping]\ndamping = 0.002\nmost = 3\ndrag = "1Ns/m"\ntime = "2ms"\n'
    (tmp_path / "oil.toml").write_text('law = "wall"\n' + table)
    its = forceshade.read_subject(tmp_path / "oil.toml")
    oil = its.damping_at(500)
    assert oil == Damping(rate=500, damping=0.002, most=3, drag=0.001, time=0.002) and oil.share == 0.5
    assert its == wall and wall.damping_at(500) == Damping(rate=500)
    at, _ = walk(300)
    springs = wall.forces(at)
    assert same_bits(forceshade.Session(its, damping=oil).steps(at), oil.steps(at, springs)) and same_bits(its.forces(at), springs)
    assert same_bits(forceshade.Session(its, damping=Damping(rate=500)).steps(at), springs)

    corners, faces = TETRAHEDRON
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    (tmp_path / "its.obj").write_text("\n".join(lines))
    (tmp_path / "scene.toml").write_text(table + '[[object]]\nname = "a"\nmesh = "its.obj"\nunit = "mm"\n')
    (tmp_path / "all.toml").write_text('scene = "scene.toml"\n')
    scene = forceshade.read_subject(tmp_path / "all.toml")
    assert scene.damping_at(500) == oil

    words = "damping: a subject's file has the table [damping]; expected its damping_at(rate), or another Damping"
    refused(ValueError, words, forceshade.Session, scene)
    refused(ValueError, words, forceshade.Scene, [wall, its])
    assert forceshade.Scene([wall, its], damping=oil).damping is oil
    refused(ValueError, "rate is 0 Hz; expected 1 to 131072 Hz", its.damping_at, 0)
    refused(TypeError, "rate: expected a number, got '500'", its.damping_at, "500")


def drawn_dampings():
    """Seeds, each with its random numbers and the parameters of a damping that is not off: 16 of 20 seeds, or FORCESHADE_DRAWS times
    as many."""
    for seed in range(20 * int(os.environ.get("FORCESHADE_DRAWS", 1))):
        draw = np.random.default_rng(seed)
        lists = ((1000, 200, 999.9, 4096), (1, 0.5, 0.3, 2**-10), (0.002, 2**-9, 0.1, 0), (2, 1, 1.7, np.inf), (0, 0.001, 2**-10),
                 (0.25, 0.1))
        numbers = [float(F(draw.choice(these))) for these in lists]
        if numbers[2] != 0 or numbers[4] != 0:
            yield seed, draw, numbers


def test_drawn_ticks_are_those_of_the_program_in_rationals(monkeypatch):
    """1600 ticks, or FORCESHADE_DRAWS times as many."""
    monkeypatch.syspath_prepend(ROOT / "tests" / "golden")
    from make_damping_golden import Damping as Rational

    changed = 0
    for seed, draw, (rate, share, along, most, across, full) in drawn_dampings():
        (at, periods), springs = walk(100, seed), draw.normal(0, 2.0 ** draw.integers(-20, 6), (100, 3)).astype(F)
        springs[draw.random((100, 3)) < 0.2] = 0
        exact = Rational(rate, share, along, most, across, full)
        ticks = [exact.tick(p, int(n), f) for p, n, f in zip(at.tolist(), periods, springs.tolist())]
        expected = np.array([(0, 0, 0) if tick is None else tick for tick in ticks], F)
        stage = Damping(rate=rate, share=share, damping=along, most=most, drag=across, full_at=full)
        for found in (stage.steps(at, springs, periods=periods), stage.reference_steps(at, springs, periods=periods)):
            assert np.array_equal(found, expected), seed
        changed += int((expected != springs).any(axis=1).sum())
    assert changed > 1000


def test_drawn_ticks_on_faces_that_limit_damping_are_those_of_the_program_in_rationals(monkeypatch):
    """1600 ticks, or FORCESHADE_DRAWS times as many, on two faces of a square and on the edge between them, where x = y."""
    monkeypatch.syspath_prepend(ROOT / "tests" / "golden")
    from make_damping_golden import Damping as Rational

    corners, faces = [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)], [(0, 1, 2), (0, 2, 3)]
    reached = Counter()
    for seed, draw, (rate, share, along, most, across, full) in drawn_dampings():
        limits = [tuple(float(F(limit)) for limit in draw.choice([np.inf, 0, 2**-20, 0.0007, 2**-11, 0.05], 2)) for _ in faces]
        materials = [{"damping": damping, "drag": drag} for damping, drag in limits]
        square = forceshade.Mesh(corners, faces, stiffness=0.5, sides="front", materials=(materials, [0, 1]))
        (at, periods), place = walk(100, seed), {1: limits[0], -1: limits[1], 0: tuple(map(max, *limits))}
        at = np.round((at - (0, 0, 1)) * 8).astype(F) / 8
        springs = forceshade.Session(square).answers(at)
        exact = Rational(rate, share, along, most, across, full)
        stage = Damping(rate=rate, share=share, damping=along, most=most, drag=across, full_at=full)
        answers = forceshade.Session(square, damping=stage).answers(at, periods=periods)
        for p, n, spring, found in zip(at.tolist(), periods, springs, answers):
            its = (np.inf, np.inf)
            if spring["force"].any():
                side = int(np.sign(p[0] - p[1]))
                its = place[side]
                reached[side] += its[0] < along or its[1] < across
            expected = exact.tick(p, int(n), spring["force"].tolist(), limits=its) or (0, 0, 0)
            assert found["force"].tolist() == list(expected), (seed, p)
    assert all(reached[side] > 10 for side in (1, -1, 0)), reached


def test_the_numbers_of_a_damping():
    assert Damping(1000, 0.002) == Damping(rate=F(1000), damping=F(0.002)) != Damping(1000, 0.003)
    assert repr(Damping(1000, 0.002, time=0.003)) == "Damping(rate=1000.0, damping=0.002, drag=0.0, share=0.25, most=2.0, full_at=0.25)"
    assert Damping(1000, time=0).share == 1 and F(Damping(1000, time=0.009).share) == F(0.1)
    assert dataclasses.replace(OIL, damping=0) == Damping(1000, drag=0.002, share=0.3)
    assert pickle.loads(pickle.dumps(OIL)) == copy.deepcopy(OIL) == OIL and len({OIL, copy.copy(OIL)}) == 1
    assert Damping(1000, most=float("inf")).most == float("inf")
    with pytest.raises(dataclasses.FrozenInstanceError):
        OIL.rate = 2


@pytest.mark.parametrize(
    "numbers, kind, words",
    [
        (dict(rate=0), ValueError, "rate is 0 Hz; expected 1 to 131072 Hz"),
        (dict(rate=float("nan")), ValueError, "rate is nan Hz"),
        (dict(rate="1000"), TypeError, "rate: expected a number, got '1000'"),
        (dict(rate=1000, damping=True), TypeError, "damping: expected a number, got True"),
        (dict(rate=1000, damping=17), ValueError, "damping is 17 N·s/mm; expected 0, or 9.536743e-07 to 16 N·s/mm"),
        (dict(rate=1000, drag=-1), ValueError, "drag is -1 N·s/mm"),
        (dict(rate=1000, most=0.5), ValueError, "most is 0.5; expected inf, or 1 to 1024"),
        (dict(rate=1000, full_at=0), ValueError, "full_at is 0 N"),
        (dict(rate=1000, share=0), ValueError, "share is 0; expected"),
        (dict(rate=1000, time=-1), ValueError, "time is -1 s; expected 0 or more"),
        (dict(rate=1000, time="1ms"), TypeError, "time: expected a number, got '1ms'"),
        (dict(rate=1000, time=2), ValueError, "share is 0.000499750"),
        (dict(rate=0, time=1), ValueError, "rate is 0 Hz"),
        (dict(rate=1000, share=0.5, time=1), ValueError, "share and time: expected one of them"),
    ],
)
def test_other_numbers_are_refused(numbers, kind, words):
    refused(kind, words, Damping, **numbers)


def test_other_arguments_are_refused(wall):
    at, forces, states = np.zeros((2, 3), F), np.ones((2, 3), F), np.zeros(2, DAMPING_STATE)
    refused(ValueError, "forces have the shape (3,); expected that of the positions, (2, 3)", OIL.steps, at, forces[0])
    refused(TypeError, "forces are of type <U1; expected numbers", OIL.steps, at, [["a"] * 3] * 2)
    refused(ValueError, "out and positions overlap; expected memory of its own, or the forces", OIL.steps, at, forces, out=at)
    refused(ValueError, "out and positions overlap", OIL.steps, at, forces, out=forces[::-1])
    refused(ValueError, "status has the shape (1,)", OIL.steps, at, forces, status=np.zeros(1, np.uint8))
    refused(ValueError, "states has the shape (2,); expected (1,)", OIL.steps, at, forces, state=states)
    refused(TypeError, "states is of type", OIL.advance, np.zeros(2, forceshade.STATE), at, forces)
    refused(ValueError, "states is read-only", OIL.advance, read_only(states.copy()), at, forces)
    refused(ValueError, "states overlap", OIL.advance, states, states["position"], forces)
    refused(ValueError, "threads: expected 1 or more", OIL.advance, states, at, forces, threads=0)
    for call in (lambda **its: OIL.steps(at, forces, **its), forceshade.Session(wall, damping=OIL).steps):
        where = () if call.__name__ == "<lambda>" else (at,)
        refused(TypeError, "periods are of type float64; expected integers", call, *where, periods=[1.0, 1.0])
        for number in (-1, 2**32):
            refused(ValueError, "periods: expected numbers from 0 to 4294967295", call, *where, periods=number)
        refused(ValueError, "periods have the shape (3,); expected (2,), or one number", call, *where, periods=[1, 1, 1])
    refused(TypeError, "damping: expected a Damping, got 0.002", forceshade.Session, wall, damping=0.002)
    refused(TypeError, "damping: expected a Damping, got 0.002", forceshade.Scene, [wall], damping=0.002)
    session, bare = forceshade.Session(wall, damping=OIL), forceshade.Session(wall)
    refused(TypeError, "damping_state: expected none without damping", bare.resume, bare.state, DampingState())
    refused(TypeError, "damping_state: expected a DampingState, got 3", session.resume, session.state, 3)
    refused(TypeError, "damping_state: expected none without damping", forceshade.Scene([wall]).resume_damping, DampingState())
    for bad in (DampingState((1, 2)), DampingState((1, 2, 3), ("a", 0, 0)), DampingState((1, 2, 3), periods=1.5)):
        refused(TypeError, "damping_state: expected one that a session gave", session.resume, session.state, bad)
    for periods, its in ((-1, DampingState()), (17, DampingState((1, 2, 3), periods=17)), (18, DampingState()), (2**40, DampingState())):
        session.resume(session.state, DampingState((1, 2, 3), periods=periods))  # one that no tick leaves is that of a beginning
        assert session.damping_state == its


def test_one_position_has_one_number_of_periods_and_no_array_of_one():
    for given in (3, np.uint8(3), np.array(3)):
        assert periods_of(given, ()).shape == ()  # int() of an array of one is deprecated since NumPy 1.25
    assert periods_of(3, (2, 2)).tolist() == [[3, 3], [3, 3]]
