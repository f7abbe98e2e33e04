# SPDX-License-Identifier: BSD-3-Clause
"""Properties and certificates."""

import json
import os
import signal
import subprocess
import threading

import numpy as np
import pytest
from conftest import command
from test_misuse import refused

import forceshade


def test_properties_hold_of_each_kind(bump, tetrahedron):
    results = forceshade.properties(bump, cases=50, seed=3)
    assert [result.name for result in results][:4] == ["equivalence", "continuity", "unit normals", "passivity"]
    assert all(result.held and not result.counterexample for result in results)
    assert all(result.held for result in forceshade.properties(tetrahedron, cases=5))


def test_a_certificate_is_that_of_the_command(bump, tmp_path):
    path = tmp_path / "certificate.json"
    certificate = forceshade.certify(bump, points=2000, cases=20, seed=5, out=path)
    assert certificate.held and certificate.standing == "insufficient" and "points" in certificate.lacks
    assert json.loads(path.read_text()) == certificate.contents
    assert certificate.contents["build"]["library_digest"] == forceshade.library_digest()
    assert certificate.contents["subjects"][0]["renderer"] == "library"
    refused(FileExistsError, "is there already; expected another name, or overwrite=True", forceshade.certify, bump, out=path)
    ran = subprocess.run(
        [command(), "certify", "--law", "bump-2p", "--points", "2000", "--cases", "20", "--seed", "5", "--out", tmp_path / "c"],
        capture_output=True,
        text=True,
    )
    assert ran.returncode in (0, 1), ran.stderr
    theirs = json.loads((tmp_path / "c" / "certificate.json").read_text())
    mine = certificate.contents["subjects"][0]
    for key, value in theirs["subjects"][0].items():
        if key not in ("options", "subject_file"):
            assert mine[key] == value, key


def test_a_plan_gives_the_certificate_of_one_process(wall, tmp_path):
    folder = tmp_path / "plan"
    made = forceshade.make_plan(folder, {"law": "wall", "stiffness": "0.5"}, points=20000, cases=20, seed=5, units=4)
    assert made.units > 4 and made.done == 0 and forceshade.plan_state(folder).missing.startswith("units 0 to ")
    refused(forceshade.Error, "there is no certificate; missing: units 0 to ", forceshade.merged_plan, folder)
    refused(forceshade.Error, "is there already", forceshade.make_plan, folder, {"law": "wall"})
    refused(ValueError, "threads is 0; expected 1 to", forceshade.work_on_plan, folder, threads=0)
    state = forceshade.work_on_plan(folder, threads=2)
    assert state.done == state.units and not state.missing and not state.alarms and state.digest == made.digest
    whole, alone = forceshade.merged_plan(folder), forceshade.certify(wall, points=20000, cases=20, seed=5)
    for key, value in alone.contents["subjects"][0].items():
        if key not in ("options", "subject_file"):
            assert whole.contents["subjects"][0][key] == value, key
    other = folder / "results" / "0" / "1.differs-0123456789abcdef.json"
    other.write_text("the result of a machine that computes wrongly")
    assert forceshade.plan_state(folder).alarms == [str(other)]
    refused(forceshade.Error, f"there is no certificate; {other} differ from the results beside them", forceshade.merged_plan, folder)


def test_a_certificate_of_python_drives_a_device_with_the_command_and_no_other_subject(wall, tmp_path):
    path = tmp_path / "certificate.json"
    assert forceshade.certify(wall, out=path).standing == "sufficient"

    def drive(stiffness):
        words = ["drive", "--law", "wall", "--stiffness", stiffness, "--device", "null", "--seconds", "0.05", "--certificate", path]
        return subprocess.run([command(), *words], capture_output=True, text=True, cwd=tmp_path)

    certified, other = drive("0.5N/mm"), drive("0.6N/mm")
    assert certified.returncode == 0, certified.stderr
    assert other.returncode != 0 and "certificate" in other.stderr, other.stderr
    path.write_text(path.read_text().replace('"renderer": "library"', '"renderer": "program"'))
    own = forceshade.Certificate.read(path)
    assert own.held and own.standing == "insufficient", own
    assert own.lacks.startswith("the certificate is of a program's own renderer for wall; driving needs one of the library's")
    assert own.remedy.startswith("forceshade certify --law wall --stiffness 0.5 ")


def test_what_is_refused(bump, tmp_path):
    refused(ValueError, "cases is 0; expected 1 to", forceshade.properties, bump, cases=0)
    refused(TypeError, "seed: expected an integer, got 0.5", forceshade.properties, bump, seed=0.5)
    refused(TypeError, "expected a Law, HeightMap or Mesh, got str", forceshade.properties, "wall")
    refused(TypeError, "expected a Law, HeightMap or Mesh, got int", forceshade.certify, [bump, 3])
    refused(ValueError, "expected one subject at least", forceshade.certify, [])
    refused(ValueError, "threads is 0; expected 1 to 1024", forceshade.certify, bump, threads=0)
    refused(TypeError, "law: expected a word, got 5", forceshade.make_plan, tmp_path / "plan", {"law": 5})


def test_ctrl_c_ends_a_certificate(bump):
    threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        forceshade.certify(bump, points=100_000_000)
    assert forceshade.certify(bump, points=100, cases=2).held  # and the next one goes on


class Stopped(Exception):
    """Raised in the place of KeyboardInterrupt by a signal that comes after some time of the processor, whatever else it does."""


def stopped_after(seconds, call, *arguments):
    def stop(number, frame):
        raise Stopped

    before = signal.signal(signal.SIGVTALRM, stop)
    try:
        signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
        with pytest.raises(Stopped):
            call(*arguments)
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        signal.signal(signal.SIGVTALRM, before)


def test_a_signal_ends_what_is_computed_for_long(tetrahedron):
    """Its last rows are then those that were there, for they were never answered."""
    at = np.ones((3_000_000, 3), np.float32)
    at[::2] *= -1
    forces, statuses = np.full(at.shape, 7, np.float32), np.full(len(at), 7, np.uint8)
    reference = forceshade._forceshade.Reference(forceshade.HeightMap(at[:9] + np.ones((9, 3), np.float32), pitch=9))
    stopped_after(0.02, reference.rounded, at, forces, statuses)
    assert forces[-1, 0] == statuses[-1] == 7 and statuses[0] != 7
    damping = forceshade.Damping(rate=1000, damping=0.002)
    forces[:] = 1
    stopped_after(0.02, lambda: forceshade._forceshade.damp_exactly(damping._numbers(), None, at[: 1 << 18], forces[: 1 << 18], None))
    assert forces[(1 << 18) - 1, 0] == 1
    session = forceshade.Session(tetrahedron)
    forces[-1, 0] = 7
    stopped_after(0.02, lambda: session.steps(at, out=forces))
    assert forces[-1, 0] == 7 and forces[0, 0] != 7
    assert session.steps(at[:1]).shape == (1, 3)  # and it goes on


def test_where_no_file_can_be_made_is_known_before_the_work(bump, tmp_path):
    """A work of 10^18 points, which nobody would wait for."""
    (tmp_path / "loose").symlink_to("nowhere")
    for path, kind, words in [
        (tmp_path / "none" / "c.json", FileNotFoundError, "expected a folder that is there"),
        (tmp_path, IsADirectoryError, "expected the name of a file, got that of a folder"),
        (tmp_path / "loose", FileExistsError, "is there already"),
        ("/proc/c.json", OSError, "expected a folder in which a file can be made"),
    ]:
        if path == "/proc/c.json" and os.access("/proc", os.W_OK):
            continue  # root may write everywhere
        refused(kind, words, forceshade.certify, bump, points=10**18, out=path)


def test_one_certificate_at_a_time(bump):
    held = []
    threads = [threading.Thread(target=lambda: held.append(forceshade.certify(bump, points=500, cases=5).held)) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert held == [True] * 3


def test_ctrl_c_ends_the_check_of_a_mesh():
    n = 500
    x, y = np.meshgrid(np.arange(n, dtype=np.float32), np.arange(n, dtype=np.float32))
    vertices = np.stack([x, y, np.random.default_rng(1).random((n, n), np.float32)], axis=-1).reshape(-1, 3)
    index = np.arange(n * n).reshape(n, n)
    a, b, c, d = (part.ravel() for part in (index[:-1, :-1], index[:-1, 1:], index[1:, :-1], index[1:, 1:]))
    triangles = np.concatenate([np.stack([a, b, d], axis=-1), np.stack([a, d, c], axis=-1)])
    threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        forceshade.Mesh(vertices, triangles, stiffness=0.5)
