# SPDX-License-Identifier: BSD-3-Clause
"""Arrays wherever they lie: the same bits, and no copy."""

import pathlib
import subprocess
import sys
import tracemalloc

import numpy as np
import pytest
from conftest import positions, same_bits

import forceshade


def layouts(at):
    """The same positions in other places of memory."""
    yield "fortran", np.asfortranarray(at)
    apart = np.zeros((len(at), 2, 5), np.float32)
    apart[:, 1, 1:4] = at
    yield "apart", apart[:, 1, 1:4]
    yield "backwards", np.ascontiguousarray(at[::-1])[::-1]
    yield "components backwards", np.ascontiguousarray(at[:, ::-1])[:, ::-1]
    records = np.zeros(len(at), [("tick", np.uint32), ("position", np.float32, 3)])
    records["position"] = at
    yield "records", records["position"]
    unaligned = np.zeros(len(at), [("late", np.uint8), ("position", np.float32, 3)])
    unaligned["position"] = at
    yield "unaligned", unaligned["position"]
    yield "other byte order", at.astype(">f4")
    yield "halves", None


@pytest.mark.parametrize("index", range(7))
def test_every_layout_gives_the_same_bits(bump, index):
    at = positions(3000)
    name, laid = list(layouts(at))[index]
    assert same_bits(bump.forces(laid), bump.forces(at)), name
    assert same_bits(forceshade.Session(bump).steps(laid), bump.forces(at)), name


def test_every_shape_is_taken(bump):
    at = positions(2400)
    expected = bump.forces(at)
    for shape in ((2400, 3), (2, 1200, 3), (4, 5, 120, 3), (1, 2400, 1, 3)):
        answers = bump.answers(at.reshape(shape))
        assert answers.shape == shape[:-1]
        assert same_bits(answers["force"].reshape(-1, 3), expected)
    swapped = np.swapaxes(at.reshape(40, 60, 3), 0, 1)
    assert same_bits(bump.forces(swapped), np.swapaxes(expected.reshape(40, 60, 3), 0, 1))
    every_other = at.reshape(40, 60, 3)[::-2, 1::3]
    assert same_bits(bump.forces(every_other), expected.reshape(40, 60, 3)[::-2, 1::3])
    assert bump.forces(at[0]).shape == (3,)
    assert bump.forces(np.zeros((0, 3), np.float32)).shape == (0, 3)
    assert bump.forces(np.zeros((5, 0, 3), np.float32)).shape == (5, 0, 3)
    assert same_bits(bump.forces(np.broadcast_to(at[1], (7, 3))), np.broadcast_to(expected[1], (7, 3)))


def test_one_record_is_taken_whatever_its_length(bump):
    record = np.zeros(1, np.dtype({"names": ["position"], "formats": [(np.float32, 3)], "offsets": [4], "itemsize": 17}))
    record["position"] = [3, 0, -0.5]
    assert same_bits(bump.forces(record["position"])[0], bump.force(3, 0, -0.5))


def test_nothing_is_copied(bump):
    at = positions(200_000)
    out, status = np.empty_like(at), np.empty(len(at), np.uint8)
    for laid in (at, np.asfortranarray(at), at[::-1], at[::2]):
        bump.forces(laid, out=out[: len(laid)], status=status[: len(laid)])  # whatever is made once has been made
        tracemalloc.start()
        bump.forces(laid, out=out[: len(laid)], status=status[: len(laid)])
        most = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert most < 20_000


def test_out_is_given_back_and_may_be_the_positions(bump):
    at = positions()
    expected, out = bump.forces(at), np.full(at.shape, 7, np.float32)
    assert bump.forces(at, out=out) is out
    assert same_bits(out, expected)
    spaced = np.full((len(at), 6), 7, np.float32)
    bump.forces(at, out=spaced[:, ::2])
    assert same_bits(spaced[:, ::2], expected) and (spaced[:, 1::2] == 7).all()
    status = np.empty(len(at), np.uint8)
    place = at.copy()
    assert bump.forces(place, out=place, status=status) is place
    assert same_bits(place, expected)
    assert (status == bump.answers(at)["status"]).all()
    # Two fields of one array lie between one another and do not overlap.
    both = np.zeros(len(at), [("position", np.float32, 3), ("force", np.float32, 3)])
    both["position"] = at
    bump.forces(both["position"], out=both["force"])
    assert same_bits(both["force"], expected) and same_bits(both["position"], at)


def test_lists_and_numbers_of_python_are_taken_where_binary32_holds_them(bump):
    assert bump.forces([[3, 0, -0.5]]).tolist() == [list(bump.force(3, 0, -0.5))]
    assert bump.force(np.float32(0.1), 0, 0) == bump.force(0.1, 0, 0, rounding="nearest")
    assert same_bits(bump.forces([[0.1, 0, 0]], rounding="nearest")[0], bump.force(np.float32(0.1), 0, 0))
    assert same_bits(bump.forces(np.array([[3, 0, -1]])), bump.forces([[3, 0, -1]]))
    at = positions()
    assert same_bits(bump.forces(at.astype(np.float64), rounding="nearest"), bump.forces(at))
    assert same_bits(bump.forces(at.astype(np.float16)), bump.forces(at.astype(np.float16).astype(np.float32)))
    assert bump.force(float("nan"), 0, -1) == (0, 0, 0)
    assert bump.answers([[float("nan"), 0, -1], [1e300, 0, 0]], rounding="nearest")["status"].tolist() == [2, 2]


def test_heights_below_the_least_are_0(tmp_path):
    heights = np.zeros((8, 8), np.float32)
    heights[4, 4], tiny = 1, heights + np.float32(1e-22)
    tiny[4, 4] = 1
    for interpolant in ("bilinear", "cubic-spline"):
        one = forceshade.HeightMap(heights, pitch=1, stiffness=0.5, interpolant=interpolant)
        assert one.digest == forceshade.HeightMap(tiny, pitch=1, stiffness=0.5, interpolant=interpolant).digest
    # Its coefficients become as small as one likes.
    far = np.zeros((3, 64), np.float32)
    far[:, 0] = 1
    np.save(tmp_path / "far.npy", far)
    of_file = forceshade.HeightMap(tmp_path / "far.npy", pitch=1, scale=1, stiffness=0.5)
    assert of_file.digest == forceshade.HeightMap(far, pitch=1, stiffness=0.5).digest


def test_heights_lie_anywhere():
    heights = np.random.default_rng(2).uniform(-1, 1, (20, 30)).astype(np.float32)
    apart = np.zeros((20, 60), np.float32)
    apart[:, ::2] = heights
    at = positions(500)
    one = forceshade.HeightMap(heights, pitch=0.5, stiffness=0.5)
    for same in (np.asfortranarray(heights), apart[:, ::2], heights[::-1].copy()[::-1], heights.astype(np.float64)):
        other = forceshade.HeightMap(same, pitch="0.5mm", stiffness="500N/m", rounding="nearest")
        assert other.digest == one.digest and len(one.digest) == 64
        assert same_bits(one.forces(at), other.forces(at))


WITHOUT_THE_TABLE = """
import numpy
try:
    from numpy._core import _multiarray_umath, multiarray
except ImportError:  # NumPy 1
    from numpy.core import _multiarray_umath, multiarray
for holder in (_multiarray_umath, multiarray):
    vars(holder).pop("_ARRAY_API", None)

import forceshade
law = forceshade.Law("bump-2p")
at = numpy.array([[3, 0, -0.5], [0, 0, 5]], numpy.float32)
assert law.forces(at).tolist() == [list(law.force(*position)) for position in at.tolist()]
assert (law.answers(at) == law.reference_forces(at)).all()
mesh = forceshade.Mesh([[-9, -9, 0], [9, -9, 0], [9, 9, 0]], [[0, 1, 2]])
assert mesh.advance(numpy.zeros(2, forceshade.STATE), at).shape == mesh.vertices[:2].shape
assert forceshade.HeightMap(numpy.eye(3, dtype=numpy.float32), pitch=1).height(0, 0) == 1
"""


def test_the_compiled_module_does_not_use_numpys_binary_interface():
    """NumPy 2 has another one than NumPy 1; a module that uses it looks for its table by this name."""
    module = pathlib.Path(forceshade._forceshade.__file__)
    assert b"_ARRAY_API" not in module.read_bytes()
    ran = subprocess.run([sys.executable, "-c", WITHOUT_THE_TABLE], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
