# SPDX-License-Identifier: BSD-3-Clause
"""The same renderer through each door: files, a process, a shared object and a function of Python. What is found has to be the
same. It is the wall of examples/renderers/, right, and wrong in one thing."""

import csv
import json
import shutil
import subprocess
import sys

import numpy as np
import pytest

import forceshade
from conftest import ROOT, command
from test_conform import DECLARES

RENDERERS = ROOT / "examples" / "renderers"
ASKED = ["--law", "wall", "--stiffness", "0.5", "--seed", "7", "--points", "5000"]

# Planted faults: words of examples/renderers/wall.py and of wall.c, and those in their place.
WRONG_IN = {
    "nothing": ([], []),
    "the last bit": ([("stiffness * -z", "stiffness * -z * (1 + 2.0**-23)")],
                     [("stiffness * -z", "(float)((double)stiffness * -z * (1 + 0x1p-23))")]),
    "the surface": ([("z <= -(2.0**-30)", "z <= 0.25")], [("z <= -0x1p-30f", "z <= 0.25f")]),
    "the domain": ([("10_000", "20_000")], [("1e4f", "2e4f")]),
}


def changed(name, replacements):
    text = (RENDERERS / name).read_text()
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new)
    return text


def run(*words):
    found = subprocess.run([command(), *words, "--json", "-"], capture_output=True, text=True, check=False)
    assert found.returncode in (0, 1), found.stderr
    return json.loads(found.stdout)


def through_files(force, folder):
    asked, mine = folder / "asked.csv", folder / "mine.csv"
    subprocess.run([command(), "conform", "positions", *ASKED, "--out", asked], check=True)
    with open(asked, newline="") as file, open(mine, "w", newline="") as out:
        rows = csv.DictReader(file)
        writer = csv.writer(out)
        writer.writerow([*rows.fieldnames, "fx_N", "fy_N", "fz_N"])
        for row in rows:
            at = (float(np.float32(row[name])) for name in ("x_mm", "y_mm", "z_mm"))
            writer.writerow([*row.values(), *(float(np.float32(number)).hex() for number in force(*at, 0.5))])
    return {"exact": run("conform", "judge", *ASKED[:4], mine)}


def through_a_process(program):
    return run("conform", *ASKED, "--command", f"{sys.executable} {program}")


def through_a_shared_object(source, folder):
    built = folder / "wall.so"
    flags = ["-std=c11", "-O2", "-ffp-contract=off", "-shared", "-fPIC", f"-I{ROOT / 'include'}"]
    subprocess.run(["cc", *flags, "-o", built, source], check=True)
    return run("conform", *ASKED, "--command", built)


def through_python(force):
    wall = lambda x, y, z: force(x, y, z, 0.5)
    law = forceshade.Law("wall", stiffness=0.5)
    return forceshade.conform(wall, law, declares=DECLARES, vectorised=False, points=5000, seed=7).contents


def without_places(found):
    """A case of a file has a place in it."""
    if isinstance(found, dict):
        return {key: without_places(value) for key, value in found.items() if key != "place"}
    return found


@pytest.mark.parametrize("wrong_in", WRONG_IN)
def test_every_door_finds_the_same(wrong_in, tmp_path):
    if shutil.which("cc") is None:
        pytest.skip("no C compiler is there")
    in_python, in_c = WRONG_IN[wrong_in]
    program, source = tmp_path / "wall.py", tmp_path / "wall.c"
    program.write_text(changed("wall.py", in_python))
    source.write_text(changed("wall.c", in_c))
    its = {}
    exec(program.read_text().replace("\nmain()", ""), its)

    files = through_files(its["force"], tmp_path)
    process = through_a_process(program)
    others = [through_a_shared_object(source, tmp_path), through_python(its["force"])]
    assert files["exact"]["all"]["cases"] == 5000
    assert files["exact"]["held"] == (wrong_in == "nothing")
    for found in [files, *others]:
        assert without_places(found["exact"]) == without_places(process["exact"])
    for found in others:
        for same in ("held", "applicable", "shortest_path_mm", "counterexample", "invariants"):
            assert found.get(same) == process.get(same), same
    assert any(not one.get("held", True) for one in process["invariants"]) == (wrong_in == "the surface")
