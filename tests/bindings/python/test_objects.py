# SPDX-License-Identifier: BSD-3-Clause
"""Subjects, sessions and results as objects of Python: equal, pickled, printed, read again."""

import os
import pickle
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT, TETRAHEDRON
from test_conform import DECLARES, WALL, wall
from test_misuse import refused

import forceshade

MILD = np.random.default_rng(3).random((5, 6), np.float32)
TILES = dict(pitch=0.5, stiffness=0.3, interpolant="bilinear", edge="tile")
ROUGH = dict(materials=([{"friction": 0.5}, {"stiffness": 2, "friction": (0.25, 0.125)}], [0, 1, 1, 0]))


def subjects():
    yield forceshade.Law("bump-2p")
    yield forceshade.HeightMap(MILD, **TILES)
    yield forceshade.HeightMap(ROOT / "examples/leather.toml")
    yield forceshade.HeightMap(ROOT / "examples/leather.png", pitch="0.1mm", scale="0.5mm", render="height-map-shaded")
    yield forceshade.Mesh(*TETRAHEDRON, shading="edge", crease="30deg")
    yield forceshade.Mesh(*TETRAHEDRON, **ROUGH)


@pytest.mark.parametrize("subject", subjects(), ids=lambda subject: repr(subject))
def test_a_pickled_subject_is_equal_and_gives_the_same_forces(subject):
    again = pickle.loads(pickle.dumps(subject))
    assert type(again) is type(subject) and again is not subject
    assert again == subject and hash(again) == hash(subject) and again.identity == subject.identity
    path = np.random.default_rng(5).uniform(-3, 3, (300, 3)).astype(np.float32)
    assert (forceshade.Session(again).answers(path) == forceshade.Session(subject).answers(path)).all()


def test_a_pickled_subject_goes_to_another_process(tmp_path):
    (tmp_path / "map").write_bytes(pickle.dumps(forceshade.HeightMap(MILD, **TILES)))
    program = "import pickle, sys; print(pickle.load(open(sys.argv[1], 'rb')).force(x=0, y=0, z=0))"
    ran = subprocess.run([sys.executable, "-c", program, tmp_path / "map"], capture_output=True, text=True, cwd="/")
    assert ran.stdout.strip() == str(forceshade.HeightMap(MILD, **TILES).force(0, 0, 0)), ran.stderr


def test_a_pickled_mesh_finds_its_materials_and_its_texture_from_another_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mesh.obj").write_text("v 0 0 0\nv 9 0 0\nv 0 9 0\nvt 0 0\nvt 1 0\nvt 0 1\ng rough\nf 1/1 2/2 3/3\n")
    (tmp_path / "rough.toml").write_text('[[material]]\nname = "rough"\nfaces = ["0"]\nfriction = 0.5\n')
    (tmp_path / "\udcff.toml").write_bytes((ROOT / "examples/grating.toml").read_bytes())
    rough = forceshade.Mesh("mesh.obj", unit="mm", shading="none", materials="rough.toml")
    waves = forceshade.Mesh("mesh.obj", unit="mm", shading="texture:\udcff.toml", texture_scale=9)
    assert "shading texture" in repr(waves)
    pickled = pickle.dumps([rough, waves])
    monkeypatch.chdir("/")
    assert pickle.loads(pickled) == [rough, waves]


def test_the_heights_of_a_map_cannot_be_made_writable():
    heights = forceshade.HeightMap(MILD, pitch=1).heights
    with pytest.raises(ValueError, match="cannot set WRITEABLE flag"):
        heights.flags.writeable = True


def test_a_name_that_is_no_utf_8_is_read_and_written(tmp_path):
    name = os.fsdecode(os.fsencode(tmp_path) + b"/\xff")
    with open(name + ".toml", "w") as file:
        file.write('law = "wall"\n')
    assert forceshade.read_subject(name + ".toml") == forceshade.Law("wall")
    with open(name + ".off", "w") as file:
        file.write("OFF\n3 1 0\n0 0 0\n9 0 0\n0 9 0\n3 0 1 2\n")
    mesh = forceshade.Mesh(name + ".off", unit="mm")
    assert mesh.identity.name == r"\xff.off" and pickle.loads(pickle.dumps(mesh)) == mesh
    np.save(name + ".npy", MILD)
    assert forceshade.HeightMap(name + ".npy", pitch=1, scale=1).heights.shape == MILD.shape
    made = forceshade.certify(mesh, points=100, cases=1, out=name + ".json")
    assert forceshade.Certificate.read(name + ".json") == made
    assert forceshade.make_plan(name, {"law": "wall"}, points=100, cases=1, units=1).units == forceshade.plan_state(name).units
    with open(name + ".toml", "w") as file:
        file.write('law = "wal"\n')
    refused(forceshade.Error, r"\xff.toml: line 1: law: expected one of", forceshade.read_subject, name + ".toml")


def test_a_pickled_subject_of_a_file_that_has_changed_is_refused(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.save("map.npy", MILD)
    pickled = pickle.dumps(forceshade.HeightMap("map.npy", pitch=1, scale=1))
    monkeypatch.chdir("/")
    assert pickle.loads(pickled).stiffness == 0.5
    np.save(tmp_path / "map.npy", 2 * MILD)
    refused(forceshade.Error, "map.npy has changed since this was pickled: expected the digest ", pickle.loads, pickled)
    (tmp_path / "map.npy").unlink()
    with pytest.raises(FileNotFoundError):
        pickle.loads(pickled)


def test_what_is_equal():
    law, make = forceshade.Law, forceshade.Mesh
    assert law("bump-1p") == law("bump-1p", radius="600mil", width="1in", stiffness="500N/m")
    assert law("bump-1p") != law("bump-1p", stiffness=0.25) and law("bump-1p") != law("bump-2p") and law("wall") != "wall"
    assert make(*TETRAHEDRON) == make(*TETRAHEDRON) and make(*TETRAHEDRON) != make(*TETRAHEDRON, shading="none")
    assert len({make(*TETRAHEDRON), make(*TETRAHEDRON), law("wall"), law("wall")}) == 2
    assert forceshade.HeightMap(MILD, **TILES) != forceshade.HeightMap(2 * MILD, **TILES)


def test_a_map_is_equal_whatever_file_it_came_from(tmp_path):
    for name in ("one.npy", "two.npy"):
        np.save(tmp_path / name, MILD)
    one, two = (forceshade.HeightMap(tmp_path / name, pitch=1, scale=1) for name in ("one.npy", "two.npy"))
    assert one == two and one.identity != two.identity
    spike = np.zeros((65, 65), np.float32)
    spike[32, 32] = 1  # far from it the spline's coefficients are below the least and so 0, wherever they are made
    np.save(tmp_path / "spike.npy", spike)
    usual = dict(pitch=1, stiffness=0.5, interpolant="cubic-spline", edge="clamp", render="height-map")
    assert forceshade.HeightMap(tmp_path / "spike.npy", scale=1, **usual) == forceshade.HeightMap(spike, **usual)


def test_coordinates_have_names(bump, tetrahedron):
    assert bump.force(z=-0.5, x=3, y=0) == bump.force(3, 0, z=-0.5) == bump.force(3, 0, -0.5)
    assert bump.force(0.1, y=0, z=-0.1, rounding="nearest") == bump.force(0.1, 0, -0.1, rounding="nearest")
    calls = [((1, 1, 1), {}), ((1,), {"z": 1, "y": 1})]
    steps = [forceshade.Session(tetrahedron).step(*by_place, **by_name) for by_place, by_name in calls]
    assert steps[0] == steps[1]
    for call in (bump.force, forceshade.Session(bump).step):
        refused(TypeError, "x: expected it once, got it by its place and by its name", call, 1, 2, 3, x=1)
        refused(TypeError, "expected three numbers x, y, z in mm", call, x=1, z=2)
        refused(TypeError, "expected three numbers x, y, z in mm", call, 1, 2, 3, 4)
        refused(TypeError, "y: expected a number in mm, got '1'", call, 1, z=3, y="1")


def test_arrays_of_a_mesh_and_of_a_map(tmp_path):
    mesh = forceshade.Mesh(*TETRAHEDRON)
    assert (mesh.vertices == TETRAHEDRON[0]).all() and (mesh.faces == TETRAHEDRON[1]).all()
    vertices, faces = mesh.vertices, mesh.faces
    assert vertices.dtype == np.float32 and faces.dtype == np.uint32
    del mesh  # they keep it
    assert vertices.sum() == np.sum(TETRAHEDRON[0])
    for array in (vertices, faces):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    heights = MILD.copy()
    its = forceshade.HeightMap(heights, **TILES)
    heights[0, 0] = 9
    assert (its.heights == MILD).all() and not its.heights.flags.writeable
    (tmp_path / "one.off").write_text("OFF\n3 1 0\n0 0 0\n2 0 0\n0 3 0\n3 0 1 2\n")
    assert forceshade.Mesh(tmp_path / "one.off", unit="m").vertices.tolist() == [[0, 0, 0], [2000, 0, 0], [0, 3000, 0]]


def test_a_map_of_a_file_has_the_heights_of_its_samples(tmp_path):
    """As the picture has them, with the largest y in its first row, times the scale."""
    leather = forceshade.HeightMap(ROOT / "examples/leather.toml")
    picture = forceshade.HeightMap(ROOT / "examples/leather.png", pitch="0.15mm", scale="0.4mm", edge="tile", render="height-map-shaded")
    samples = np.random.default_rng(1).uniform(-1, 1, (7, 9)).astype(np.float32)
    np.save(tmp_path / "one.npy", samples)
    assert (leather.heights == picture.heights).all() and leather == picture
    assert leather.heights.shape[0] > 8 and leather.heights.min() >= 0 and leather.heights.max() <= np.float32(0.4)
    again = forceshade.HeightMap(leather.heights, pitch="0.15mm", edge="tile", render="height-map-shaded")
    assert again == leather
    for interpolant in ("bilinear", "cubic-spline"):
        its = forceshade.HeightMap(tmp_path / "one.npy", pitch=1, scale=0.5, interpolant=interpolant)
        heights = its.heights
        del its  # they keep what they lie in
        assert heights.dtype == np.float32 and (heights == samples[::-1] / 2).all() and not heights.flags.writeable
    (tmp_path / "band.toml").write_text(
        'render = "height-map"\n[[part]]\nshape = "grid"\nfile = "one.npy"\npitch_mm = 1\nscale_mm = 1\n'
        'interpolant = "band-limited"\nshortest_wavelength_mm = 4\n'
    )
    smooth = forceshade.HeightMap(tmp_path / "band.toml")
    assert smooth.heights.shape == (7, 9) and (smooth.heights != samples[::-1]).any()
    its = forceshade.HeightMap(tmp_path / "one.npy", pitch=1, scale=1)
    np.save(tmp_path / "one.npy", samples + np.float32(1))
    refused(forceshade.Error, "one.npy has changed since the map was read", lambda: its.heights)
    assert forceshade.HeightMap(ROOT / "examples/gaussian.toml").heights is None


MAPS = {
    "grid": '[[part]]\nshape = "grid"\nfile = "one.npy"\npitch_mm = 1.5\nscale_mm = 1\n',
    "sum": '[[part]]\nshape = "gaussian"\nx_mm = 1\nheight_mm = 3\nsigma_mm = 2\n[[part]]\nshape = "cone"\nheight_mm = 2\nradius_mm = 5\n'
    '[[part]]\nshape = "grating"\nheight_mm = 0.25\nwave_x_rad_per_mm = 2\nnegated = true\n',
    "cap": '[[part]]\nshape = "sphere-cap"\nradius_mm = 10\nwidth_mm = 12\n',
    "polygons": '[[part]]\nshape = "polygons"\nknots_mm = [[-5, 0], [-1, 2], [3, 2.5], [5, 0]]\n',
}


@pytest.mark.parametrize("name", MAPS)
def test_the_force_begins_at_the_height(tmp_path, name):
    """The height lies between the binary32 numbers beside the one that is answered: a hand at the lower is inside, at the upper not."""
    np.save(tmp_path / "one.npy", np.random.default_rng(2).uniform(1, 2, (8, 8)).astype(np.float32))
    (tmp_path / "map.toml").write_text('render = "height-map"\n' + MAPS[name])
    its = forceshade.HeightMap(tmp_path / "map.toml")
    places = np.random.default_rng(3).uniform(-7, 7, (300, 2)).astype(np.float32)
    places[0] = 0
    heights = np.float32([its.height(*map(float, place)) for place in places])
    assert len(set(heights)) > 5
    for beside, status in ((-np.inf, forceshade.Status.CONTACT), (np.inf, forceshade.Status.FREE)):
        at = np.column_stack([places, np.nextafter(heights, np.float32(beside))])
        at = at[np.abs(at[:, 2]) >= 2**-30]
        assert (its.answers(at)["status"] == status).all()


def test_heights_that_are_known():
    ramp = forceshade.HeightMap([[0, 1, 4], [0, 1, 4]], pitch=1, interpolant="bilinear")
    assert [ramp.height(x, 0) for x in (-1, -0.5, 0, 0.25, 1, 40)] == [0, 0.5, 1, 1.75, 4, 4]
    third = forceshade.HeightMap([[0, 1], [0, 1]], pitch=3, interpolant="bilinear")
    assert third.height(-0.5, 0) == float(np.float32(1 / 3)) and str(third.height(0, 0)) == "0.5"
    # A tie between two binary32 numbers goes to the even one: the mean of 1 and 1 + 2^-23, and of that and 1 + 2^-22.
    step = 2.0**-23
    for low, even in ((1, 1), (1 + step, 1 + 2 * step)):
        assert forceshade.HeightMap([[low, low + step]] * 2, pitch=1, interpolant="bilinear").height(0, 0) == even
    level = forceshade.HeightMap(np.zeros((2, 2), np.float32), pitch=1)
    assert str(level.height(5, 5)) == "0.0"
    for x in (float("nan"), float("inf"), 10_001):
        refused(ValueError, "expected x and y within ±10 000 mm", level.height, x, 0)
    assert level.height(0.1, 0, rounding="nearest") == 0


def test_the_god_object_has_a_point():
    mesh = forceshade.Mesh([[-8, -8, 0], [8, -8, 0], [8, 8, 0]], [[0, 1, 2]], shading="none")
    session = forceshade.Session(mesh)
    assert session.point is None and forceshade.Session(forceshade.Law("wall")).point is None
    for at, point, place in [((3, 1, 2), (3, 1, 2), "IN_THE_OPEN"), ((3, 1, -2), (3, 1, 0), "IN_TRIANGLE")]:
        session.step(*at)
        assert session.state.place.name == place and session.point == point


def test_the_spring_of_a_mesh_ends_at_the_point():
    """The force without shading is K (g - p), but for the grid of 2^-24 of a triangle on which g is."""
    vertices, faces = np.float32(TETRAHEDRON[0]), np.array(TETRAHEDRON[1])
    room = forceshade.Mesh(vertices, faces[:, ::-1], shading="none", stiffness=0.5)  # felt from inside, so that it has corners
    session = forceshade.Session(room)
    session.step(*map(float, vertices.mean(axis=0)))
    seen = set()
    span = np.ptp(vertices)
    for at in np.random.default_rng(7).uniform(-span / 2, span, (400, 3)).astype(np.float32):
        force, state = session.step(*map(float, at)), session.state
        seen.add(state.place.name)
        assert np.allclose(force, (np.array(session.point) - at) / 2, rtol=0, atol=1e-6), (at, state)
    assert seen == {"IN_THE_OPEN", "IN_TRIANGLE", "ON_EDGE", "AT_VERTEX"}


def test_a_certificate_is_read_again(tmp_path):
    path = tmp_path / "certificate.json"
    made = forceshade.certify([forceshade.Law("wall"), forceshade.Law("bump-1p")], points=500, cases=5, out=path)
    assert forceshade.Certificate.read(path) == made
    assert repr(made) == "<Certificate of wall, bump-1p: insufficient>"
    path.write_text("{}")
    refused(forceshade.Error, "expected a forceshade certificate", forceshade.Certificate.read, path)
    refused(FileNotFoundError, "No such file", forceshade.Certificate.read, tmp_path / "none.json")


def test_a_wrong_renderer_says_so_in_a_line_and_all_of_it_on_demand():
    right = forceshade.conform(wall, WALL, declares=DECLARES, points=500)
    assert right.check() is right and repr(right) == "<Conformance: held>"
    wrong = forceshade.conform(lambda at: 2 * wall(at), WALL, declares=DECLARES, points=500)
    assert repr(wrong).startswith("<Conformance: FAILED: ") and len(repr(wrong)) < 200 and "\n" not in repr(wrong)
    with pytest.raises(AssertionError) as caught:
        wrong.check()
    assert str(caught.value) == str(wrong) == wrong.words and "to paste into a test" in wrong.words


def test_what_renders_says_what_in_one_line():
    wall = forceshade.Law("wall", stiffness=0.5)
    assert repr(forceshade.Session(wall)) == "<Session of Law('wall', stiffness=0.5)>"
    assert repr(forceshade.Scene([wall, wall])) == "<Scene of Law('wall', stiffness=0.5), Law('wall', stiffness=0.5)>"
