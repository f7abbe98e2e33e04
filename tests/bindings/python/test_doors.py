# SPDX-License-Identifier: BSD-3-Clause
"""The same renderer through each door: files, a process, a shared object and a function of Python. What is found has to be the
same. It is the wall of examples/renderers/, and one with damping: right, and wrong in one thing."""

import csv
import ctypes
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


def replaced(text, replacements):
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new)
    return text


def changed(name, replacements):
    return replaced((RENDERERS / name).read_text(), replacements)


def run(*words):
    found = subprocess.run([command(), *words, "--json", "-"], capture_output=True, text=True, check=False)
    assert found.returncode in (0, 1), found.stderr
    return json.loads(found.stdout)


def through_files(force, folder, subject=ASKED, *judging):
    """Rows have reset and periods where the subject has damping."""
    asked, mine = folder / "asked.csv", folder / "mine.csv"
    subprocess.run([command(), "conform", "positions", *subject, "--out", asked], check=True)
    with open(asked, newline="") as file, open(mine, "w", newline="") as out:
        rows = csv.DictReader(file)
        writer = csv.writer(out)
        writer.writerow([*rows.fieldnames, "fx_N", "fy_N", "fz_N"])
        for row in rows:
            at = (float(np.float32(row[name])) for name in ("x_mm", "y_mm", "z_mm"))
            more = (row["reset"], row["periods"]) if "periods" in row else (0.5,)
            writer.writerow([*row.values(), *(float(np.float32(number)).hex() for number in force(*at, *more))])
    return {"exact": run("conform", "judge", *subject[:4], *subject[8:], *judging, mine)}


def through_a_process(program, *more):
    return run("conform", *ASKED, *more, "--command", f"{sys.executable} {program}")


def through_a_shared_object(source, folder, *more):
    built = folder / "wall.so"
    flags = ["-std=c11", "-O2", "-ffp-contract=off", "-shared", "-fPIC", f"-I{ROOT / 'include'}"]
    subprocess.run(["cc", *flags, "-o", built, source], check=True)
    return run("conform", *ASKED, *more, "--command", built)


def through_python(force):
    wall = lambda x, y, z: force(x, y, z, 0.5)
    law = forceshade.Law("wall", stiffness=0.5)
    return forceshade.conform(wall, law, declares=DECLARES, vectorised=False, points=5000, seed=7).contents


# A wall with damping along z: the example in Python, in a process, and the same in C, in binary64, which is faster, through the other
# doors. What it leaves out is found, and through every door the same.
DAMPING = {"damping": 0.002, "share": 0.25}
DAMPED = [*ASKED, "--damping", "0.002", "--damping-filter", "0.25", "--rate", "1000"]
DAMPED_IN_C = r"""
#include <forceshade.h>
#include <math.h>
static struct { int has_last; double last; float speed; uint32_t since; } of = {0, 0, 0, 0};
static int32_t open_it(const char* scene, void** state, const char** hello) {
  (void)scene, (void)state;
  *hello = HELLO;
  return 0;
}
static float damped(const float* at, uint32_t periods) {
  const double z = fabsf(at[2]) < 0x1p-30f ? 0 : at[2], spring = z < 0 ? -0.5 * z : 0;
  if (of.has_last) of.since = (uint32_t)fmin((double)of.since + periods, 17);
  if (!(fabsf(at[0]) <= 1e4f && fabsf(at[1]) <= 1e4f && fabsf(at[2]) <= 1e4f)) return 0;
  if (periods > 0) {
    if (!of.has_last || of.since > 16) of.speed = 0;
    else for (uint32_t i = 0; i < of.since; ++i) {
      of.speed = (float)(of.speed + 0.25 * (1000 * (z - of.last) / of.since - of.speed));
      if (fabsf(of.speed) < 0x1p-20f) of.speed = 0;
    }
    of.has_last = 1, of.last = z, of.since = 0;
  }
  return (float)fmin(2 * spring, fmax(0, spring - (double)0.002f * of.speed));
}
FORCESHADE_API int32_t answer(void* state, const float* positions, const uint32_t* periods, float* answers, size_t count,
                              int32_t is_reset) {
  (void)state;
  if (is_reset) of.has_last = 0, of.since = 0, of.speed = 0;
  for (size_t i = 0; i < count; ++i, answers += 3) {
    answers[0] = answers[1] = 0;
    answers[2] = damped(positions + 3 * i, periods[i]);
  }
  return 0;
}
static void close_it(void* state) { (void)state; }
FORCESHADE_API const forceshade_renderer* forceshade_renderer_entry(void) {
  static const forceshade_renderer table = {sizeof table, open_it, NULL, close_it, answer};
  return &table;
}
"""
DAMPED_WRONG_IN = {
    "nothing": ([], []),
    "the periods": ([("(at - self.last) / self.since", "(at - self.last)")], [("(z - of.last) / of.since", "(z - of.last)")]),
}


class Wall:
    """The compiled one, in this process."""

    def __init__(self, built):
        self.answer = ctypes.CDLL(built).answer

    def open(self, scene):
        return self

    def force(self, x, y, z, reset, periods):
        return self.answers(np.array([[x, y, z]], np.float32), reset == "1", np.array([int(periods)], np.uint32))[0]

    def answers(self, positions, reset, periods):
        forces = np.empty((len(positions), 3), np.float32)
        addresses = (ctypes.c_void_p(each.ctypes.data) for each in (positions, periods, forces))
        self.answer(None, *addresses, ctypes.c_size_t(len(positions)), ctypes.c_int32(reset))
        return forces


@pytest.mark.parametrize("wrong_in", DAMPED_WRONG_IN)
def test_every_door_tells_the_periods(wrong_in, tmp_path):
    if shutil.which("cc") is None:
        pytest.skip("no C compiler is there")
    in_python, in_c = DAMPED_WRONG_IN[wrong_in]
    declares = {**DECLARES, "memory": "path", "rate_Hz": 1000, "damping": DAMPING}
    hello = json.dumps({"forceshade": "conform 1", "kind": "renderer", "name": "damped", "version": "1", **declares})
    program, source = tmp_path / "damped_wall.py", tmp_path / "damped.c"
    program.write_text(changed("damped_wall.py", in_python))
    shutil.copy(RENDERERS / "wall.py", tmp_path)
    source.write_text(f"#define HELLO {json.dumps(hello)}\n" + replaced(DAMPED_IN_C, in_c))

    process = through_a_process(program, "--tolerance", "1 ulp")
    law = forceshade.Law("wall", stiffness=0.5)
    options = {"declares": declares, "points": 5000, "seed": 7, "tolerance": "1 ulp", "name": "damped", "version": "1"}
    others = [through_a_shared_object(source, tmp_path, "--tolerance", "1 ulp")]
    wall = Wall(tmp_path / "wall.so")
    others.append(forceshade.conform(wall, law, **options).contents)
    files = through_files(wall.force, tmp_path, DAMPED, "--tolerance", "1 ulp")
    assert process["held"] == files["exact"]["held"] == (wrong_in == "nothing"), process
    assert files["exact"].pop("damping")["share"] == 0.25
    for found in [files, *others]:
        assert without_places(found["exact"]) == without_places(process["exact"])
    for found in others:
        for same in ("held", "applicable", "shortest_path_mm", "shortest_path_periods", "counterexample", "invariants"):
            assert found.get(same) == process.get(same), same
    failed = {one["name"] for one in process["invariants"] if not one.get("held", True)}
    assert ("missed positions count as evenly spaced" in failed) == (wrong_in == "the periods"), failed


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
