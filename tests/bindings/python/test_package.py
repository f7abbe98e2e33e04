# SPDX-License-Identifier: BSD-3-Clause
"""Sessions, files, identities, and the examples of the documentation."""

import contextlib
import csv
import doctest
import importlib
import json
import sqlite3
import subprocess
import sys
import types
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from conftest import GOLDEN, ROOT, command, positions, same_bits

import forceshade


@pytest.mark.parametrize("name", ["", "._subject", "._checks", "._subjects", "._sessions", "._exact", "._recordings"])
def test_the_examples_of_the_docstrings_run(name):
    module = importlib.import_module("forceshade" + name)
    names = {key: getattr(forceshade, key) for key in forceshade.__all__}
    assert doctest.testmod(module, extraglobs=names).failed == 0


def test_the_geometry_has_every_digit():
    with open(GOLDEN / "bump_geometry.csv", newline="") as file:
        for row in csv.DictReader(file):
            radius, width = (np.float32(float.fromhex(row[key])) for key in ("R_mm", "w_mm"))
            its = forceshade.geometry(radius=radius, width=width, digits=50)
            keys = ("d_mm", "h_mm", "w_prime_mm", "h_prime_mm", "theta_rad")
            assert [Decimal(text) for text in its] == [Decimal(row[key]) for key in keys], row


def test_a_sub_interpreter_is_refused():
    """As those of web servers, in which the import waited for ever."""
    inner = f"import sys; sys.path[:0] = {sys.path!r}; import forceshade._forceshade"
    code = f"import _xxsubinterpreters as sub; sub.run_string(sub.create(), {inner!r})"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    if "No module named '_xxsubinterpreters'" in ended.stderr:
        pytest.skip("this Python has no _xxsubinterpreters")
    assert ended.returncode == 1
    assert "forceshade cannot be imported in a sub-interpreter; expected the main one of its process" in ended.stderr


def test_everything_public_is_documented():
    for key in forceshade.__all__:
        thing = getattr(forceshade, key)
        if isinstance(thing, type):
            assert thing.__doc__, key
            for name, member in vars(thing).items():
                assert name.startswith("_") or not callable(member) or member.__doc__, (key, name)
    assert forceshade.Law.force.__doc__.startswith("The force (N) at one position (mm)")


def test_identities(bump, wall, tetrahedron):
    assert bump.identity.kind == "law" and bump.identity.name == "bump-2p" and bump.digest == ""
    assert bump.identity.parameters["stiffness_N_per_mm"] == 0.5
    assert wall.radius is None and bump.radius == float(np.float32(15.24)) and wall.stiffness == 0.5
    assert tetrahedron.identity.kind == "mesh" and len(tetrahedron.digest) == 64
    assert len(forceshade.library_digest()) == 64


def test_files_are_read(tmp_path):
    (tmp_path / "bump.toml").write_text('law = "bump-1p"\nradius = "600mil"\nwidth = "1in"\nstiffness = "500N/m"\n')
    law = forceshade.read_subject(tmp_path / "bump.toml")
    assert isinstance(law, forceshade.Law) and repr(law) == "Law('bump-1p', radius=15.24, width=25.4, stiffness=0.5)"
    map_ = forceshade.HeightMap(ROOT / "examples/leather.toml", stiffness=0.5)
    picture = forceshade.HeightMap(
        str(ROOT / "examples/leather.png"), pitch=0.15, scale=0.4, edge="tile", render="height-map-shaded", stiffness=0.5
    )
    assert map_.identity.name == "leather.toml" and map_.digest == picture.digest
    at = positions(500)
    assert same_bits(map_.forces(at), picture.forces(at))
    heights = np.random.default_rng(2).uniform(-1, 1, (20, 30)).astype(np.float32)
    np.save(tmp_path / "heights.npy", heights)
    of_file = forceshade.HeightMap(tmp_path / "heights.npy", pitch=1, scale=1, stiffness=0.5)
    assert of_file.digest == forceshade.HeightMap(heights[::-1], pitch=1, stiffness=0.5).digest
    mesh = forceshade.Mesh(ROOT / "tests/golden/god_object/cube.off", unit="mm", stiffness=0.5, contact="sub-goal")
    assert mesh.identity.parameters["contact"] == "sub-goal"


def test_meshes_may_have_friction_and_materials(tmp_path):
    cube = ROOT / "tests/golden/god_object/cube.off"
    corners, faces = [[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    (tmp_path / "soft.toml").write_text('[[material]]\nname = "soft"\nstiffness = 0.25\nfaces = ["0-1"]\n')
    of_file = forceshade.Mesh(cube, unit="mm", stiffness=0.5, friction=(0.4, 0.3))
    assert of_file.identity.parameters["friction"] == "0.4, 0.3" and of_file.identity.parameters["contact"] == "friction"
    assert forceshade.Mesh(cube, unit="mm", stiffness=0.5, materials=tmp_path / "soft.toml").identity.parameters["materials"] == "2"
    of_arrays = forceshade.Mesh(corners, faces, stiffness=0.5, friction=0.5)
    assert of_arrays.identity.parameters["friction"] == "0.5, 0.5"
    listed = ([{}, {"friction": (float("inf"), 1), "stiffness": "2N/mm"}], [0, 1, 0, 1])
    two = forceshade.Mesh(corners, faces, stiffness=0.5, materials=listed)
    assert two.identity.parameters["friction"] == "up to inf" and two.identity.parameters["materials"] == "2"
    session = forceshade.Session(of_arrays)
    assert session.state.slipping is False
    for at in ((3, 3, -1), (3, 3, 1), (3.25, 3, 1), (5, 3, 1)):
        session.step(*at)
    again = forceshade.Session(of_arrays)
    again.resume(session.state)
    assert again.state == session.state and again.step(5.5, 3, 1) == session.step(5.5, 3, 1)
    for wrong in (-1, (0.2, 0.3), "rough", 1e-4):
        with pytest.raises(ValueError, match="friction: expected"):
            forceshade.Mesh(corners, faces, stiffness=0.5, friction=wrong)
    with pytest.raises(ValueError, match="0 to 1"):
        forceshade.Mesh(corners, faces, stiffness=0.5, materials=(listed[0], [0, 1, 2, 1]))
    for wrong in ([{"friction": 1}], ([{"friction": 1}],), 3, "soft.toml"):
        with pytest.raises(TypeError, match="expected a pair"):
            forceshade.Mesh(corners, faces, stiffness=0.5, materials=wrong)
    with pytest.raises(ValueError, match="another contact rule"):
        forceshade.Mesh(corners, faces, stiffness=0.5, friction=1, contact="direct")
    with pytest.raises(TypeError, match="got both"):
        forceshade.Mesh(corners, faces, stiffness=0.5, friction=1, materials=listed)


def test_exact_forces_are_fractions_where_they_are_rational(wall, bump):
    third = forceshade.Law("wall", stiffness=np.float32(1 / 3))
    exact = third.reference(0, 0, -3)
    assert exact.z == 3 * Fraction(float(np.float32(1 / 3))) and exact.x == 0 and exact.status == forceshade.Status.CONTACT
    assert wall.reference(0, 0, 1) == (0, 0, 0, forceshade.Status.FREE)
    assert wall.reference(20000, 0, 1).status == forceshade.Status.INVALID
    assert isinstance(bump.reference(3, 0, -0.5).z, str)
    assert len(bump.reference(3, 0, -0.5, digits=300).z.replace(".", "")) >= 300
    plane = forceshade.HeightMap(np.zeros((3, 3), np.float32), pitch=1, stiffness=0.5).reference(0, 0, -1)
    assert plane[:3] == (0, 0, Fraction(1, 2))
    ramp = np.tile(np.array([0, 0.75, 1.5], np.float32), (3, 1))  # a slope of 3/4: a normal of (-3/5, 0, 4/5)
    exact = forceshade.HeightMap(ramp, pitch=1, interpolant="bilinear", stiffness=1).reference(0.5, 0, 0.125)
    assert exact[:3] == (Fraction(-3, 5), 0, Fraction(4, 5))


def test_a_gaussian_beyond_all_decimals_is_no_fraction(tmp_path):
    (tmp_path / "map.toml").write_text(
        'render = "height-map"\n[[part]]\nshape = "gaussian"\nheight_mm = 1\nsigma_mm = 1\n[[part]]\nshape = "plane"\nheight_mm = 1\n'
    )
    exact = forceshade.HeightMap(tmp_path / "map.toml", stiffness=0.5).reference(1000, 0, 0.5, digits=10)
    assert exact.x.startswith("1.") and exact.x.endswith("e-217145") and exact.y == 0


def recorded(tmp_path):
    path = tmp_path / "run.fsr"
    ran = subprocess.run(
        [command(), "drive", "--law", "wall", "--device", "simulated", "--seconds", "0.2", "--certificate", "none", "--out", path],
        capture_output=True,
        text=True,
    )
    assert path.exists(), ran.stderr
    return path


def test_what_is_wrong_with_a_recording_is_said_beside_an_array_and_a_frame(tmp_path, monkeypatch):
    path = recorded(tmp_path)
    with contextlib.closing(sqlite3.connect(path)) as database, database:
        database.execute("UPDATE metadata SET value = '3' WHERE key = 'lost'")
    monkeypatch.setitem(sys.modules, "pandas", types.SimpleNamespace(DataFrame=list))  # a stand-in, where there is none
    for frame in (False, True):
        lost, changed = forceshade.read_recording(path, frame=frame).problems
        assert lost.endswith("3 samples were lost while recording") and changed.endswith("are not what was written")


def test_recordings_are_read(tmp_path):
    path = recorded(tmp_path)
    recording = forceshade.read_recording(path)
    samples = recording.samples
    assert len(samples) >= 200 and samples["tick"][0] == 0 and "law" in json.dumps(recording.metadata)
    subprocess.run([command(), "recording", "export", path, "--out", tmp_path / "run.npy"], check=True, capture_output=True)
    assert samples.tobytes() == np.load(tmp_path / "run.npy").tobytes()
    # The forces of the run, computed again.
    ticks = samples[samples["status"] != 3]
    at = np.stack([ticks["x_mm"], ticks["y_mm"], ticks["z_mm"]], axis=-1)
    forces = np.stack([ticks["law_fx_N"], ticks["law_fy_N"], ticks["law_fz_N"]], axis=-1)
    assert same_bits(forceshade.Law("wall", stiffness=0.5).forces(at), forces)
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    frame = forceshade.read_recording(path, frame=True).samples
    assert isinstance(frame, pandas.DataFrame) and len(frame) == len(samples)
    with open(path, "r+b") as file:
        file.truncate(6000)
    with pytest.raises(forceshade.Error, match="run.fsr"):
        forceshade.read_recording(path)
