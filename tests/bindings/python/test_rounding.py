# SPDX-License-Identifier: BSD-3-Clause
"""Numbers that binary32 does not hold: rounded to the nearest, everywhere with the same warning, unless that was asked for."""

import subprocess
import sys
import warnings
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
from conftest import ROOT, TETRAHEDRON, positions, same_bits

import forceshade

LINE = np.linspace(-20, 20, 41)
OFF = np.stack([LINE, 0 * LINE, 0 * LINE - 0.1], axis=-1)  # binary64
HEIGHTS = np.full((3, 3), 0.1)


def places(bump):
    """Every place that takes numbers as binary32: a call, whose only argument is the rounding."""
    session, states = forceshade.Session(bump), np.zeros(41, forceshade.STATE)
    flat, scene = forceshade.HeightMap([[0, 0], [0, 0]], pitch=1), forceshade.Scene([bump])
    yield lambda rounding: bump.force(0.1, 0, 0, rounding=rounding)
    yield lambda rounding: bump.force(0, 0, 2**24 + 1, rounding=rounding)
    yield lambda rounding: session.step(0, np.float64(0.1), 0, rounding=rounding)
    yield lambda rounding: bump.forces(OFF, rounding=rounding)
    yield lambda rounding: bump.forces([[0, 0, 1], [0.1, 0, 0]], rounding=rounding)
    yield lambda rounding: bump.forces(np.array([[0, 0, 2**60 + 1]]), rounding=rounding)
    yield lambda rounding: bump.forces(np.array([[0, 0, -(2**60) - 1]]), rounding=rounding)
    yield lambda rounding: bump.forces(OFF.astype(np.longdouble), rounding=rounding)
    yield lambda rounding: bump.answers(OFF, rounding=rounding)
    yield lambda rounding: bump.advance(states, OFF, rounding=rounding)
    yield lambda rounding: bump.reference(0, 0.1, 0, rounding=rounding)
    yield lambda rounding: bump.reference_forces(OFF, rounding=rounding)
    yield lambda rounding: session.steps(OFF, rounding=rounding)
    yield lambda rounding: session.answers(OFF, rounding=rounding)
    yield lambda rounding: scene.step((0.1, 0, 0), [forceshade.Pose()], rounding=rounding)
    yield lambda rounding: scene.step((0, 0, 0), [forceshade.Pose((0.1, 0, 0))], rounding=rounding)
    yield lambda rounding: forceshade.HeightMap(HEIGHTS, pitch=1, rounding=rounding)
    yield lambda rounding: flat.height(0.1, 0, rounding=rounding)
    yield lambda rounding: forceshade.Mesh(TETRAHEDRON[0].astype(np.float64) + 0.1, TETRAHEDRON[1], rounding=rounding)


@pytest.mark.parametrize("index", range(19))
def test_every_place_says_so_once_in_the_line_that_calls(bump, index):
    call = list(places(bump))[index]
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        call(None)
    (one,) = said
    assert one.category is forceshade.RoundingWarning and one.filename == __file__
    assert "was rounded to the nearest that it holds" in str(one.message) and 'rounding="nearest"' in str(one.message)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        call("nearest")
        with pytest.raises(forceshade.RoundingWarning, match="was rounded to the nearest"):
            call(None)


def test_the_rounded_number_is_the_nearest(bump):
    with pytest.warns(forceshade.RoundingWarning):
        forces = bump.forces(OFF)
    assert same_bits(forces, bump.forces(OFF.astype(np.float32)))
    with pytest.warns(forceshade.RoundingWarning):
        one = bump.force(0.1, 0, -0.1)
    assert one == bump.force(np.float32(0.1), 0, np.float32(-0.1))
    with pytest.warns(forceshade.RoundingWarning):
        assert bump.answers([[0, 0, 1e300]])["status"].tolist() == [forceshade.Status.INVALID]


TIE = Fraction(1) + Fraction(1, 2**24)  # between 1 and 1 + 2^-23, of which 1 is even
FAR = Fraction(1, 2**70)  # further than binary64 sees


@pytest.mark.parametrize("number, nearest", [(TIE, 1), (TIE - FAR, 1), (TIE + FAR, 1 + 2**-23), (1 + FAR, 1), (1 - FAR, 1)])
def test_a_number_that_binary64_does_not_hold_is_rounded_once(number, nearest):
    wall, flat = forceshade.Law("wall", stiffness=1), forceshade.Mesh([[-9, -9, 0], [9, -9, 0], [9, 9, 0]], [[0, 1, 2]], stiffness=1)
    touching = forceshade.Session(flat)
    touching.step(1, 0, 1)
    with pytest.warns(forceshade.RoundingWarning):
        assert wall.force(0, 0, -number)[2] == nearest
    with pytest.warns(forceshade.RoundingWarning):
        assert touching.step(1, 0, -number)[2] == nearest
    assert forceshade.Law("wall", stiffness=number).stiffness == nearest
    assert forceshade.Law("cylinder", radius=number, width=1).radius == nearest
    assert np.float32(forceshade.Damping(1000, damping=number).damping) == nearest
    assert forceshade.Mesh(*TETRAHEDRON, friction=number) == forceshade.Mesh(*TETRAHEDRON, friction=float(nearest))


def test_a_long_double_and_a_binary64_number_at_a_tie_are_rounded_once():
    above = np.longdouble(1) + np.longdouble(2) ** -24 + np.longdouble(2) ** -60
    wall = forceshade.Law("wall", stiffness=1)
    for number, nearest in [(above, 1 + 2**-23), (2 - above, 1 - 2**-24), (1 + 2**-24, 1), (np.float64(1 + 2**-24), 1)]:
        assert forceshade.Law("wall", stiffness=number).stiffness == nearest
        assert wall.force(0, 0, -number, rounding="nearest")[2] == nearest
        assert forceshade.HeightMap(np.zeros((2, 2)), pitch=number) == forceshade.HeightMap(np.zeros((2, 2)), pitch=nearest)


def test_what_binary32_holds_is_taken_without_a_word(bump):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        at = positions().astype(np.float64)  # some are not a number
        assert same_bits(bump.forces(at), bump.forces(positions()))
        for kind in (np.int8, np.uint8, np.int64, np.uint64, np.float16, np.longdouble):
            assert same_bits(bump.forces(np.array([[3, 0, 1]], kind)), bump.forces([[3, 0, 1]]))
        bump.forces([[0.5, float("nan"), 2**24]])
        bump.force(0.5, float("nan"), 2**24)
        forceshade.HeightMap(np.zeros((3, 3)), pitch=0.1)  # a pitch is a parameter, which stands for the nearest number
        forceshade.Law("bump-1p", radius=15.1)


def test_one_number_among_many_is_found(bump):
    at = np.zeros((1000, 3))
    at[900, 1] = 0.1
    with pytest.warns(forceshade.RoundingWarning):
        bump.forces(at)


def test_python_shows_it_once_for_each_line_of_a_program(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(
        "import forceshade\n"
        "bump = forceshade.Law('bump-2p')\n"
        "for i in range(5):\n"
        "    bump.force(i / 10, 0, 0)\n"
        "    bump.forces([[0, 0, i / 10]])\n"
    )
    ran = subprocess.run([sys.executable, program], capture_output=True, text=True)
    said = [line for line in ran.stderr.splitlines() if "RoundingWarning" in line]
    assert ran.returncode == 0 and [line.split(": ")[0] for line in said] == [f"{program}:4", f"{program}:5"], ran.stderr


def test_the_page_plots_a_bump_in_five_lines():
    pyplot = pytest.importorskip("matplotlib.pyplot", reason="matplotlib is not installed")
    pyplot.switch_backend("Agg")
    lines = (ROOT / "docs" / "python.md").read_text().split("```python\n")[1].split("```")[0]
    assert len(lines.strip().splitlines()) == 5 and "astype" not in lines and "float32" not in lines
    shown = []
    with pytest.warns(forceshade.RoundingWarning):
        exec(lines.replace("plt.show()", "shown.append(plt.gca().lines[0].get_ydata())"), {"shown": shown})
    assert abs(shown[0].max() - 6.8) < 0.1


def test_whatever_has_a_float_is_a_number_and_what_its_methods_raise_is_raised():
    wall = forceshade.Law("wall", stiffness=0.5)
    expected = wall.force(0, 0, -0.5)
    for number in (Decimal("-0.5"), np.array(-0.5), np.longdouble(-0.5), Fraction(-1, 2)):
        assert wall.force(0, 0, number) == expected

    class Interrupted:
        def __float__(self):
            return -0.5

        def __eq__(self, other):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        wall.force(0, 0, Interrupted())

    def deeper():
        wall.force(0, 0, Fraction(1, 3), rounding="nearest")
        deeper()

    with pytest.raises(RecursionError):
        deeper()
