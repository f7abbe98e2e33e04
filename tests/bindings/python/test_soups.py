# SPDX-License-Identifier: BSD-3-Clause
"""Meshes that are not regular (docs/soups.md): forces and states of the stored paths, out, in, and in batches."""

import collections
import os
import pickle
import warnings

import numpy as np
import pytest
from conftest import GOLDEN, TETRAHEDRON, same_bits
from test_misuse import refused

import forceshade
from forceshade import STATE, Meeting, Mesh, Place, Session, State

F = np.float32
# Those of a path that are taken; all with FORCESHADE_DRAWS in the environment.
MOST = None if "FORCESHADE_DRAWS" in os.environ else 40
# The words of a place with the numbers behind them: the place, what it meets, and how many numbers are of index, further, parameter.
WORDS = {
    "v": (Place.AT_VERTEX, Meeting.NOTHING, 1, 0, 0),
    "e": (Place.ON_EDGE, Meeting.NOTHING, 2, 0, 1),
    "t": (Place.IN_TRIANGLE, Meeting.NOTHING, 1, 0, 2),
    "c": (Place.IN_TRIANGLE, Meeting.LINE, 2, 1, 1),
    "ee": (Place.ON_EDGE, Meeting.EDGE, 2, 2, 0),
    "ef": (Place.ON_EDGE, Meeting.TRIANGLE, 2, 1, 0),
    "fff": (Place.IN_TRIANGLE, Meeting.TRIANGLES, 2, 1, 0),
    "q t": (Place.IN_TRIANGLE, Meeting.FOOT_IN_TRIANGLE, 1, 0, 0),
    "q e": (Place.ON_EDGE, Meeting.FOOT_ON_EDGE, 2, 0, 0),
    "q c": (Place.IN_TRIANGLE, Meeting.FOOT_ON_LINE, 2, 1, 0),
}


class Path:
    """A file of tests/golden/soups: a mesh, and for each tick its position, place, side, and forces without and with shading."""

    def __init__(self, file):
        lines = [line.split() for line in file.read_text().splitlines()]
        self.name, self.sides = file.stem, lines[0][1]
        self.vertices = np.array([line[1:] for line in lines if line[0] == "v"], F)
        self.triangles = np.array([line[1:4] for line in lines if line[0] == "t"], np.uint32)
        ticks = [line.split(",") for line in file.read_text().splitlines() if line[0] not in "vst"][:MOST]
        self.ticks = [its + [""] * (6 - len(its)) for its in ticks]
        self.at = np.array([its[0].split() for its in self.ticks], F)

    def mesh(self, shading="none", **options):
        sides = {"f": "front", "b": "both"}[self.sides[0]]
        return Mesh(self.vertices, self.triangles, sides=sides, shading=shading, stiffness=0.3, **options)

    def forces(self, column):
        return np.array([(its[column] or its[4] or "0 0 0").split() for its in self.ticks], F)


PATHS = [path for path in map(Path, sorted((GOLDEN / "soups").iterdir())) if len(set(path.sides)) == 1]


def place_of(words):
    """The members of the state that the words of a place and a side stand for."""
    parts = words.split()
    kind = " ".join(parts[:2]) if parts[0] == "q" else parts[0]
    place, meeting, indices, further, parameters = WORDS[kind]
    numbers = list(map(int, parts[2 if parts[0] == "q" else 1 :]))
    take = lambda first, count: tuple(numbers[first : first + count]) + (0,) * (2 - count)
    return place, meeting, take(0, indices), take(indices, further), take(indices + further, parameters)


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.name)
def test_forces_states_and_points_are_those_of_the_stored_path(path):
    mesh = path.mesh()
    assert not mesh.is_regular
    for shading, column in (("none", 4), ("vertex", 5)):
        assert same_bits(Session(path.mesh(shading)).steps(path.at), path.forces(column))
    session, other, states = Session(mesh), Session(mesh), np.zeros(1, STATE)
    for (_, _, place, side, force, _), position in zip(path.ticks, path.at):
        other.resume(session.state)
        found = session.step(*map(float, position))
        assert same_bits(other.step(*map(float, position)), found)
        assert same_bits(mesh.advance(states, position[None])[0], found)
        its = session.state
        row = State(*(states[0][key].tolist() for key in ("place", "side")), slipping=bool(states[0]["slipping"]),
                    meeting=int(states[0]["meeting"]),
                    **{key: tuple(states[0][key].tolist()) for key in ("position", "index", "parameter", "further", "cell")})
        assert row == its == other.state
        if not place:
            assert its.place == Place.IN_THE_OPEN or session.status == forceshade.Status.INVALID
            continue
        assert (its.place, its.meeting, its.index, its.further, its.parameter) == place_of(place)
        assert its.side == (side[0] == "b")
        # The force is 0.3 N/mm times the way from the hand to where it rests, which is near the point, unless it was held.
        assert np.allclose(session.point, position + np.array(found) / 0.3, atol=2e-5)


def states_of(path):
    session = Session(path.mesh())
    for position in path.at:
        session.step(*map(float, position))
        yield session.state


def test_all_kinds_of_places_are_met():
    met = collections.Counter(its.meeting for path in PATHS for its in states_of(path))
    assert {Meeting.NOTHING, Meeting.LINE, Meeting.EDGE, Meeting.TRIANGLE, Meeting.TRIANGLES} <= set(met)
    assert len(PATHS) > 20


@pytest.fixture(scope="module")
def boxes():
    """Two with a common face."""
    return next(path for path in PATHS if path.name == "cubes_face")


def test_the_exact_side_has_the_same_bits(boxes):
    mesh = boxes.mesh("vertex")
    answers, exact = Session(mesh).answers(boxes.at), mesh.reference_forces(boxes.at)
    assert same_bits(answers["force"], exact["force"]) and (answers["status"] == exact["status"]).all()


def test_friction_and_damping_stand_behind_any_mesh(boxes):
    rough, oil = boxes.mesh(friction=0.5), forceshade.Damping(rate=1000, damping=0.01)
    session, found = Session(rough), Session(rough, damping=oil).steps(boxes.at)
    assert same_bits(found, oil.steps(boxes.at, session.steps(boxes.at)))
    assert not same_bits(Session(rough).steps(boxes.at), Session(boxes.mesh()).steps(boxes.at))


def test_a_mesh_is_an_object_of_a_scene_and_a_file_is_the_same(boxes, tmp_path):
    mesh, poses = boxes.mesh("vertex"), [forceshade.Pose()]
    scene, session = forceshade.Scene([mesh]), Session(mesh)
    for position in boxes.at:
        assert same_bits(scene.step(position, poses), session.step(*map(float, position)))
    vertices = "".join(f"v {x} {y} {z}\n" for x, y, z in boxes.vertices)
    text_of = lambda faces: vertices + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)
    file = tmp_path / "boxes.obj"
    file.write_text(text_of(boxes.triangles))
    assert Mesh(file, unit="mm", stiffness=0.3) == mesh and not Mesh(file, unit="mm").is_regular
    (tmp_path / "its.toml").write_text('mesh = "boxes.obj"\nunit = "mm"\nstiffness = 0.3\n')
    assert forceshade.read_subject(tmp_path / "its.toml") == mesh == pickle.loads(pickle.dumps(mesh))
    half = len(boxes.triangles) // 2
    for name, faces in (("a", boxes.triangles[:half]), ("b", boxes.triangles[half:])):
        (tmp_path / f"{name}.obj").write_text(text_of(faces))
    objects = "".join(f'[[object]]\nname = "{name}"\nmesh = "{name}.obj"\nunit = "mm"\n' for name in "ab")
    (tmp_path / "scene.toml").write_text(objects)
    (tmp_path / "both.toml").write_text('scene = "scene.toml"\nstiffness = 0.3\n')
    both = forceshade.read_subject(tmp_path / "both.toml")
    assert not both.is_regular and same_bits(Session(both).steps(boxes.at), Session(mesh).steps(boxes.at))


def test_no_argument_is_needed(boxes, tetrahedron):
    assert tetrahedron.is_regular
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert boxes.mesh() == boxes.mesh(self_intersecting=False)
    with pytest.warns(DeprecationWarning, match="self_intersecting is not needed"):
        assert Mesh(*TETRAHEDRON, stiffness=0.5, shading="none", self_intersecting=True) == tetrahedron
    refused(ValueError, "shading: expected vertex or none for a mesh that is not regular", boxes.mesh, "edge")
    refused(ValueError, "contact: expected direct or friction for a mesh that is not regular", boxes.mesh, contact="sub-goal")
    flat = np.zeros((3, 3), F)
    refused(ValueError, "the mesh cannot be rendered: ", Mesh, flat, [[0, 1, 2]])


def test_a_state_of_another_mesh_is_that_of_a_beginning(boxes, tetrahedron):
    on_boxes, on_regular = Session(boxes.mesh()), Session(tetrahedron)
    on_boxes.steps([[9.5, 3, 3], [10, 3, 3]])
    meeting = on_boxes.state
    assert meeting.place != Place.NOWHERE
    for session, state in ((on_regular, State(Place.IN_TRIANGLE, meeting=Meeting.TRIANGLES, index=(0, 1), further=(2, 0))),
                           (on_boxes, State(Place.IN_TRIANGLE, index=(2, 0), parameter=(5, 5), cell=(2, 7))),
                           (on_boxes, State(Place.IN_TRIANGLE, index=(99, 0), parameter=(5, 5)))):
        session.resume(state)
        assert session.state == State()
    for wrong in (State(Place.AT_VERTEX, meeting=Meeting.LINE), State(Place.ON_EDGE, meeting=8), State(meeting=-1)):
        refused(ValueError, "state: expected one that a session gave", on_boxes.resume, wrong)
    former = np.dtype([(name, STATE[name]) for name in STATE.names if name not in ("meeting", "further", "cell")], align=True)
    refused(TypeError, "states is of type", boxes.mesh().advance, np.zeros(1, former), boxes.at[:1])
