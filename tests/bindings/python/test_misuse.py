# SPDX-License-Identifier: BSD-3-Clause
"""Refusals, and the sentence that says why."""

import copy
import ctypes
import threading
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from conftest import ROOT, TETRAHEDRON, positions

import forceshade

F = np.float32


def refused(kind, words, call, *arguments, **keywords):
    with pytest.raises(kind) as caught:
        call(*arguments, **keywords)
    assert words in str(caught.value), str(caught.value)
    assert "\n" not in str(caught.value) and "incompatible" not in str(caught.value)


class GivesMask:
    """As a variable of a netCDF file does."""

    def __array__(self, dtype=None, copy=None):
        return np.ma.array([1, 2, 3], mask=[0, 0, 1])


@pytest.mark.parametrize(
    "at, kind, words",
    [
        (np.zeros((2, 4), F), ValueError, "positions have the shape (2, 4); expected (..., 3): x, y, z in mm"),
        (F(1), ValueError, "positions have the shape (); expected (..., 3)"),
        ([[1, 2, 3], [1, 2]], ValueError, "positions are lists of different lengths"),
        ([["a", "b", "c"]], TypeError, "positions are of type <U1; expected numbers"),
        (np.zeros((2, 3), complex), TypeError, "positions are of type complex128"),
        (np.zeros((2, 3), bool), TypeError, "positions are of type bool"),
        (None, TypeError, "positions are objects of NoneType; expected numbers"),
        ([[Fraction(1, 3), Decimal(1), 2]], TypeError, "positions are objects of Decimal, Fraction, int; expected numbers"),
        (np.full((2, 3), 1.0, object), TypeError, "expected numbers, in an array such as numpy.array(positions, float)"),
        (np.ma.zeros((2, 3), F), TypeError, "expected one without a mask, such as positions.filled(numpy.nan)"),
        ([np.ma.zeros(3, F)], TypeError, "positions are a masked array"),
        ([[np.ma.zeros(3, F)]], TypeError, "positions are a masked array"),
        ([[0, np.ma.masked, 1]], TypeError, "positions are a masked array"),
        (GivesMask(), TypeError, "positions are a masked array"),
    ],
)
def test_positions(bump, at, kind, words):
    refused(kind, words, bump.forces, at)
    refused(kind, words, bump.answers, at)
    refused(kind, words, forceshade.Session(bump).steps, at)
    refused(kind, words, bump.reference_forces, at)


def read_only(array):
    array.flags.writeable = False
    return array


def test_out(bump):
    at = positions(100)
    whole = np.zeros((101, 3), F)
    for out, kind, words in [
        (np.zeros((100, 3)), TypeError, "out is of type float64; expected float32"),
        (np.zeros((99, 3), F), ValueError, "out has the shape (99, 3); expected (100, 3)"),
        (read_only(np.zeros((100, 3), F)), ValueError, "out is read-only; expected an array that can be written"),
        ([[0, 0, 0]], TypeError, "out: expected a NumPy array, got list"),
        (np.lib.stride_tricks.as_strided(np.zeros(3, F), (100, 3), (0, 4)), ValueError, "out has axes that overlap or interleave"),
        (np.lib.stride_tricks.as_strided(np.zeros(102, F), (100, 3), (4, 4)), ValueError, "out has axes that overlap or interleave"),
        (np.lib.stride_tricks.as_strided(np.zeros(999, F), (100, 3), (8, -4)), ValueError, "out has axes that overlap or interleave"),
    ]:
        refused(kind, words, bump.forces, at, out=out)
        refused(kind, words, forceshade.Session(bump).steps, at, out=out)
    refused(ValueError, "out and positions overlap; expected the very same array", bump.forces, whole[:-1], out=whole[1:])
    refused(ValueError, "out and positions overlap", bump.forces, at, out=at[::-1])
    unaligned = np.zeros(100, [("late", np.uint8), ("force", F, 3)])["force"]
    refused(ValueError, "out is not aligned", bump.forces, at, out=unaligned)


def test_statuses(bump):
    at, out = positions(100), np.zeros((100, 3), F)
    refused(TypeError, "status is of type int64; expected uint8", bump.forces, at, status=np.zeros(100, int))
    refused(ValueError, "status has the shape (99,); expected (100,)", bump.forces, at, status=np.zeros(99, np.uint8))
    refused(ValueError, "status is read-only", bump.forces, at, status=read_only(np.zeros(100, np.uint8)))
    inside = out.view(np.uint8).reshape(-1)[:100]
    refused(ValueError, "status overlaps the positions or out", bump.forces, at, out=out, status=inside)


def test_one_position(bump):
    for call in (bump.force, forceshade.Session(bump).step):
        refused(TypeError, "y: expected a number in mm, got '1'", call, 0, "1", 0)
        refused(TypeError, "x: expected a number in mm, got None", call, None, 0, 0)
        refused(TypeError, "x: expected a number in mm, got True", call, True, 0, 0)
        refused(TypeError, "x: expected a number in mm, got 1j", call, 1j, 0, 0)
        refused(TypeError, "x: expected a number in mm, got True", call, np.True_, 0, 0)
        refused(TypeError, "x: expected a number in mm, got masked", call, np.ma.masked, 0, 0)
        refused(ValueError, "z: expected -2^53 to 2^53 mm", call, 0, 0, 10**30)
        refused(TypeError, "expected three numbers x, y, z in mm", call, 1, 2)
        refused(TypeError, "forces() takes arrays of positions", call, [1, 2, 3])
        refused(TypeError, "expected the keywords x, y, z and rounding, got out", call, 1, 2, 3, out=3)
        refused(ValueError, "rounding: expected \"nearest\" or None, got 'up'", call, 1, 2, 3, rounding="up")
        refused(TypeError, 'rounding: expected "nearest" or None, got 1', call, 1, 2, 3, rounding=1)
    refused(ValueError, "rounding: expected \"nearest\" or None, got 'up'", bump.forces, [[1, 2, 3]], rounding="up")


def test_laws():
    law = forceshade.Law
    good = dict(radius=15.24, width=25.4, stiffness=0.5)
    refused(ValueError, "law: expected one of wall, cylinder", law, "bump", **good)
    refused(ValueError, 'got "bump"', law, "bump", **good)
    refused(TypeError, "law: expected a word, got 3", law, 3, **good)
    refused(ValueError, "radius is 0.01 mm; expected 0.1 to 10000 mm", law, "bump-1p", **{**good, "radius": 0.01})
    refused(ValueError, "width is 31 mm; expected 0.001 to 30.48 mm", law, "bump-1p", **{**good, "width": 31})
    refused(ValueError, "stiffness is 0 N/mm; expected 0.001 to 1000 N/mm", law, "wall", stiffness=0)
    refused(ValueError, "radius: expected a length such as", law, "bump-1p", **{**good, "radius": "15 kg"})
    refused(ValueError, 'got "nan"', law, "wall", stiffness=float("nan"))
    refused(ValueError, 'stiffness: expected a stiffness such as 0.5, 0.5N/mm or 500N/m, got "1mm"', law, "wall", stiffness="1mm")
    refused(TypeError, "radius: expected a number or a text such as", law, "bump-1p", **{**good, "radius": [1]})
    refused(ValueError, "radius: expected a number that binary64 holds", law, "bump-1p", **{**good, "radius": 10**400})
    refused(TypeError, "the wall has no width", law, "wall", width=3, stiffness=1)
    refused(TypeError, "unexpected keyword argument 'diameter'", law, "wall", diameter=3, stiffness=1)
    refused(forceshade.Error, "the wall has no geometry", law("wall", stiffness=1).geometry)


def test_height_maps(tmp_path):
    flat, make = np.zeros((4, 4), F), forceshade.HeightMap
    refused(TypeError, "heights are of type complex128", make, np.zeros((4, 4), complex), pitch=1, stiffness=1)
    refused(TypeError, "heights need their pitch", make, flat, stiffness=1)
    refused(ValueError, "heights have the shape (4,); expected (rows, columns)", make, flat[0], pitch=1, stiffness=1)
    refused(ValueError, "heights have the shape (1, 4); expected 2 to 32768", make, flat[:1], pitch=1, stiffness=1)
    refused(ValueError, "heights[2, 1] is nan", make, np.where(np.arange(16).reshape(4, 4) == 9, F("nan"), flat), pitch=1, stiffness=1)
    refused(ValueError, 'interpolant: expected "bilinear" or "cubic-spline", got "linear"', make, flat, pitch=1, stiffness=1,
            interpolant="linear")
    refused(ValueError, 'edge: expected "clamp" or "tile"', make, flat, pitch=1, stiffness=1, edge="wrap")
    refused(ValueError, 'render: expected "height-map", ', make, flat, pitch=1, stiffness=1, render="shaded")
    refused(ValueError, "pitch", make, flat, pitch=0, stiffness=1)
    refused(FileNotFoundError, "No such file", make, tmp_path / "none.toml", stiffness=1)
    refused(TypeError, "a picture needs pitch and scale", make, ROOT / "examples/leather.png", pitch=1, stiffness=1)
    refused(TypeError, "says edge itself", make, ROOT / "examples/leather.toml", edge="tile", stiffness=1)
    (tmp_path / "bad.toml").write_text("[[part]]\nshape = 'cube'\n")
    refused(forceshade.Error, "bad.toml", make, tmp_path / "bad.toml", stiffness=1)


def test_meshes(tmp_path):
    vertices, triangles = TETRAHEDRON
    make = forceshade.Mesh
    mesh = make(vertices, triangles, stiffness=1)
    refused(forceshade.Error, "the force of a mesh depends on the path", mesh.force, 1, 2, 3)
    refused(forceshade.Error, "the force of a mesh depends on the path", mesh.forces, [[1, 2, 3]])
    refused(forceshade.Error, "the force of a mesh depends on the path", mesh.reference, 1, 2, 3)
    refused(ValueError, "triangles[0, 2] is 4; expected the number of a vertex, 0 to 3", make, vertices, [[0, 1, 4]], stiffness=1)
    refused(ValueError, "triangles[0, 0] is -1", make, vertices, [[-1, 1, 2]], stiffness=1)
    refused(TypeError, "triangles are of type float64; expected integers", make, vertices, [[0.0, 1, 2]], stiffness=1)
    refused(TypeError, "vertices need their triangles", make, vertices, stiffness=1)
    refused(TypeError, "vertices are of type complex128", make, vertices.astype(complex), triangles, stiffness=1)
    refused(ValueError, 'shading: expected "none", "vertex" or "edge", got "flat"', make, vertices, triangles, stiffness=1, shading="flat")
    refused(ValueError, "crease is 200", make, vertices, triangles, stiffness=1, crease=200)
    with pytest.raises(ValueError, match="the mesh cannot be rendered: .*face") as caught:
        make(np.zeros((4, 3)), triangles, stiffness=1)
    assert not str(caught.value).endswith("\n")
    refused(TypeError, "a mesh file does not say its unit", make, ROOT / "tests/golden/god_object/cube.off", stiffness=1)
    refused(FileNotFoundError, "No such file", make, tmp_path / "none.off", unit="mm", stiffness=1)


def test_subjects_and_recordings_of_files(tmp_path):
    refused(FileNotFoundError, "No such file", forceshade.read_subject, tmp_path / "none.toml")
    refused(FileNotFoundError, "No such file", forceshade.read_recording, tmp_path / "none.fsr")
    (tmp_path / "text.fsr").write_text("no recording")
    refused(forceshade.Error, "text.fsr", forceshade.read_recording, tmp_path / "text.fsr")
    (tmp_path / "law.toml").write_text('law = "bump-2p"\nradius = "600kg"\n')
    refused(forceshade.Error, "law.toml: line 2: radius", forceshade.read_subject, tmp_path / "law.toml")


def test_exact_forces(bump):
    refused(ValueError, "digits is 0; expected 1 to 10000", bump.reference, 0, 0, 0, digits=0)
    refused(TypeError, "digits: expected an integer, got 2.5", bump.reference, 0, 0, 0, digits=2.5)
    refused(ValueError, "width is 3 mm; expected 0.001 to 2 mm", forceshade.geometry, radius=1, width=3)


def test_a_subject_whose_init_has_not_run():
    refused(TypeError, "force() needs a subject whose __init__ has run", forceshade.Law.__new__(forceshade.Law).force, 1, 2, 3)
    refused(TypeError, "step() needs a session whose __init__ has run", forceshade.Session.__new__(forceshade.Session).step, 1, 2, 3)


    for subject in (forceshade.Law.__new__(forceshade.Law), forceshade.Mesh.__new__(forceshade.Mesh)):
        for call in (lambda: subject.forces([[0, 0, 1]]), lambda: subject.digest, lambda: repr(subject), lambda: subject == subject):
            refused(TypeError, "expected an object whose __init__ has run", call)
    refused(TypeError, "expected an object whose __init__ has run", lambda: forceshade.Session.__new__(forceshade.Session).status)


def test_what_is_no_ascii_is_named_and_cut_behind_a_character(tmp_path):
    for before in ("", "a", "ab", "abc"):
        word = before + "\N{HOT BEVERAGE}" * 30
        refused(ValueError, f'got "{before}\N{HOT BEVERAGE}', forceshade.Law, word)
        (tmp_path / "mesh.off").write_text(f"OFF\n3 1 0\n0 0 {word}\n")
        refused(forceshade.Error, f'mesh.off: line 3: expected a coordinate, got "{before}\N{HOT BEVERAGE}',
                forceshade.Mesh, tmp_path / "mesh.off", unit="mm")  # fmt: skip
    (tmp_path / "mesh.off").write_bytes(b"OFF\n3 1 0\n0 0 \xff\xfe\n" + 30 * b" ")
    refused(forceshade.Error, r'expected a coordinate, got "\xff\xfe"', forceshade.Mesh, tmp_path / "mesh.off", unit="mm")
    refused(ValueError, "stiffness: expected characters that UTF-8 has, got '\\udcff'", forceshade.Law, "wall", stiffness="\udcff")
    refused(ValueError, "law: expected characters that UTF-8 has, got '\\udcff'", forceshade.Law, "\udcff")
    refused(ValueError, "shading: expected characters that UTF-8 has", forceshade.Mesh, *TETRAHEDRON, shading="texture:\udcff")


def test_a_state_has_whole_numbers(bump):
    for wrong in (forceshade.State(place=1.5), forceshade.State(place="1"), forceshade.State(side=0.5), forceshade.State(meeting=None)):
        refused(TypeError, "state: expected one that a session gave", forceshade.Session(bump).resume, wrong)


def test_masks_are_not_dropped():
    refused(TypeError, "triangles are a masked array", forceshade.Mesh, TETRAHEDRON[0], np.ma.array(TETRAHEDRON[1]))
    refused(TypeError, "materials are a masked array",
            forceshade.Mesh, *TETRAHEDRON, materials=([{"friction": 0.5}], np.ma.zeros(4, int)))  # fmt: skip
    damped = forceshade.Session(forceshade.Law("wall"), damping=forceshade.Damping(1000, 0.001))
    refused(TypeError, "periods are a masked array", damped.steps, np.zeros((2, 3), F), periods=np.ma.array([1, 2]))


def test_no_complex_number_and_no_truth_is_a_quantity():
    refused(ValueError, "friction: expected a number that binary64 holds", forceshade.Mesh, *TETRAHEDRON, friction=np.longdouble("1e400"))
    for number in (np.complex64(0.5), np.complex128(0.5 + 3j), 0.5j):
        refused(TypeError, "stiffness: expected a number or a text such as", forceshade.Law, "wall", stiffness=number)
        refused(TypeError, "x: expected a number in mm, got", forceshade.Law("wall").force, number, 0, 0)
        refused(TypeError, "damping: expected a number, got", forceshade.Damping, 1000, number)
    refused(TypeError, "time: expected a number, got False", forceshade.Damping, 1000, time=False)
    for huge in (1e39, 10**39, 10**400):
        refused(ValueError, f"most is {huge}; expected a number that binary32 holds", forceshade.Damping, 1000, most=huge)


def test_copies(bump):
    assert copy.copy(bump) is bump and copy.deepcopy([bump])[0] is bump
    refused(TypeError, "a Session cannot be pickled or copied", copy.copy, forceshade.Session(bump))


def test_a_thread_that_rounds_otherwise(bump):
    session, libm = forceshade.Session(bump), ctypes.CDLL("libm.so.6")

    def use():
        libm.fesetround(0x800)  # upwards, on x86
        states = np.zeros(1, forceshade.STATE)
        for call in (bump.forces, bump.answers, session.steps, lambda at: bump.advance(states, at)):
            refused(forceshade.Error, "expected the arithmetic of IEEE 754, rounded to nearest", call, [[0, 0, -1]])
        refused(forceshade.Error, "expected the arithmetic of IEEE 754", forceshade.Session, bump)
        refused(forceshade.Error, "expected the arithmetic of IEEE 754", forceshade.Damping, 1000)
        refused(forceshade.Error, "expected the arithmetic of IEEE 754", forceshade.Law, "wall", stiffness=1)
        refused(forceshade.Error, "expected the arithmetic of IEEE 754", forceshade.properties, bump, cases=1)
        failed.clear()

    failed = [True]
    thread = threading.Thread(target=use)  # its own mode, which ends with it
    thread.start()
    thread.join()
    assert not failed
    assert bump.forces([[0, 0, -1]])[0, 2] > 0


def test_sessions(bump, tetrahedron):
    session = forceshade.Session(bump)
    refused(TypeError, "expected a Law, HeightMap or Mesh, got int", forceshade.Session, 3)
    refused(TypeError, "expected the state of a session, got int", session.resume, 3)
    inside = forceshade.Session(tetrahedron)
    inside.step(2, 2, -1)
    inside.step(2, 2, 1)
    refused(forceshade.Error, "the state is that of a mesh's session", session.resume, inside.state)
    refused(ValueError, "state: expected one that a session gave", inside.resume, forceshade.State(place=9))
    refused(TypeError, "state: expected one that a session gave", inside.resume, forceshade.State(index=(-1, 0)))


def test_two_threads_in_one_session(tetrahedron):
    session = forceshade.Session(tetrahedron)
    at = np.tile(np.array([[2, 2, -1], [2, 2, 1]], F), (100_000, 1))
    started, ended = threading.Event(), threading.Event()

    def follow():
        started.set()
        session.steps(at)
        ended.set()

    thread = threading.Thread(target=follow)
    thread.start()
    started.wait()
    words = set()
    while not ended.is_set():
        try:
            session.step(2, 2, 1)
            session.state
        except forceshade.Error as error:
            words.add(str(error))
            break
    for call in (session.reset, lambda: session.steps(at[:2]), lambda: session.state):
        try:
            call()
        except forceshade.Error as error:
            words.add(str(error))
    thread.join()
    assert words == {"another thread is in this session; expected one thread at a time, or a session for each"}
    assert session.step(2, 2, 1)[2] == -0.5  # it goes on
