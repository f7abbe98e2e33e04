# SPDX-License-Identifier: BSD-3-Clause
"""forceshade.conform: renderers in Python, right ones and wrong ones."""

import doctest
import json
import os
import re
import subprocess
import sys

import forceshade
import forceshade._conform
import numpy as np
import pytest

DECLARES = {
    "memory": "none",
    "answers": "force",
    "claims": "definition",
    "length_unit": "mm",
    "force_unit": "N",
    "frame": ["x", "y", "z"],
    "domain_mm": 10000,
    "rate_Hz": None,
    "loop_energy_mJ": 0,
}
WALL = forceshade.Law("wall", stiffness=0.75)
TETRAHEDRON = forceshade.Mesh(
    np.array([[0, 0, 0], [90, 0, 0], [0, 90, 0], [0, 0, 90]], dtype=np.float32),
    np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]),
    stiffness=0.5,
    shading="none",
)


def wall(positions):
    forces = np.zeros_like(positions)
    touches = (abs(positions) <= 10000).all(axis=1) & (positions[:, 2] <= -(2.0**-30))
    forces[touches, 2] = -0.75 * positions[touches, 2]
    return forces


def one_wall(x, y, z):
    is_there = all(abs(coordinate) <= 10000 for coordinate in (x, y, z)) and z <= -(2.0**-30)
    return (0, 0, -0.75 * z if is_there else 0)


def conformed(renderer, subject=WALL, declares=DECLARES, **options):
    return forceshade.conform(renderer, subject, declares=declares, points=2000, **options)


class Ticks:
    """The package's own renderer of meshes, opened on a scene."""

    def __init__(self, scene):
        mesh, its = scene["mesh"], scene["parameters"]
        vertices = [[float.fromhex(number) for number in vertex] for vertex in mesh["vertices_mm"]]
        self._mesh = forceshade.Mesh(
            np.array(vertices, dtype=np.float32),
            np.array(mesh["triangles"]),
            stiffness=its["stiffness_N_per_mm"],
            sides=its["sides"],
            shading="none",
        )

    def answers(self, positions, reset):
        if reset:
            self._session = forceshade.Session(self._mesh)
        return self._session.steps(positions)


class OwnMeshes:
    def open(self, scene):
        return Ticks(scene)


MESHES = {**DECLARES, "memory": "path", "loop_energy_mJ": None, "sides": ["front"], "shading": ["none"], "proxy_radius_mm": 0}


def test_the_examples_of_the_docstrings():
    assert doctest.testmod(forceshade._conform).failed == 0


@pytest.mark.parametrize("renderer, options", [(wall, {}), (one_wall, {"vectorised": False})])
def test_a_right_function_holds(renderer, options):
    found = conformed(renderer, **options)
    assert found and found.held and found.applicable
    assert found.contents["exact"]["all"] == {"cases": 2000, "wrong": 0, "beyond_tolerance": 0}


def test_a_right_renderer_of_scenes_holds_on_all_that_concerns_meshes():
    found = conformed(OwnMeshes(), TETRAHEDRON, MESHES)
    assert found
    applicable = [one["name"] for one in found.contents["invariants"] if one["applicable"]]
    assert "a flat plate feels flat however it is triangulated" in applicable
    assert "a quarter turn of the scene about z turns the force" in applicable


def test_one_number_off_is_found_and_within_one_ulp():
    off = lambda positions: np.nextafter(wall(positions), np.float32(np.inf), where=wall(positions) > 0, out=wall(positions))
    assert not conformed(off)
    assert "to paste into a test" in str(conformed(off))
    assert conformed(off, tolerance="1 ulp")


def test_a_function_renders_one_scene():
    found = conformed(wall, TETRAHEDRON, {**MESHES, "memory": "none"})
    assert not found.held
    reasons = [one.get("reason", "") for one in found.contents["invariants"]]
    assert any("a function renders one scene" in reason for reason in reasons)


@pytest.mark.parametrize(
    "renderer, words",
    [
        (lambda positions: wall(positions).astype(float), "expected answers as float32, got float64"),
        (lambda positions: wall(positions)[:-1], "expected answers of the shape (1024, 3), got (1023, 3)"),
        (lambda positions: 1 / 0, "the renderer raised ZeroDivisionError: division by zero"),
        (lambda positions: None, "expected answers as float32, got object"),
        (lambda positions: wall(np.nan_to_num(positions)) * np.float32(np.nan), "any position gets a finite force"),
    ],
)
def test_what_a_wrong_function_does_is_part_of_the_result(renderer, words):
    found = conformed(renderer)
    assert not found and words in found.words


def test_an_error_without_words_and_a_hello_that_is_no_json_are_part_of_the_result():
    class Silent(Exception):
        def __str__(self):
            raise ValueError

    for error, words in [(Silent(), "the renderer raised Silent: (it does not say why)"), (ValueError("\udcff"), r"ValueError: \udcff")]:

        def fails(positions):
            raise error

        assert words in conformed(fails).words
    for key, value in {"rate_Hz": float("nan"), "\udcff": 1, "x": "\udcff"}.items():
        found = conformed(wall, declares={**DECLARES, key: value})
        assert not found and 'the renderer wrote "' in found.words and "expected a JSON object in one line" in found.words


def test_what_is_not_declared_is_not_guessed():
    for key in DECLARES:
        rest = {other: value for other, value in DECLARES.items() if other != key}
        assert f'has no key "{key}"; expected' in conformed(wall, declares=rest).words


def test_a_scene_that_it_does_not_render_never_holds():
    class Shy:
        def open(self, scene):
            raise NotImplementedError("it renders nothing")

    found = conformed(Shy())
    assert not found.held and not found.applicable and "it renders nothing" in found.words


def test_misuse():
    with pytest.raises(ValueError, match='got "3"'):
        conformed(wall, tolerance="3")
    with pytest.raises(TypeError, match="tolerance: expected a word, got 3"):
        conformed(wall, tolerance=3)
    with pytest.raises(TypeError, match="expected a function"):
        conformed(3)
    with pytest.raises(TypeError, match="expected a Law"):
        conformed(wall, subject="wall")
    with pytest.raises(ValueError, match="points is 0"):
        forceshade.conform(wall, WALL, declares=DECLARES, points=0)


LOCALE = """LC_CTYPE
tolower (<U0041>,<U0061>)
END LC_CTYPE
LC_NUMERIC
decimal_point ","
thousands_sep ""
grouping -1
END LC_NUMERIC
"""
IN_LOCALE = """
import json, locale, sys, forceshade
assert locale.setlocale(locale.LC_ALL, "odd") and locale.localeconv()["decimal_point"] == ","
open("one.stl", "w").write("SOLID one FACET NORMAL 0 0 1 OUTER LOOP\\nVERTEX 0 0 0\\nVERTEX 9 0 0\\nVERTEX 0 9 0\\n"
                           "ENDLOOP ENDFACET ENDSOLID")
mesh = forceshade.Mesh("one.stl", unit="mm", sides="both", shading="vertex")
class Renderer:
    def open(self, scene):
        print(scene["mesh"], flush=True)
        return lambda positions: positions * 0
forceshade.conform(Renderer(), mesh, declares=json.loads(sys.argv[1]), points=100)
print(forceshade.certify(mesh, points=100, cases=20).contents)
"""


def test_numbers_and_letters_are_those_of_no_locale(tmp_path):
    (tmp_path / "source").write_text(LOCALE)
    letters = "".join(f"<U{i:04X}> /x{i:02x}\n" for i in range(128))
    (tmp_path / "letters").write_text(f"<code_set_name> ASCII\nCHARMAP\n{letters}END CHARMAP\n")
    subprocess.run(["localedef", "-c", "-f", "./letters", "-i", "./source", "./odd"], cwd=tmp_path, capture_output=True)
    ran = subprocess.run([sys.executable, "-c", IN_LOCALE, json.dumps(MESHES)], cwd=tmp_path, capture_output=True, text=True,
                         env={**os.environ, "LOCPATH": str(tmp_path)})
    assert ran.returncode == 0, ran.stderr
    assert "0x1.2p+3" in ran.stdout and "mJ more" in ran.stdout and not re.search(r"\d,\d", ran.stdout), ran.stdout
