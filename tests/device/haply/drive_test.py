# SPDX-License-Identifier: BSD-3-Clause
"""drive_test.py STAND-IN FORCESHADE recording|assumptions: the command over the stand-in, which finds no fault of it; what
it says of everything that goes wrong; and its exit codes."""

import os
import subprocess
import sys
import tempfile

from stand_in import StandIn, skip_without_websockets
from checks import Checks, at_once, certify_wall, recorded

skip_without_websockets()
checks = Checks()
program, forceshade, mode = sys.argv[1:4]


class Run:
    """drive with these options over a stand-in with those."""

    def __init__(self, options, stand_in, folder=None):
        with tempfile.TemporaryDirectory() as own:
            self.drive(options, stand_in, folder or own)

    def drive(self, options, stand_in, folder):
        with StandIn(program, *stand_in) as service:
            command = [forceshade, "drive", "--device", "haply", "--law", "wall", "--stiffness", "0.5", "--watchdog-timeout", "1"]
            if "--certificate" not in options:
                command.append("--uncertified")
            run = subprocess.run(command + list(options), cwd=folder, text=True, capture_output=True, timeout=60,
                                 env={**os.environ, "FORCESHADE_HAPLY_SERVICE": service.address})
            self.code, self.out, self.err = run.returncode, run.stdout, run.stderr
            self.faults, self.session = None, None
            if "freeze" in " ".join(stand_in) or "die" in " ".join(stand_in):
                return
            service.process.terminate()
            _, report = service.verdict()
            self.faults, self.session = report["faults"], (report["sessions"] or [None])[0]

    def expect(self, what, code, *words, faults=()):
        text = self.out + self.err
        checks.expect(self.code == code, f"{what}: exit code {self.code}, expected {code}: {text}")
        for one in words:
            checks.expect(one in text, f"{what}: \"{one}\" is not in: {text}")
        if self.faults is not None:
            checks.expect(set(self.faults) == set(faults), f"{what}: the stand-in found {self.faults}")


def recording():
    with tempfile.TemporaryDirectory() as folder:
        run = Run(["--seconds", "2"] + certify_wall(forceshade, folder), [], folder=folder)
        run.expect("a certified run", 0, "forces            as commanded; the Inverse Service filters and rations them")
        checks.expect(run.session["largest_force_N"] > 0.1, f"no contact: {run.session}")
        device = recorded(forceshade, folder, checks)["device"]
        checks.expect("which no certificate covers" in device["forces"], f"summary: {device}")
        checks.expect(device["serial"] == "stand-in-0001", f"summary: {device}")


def assumptions():
    other = ["values-key=both", "http=before", "envelope=asked", "force-reported=no", "basis-reported=no", "control-mode=force",
             "grip=wireless", "ping=0.05", "clamp=0.1", "ration=0.3", "in-flight=drop", "unknown-command=close", "malformed=close",
             "not-finite=close", "idle-after=30", "after-close=hold"]
    words = [word for one in other for word in ("--assume", one)]
    Run(["--seconds", "1"], words).expect("every assumption the other way", 0)
    Run(["--seconds", "1"], ["--version", "3.4.2", "--assume", "grip=none", "--type", "minverse"]).expect("version 3.4", 0)
    refused = {name: (stand_in, expected) for name, stand_in, expected in (
            ("in-use", ["--assume", "in-use=any"], "another program uses the Inverse3 049D"),
            ("top-rate", ["--assume", "top-rate=300"], "too irregular to send forces"),
            ("no device", ["--event", "unplug@1"], "no Inverse3 is connected"))}
    for name, run in at_once(lambda name: Run(["--seconds", "0.2"], refused[name][0]), refused, 3).items():
        run.expect(name, 3, refused[name][1])
    nobody = subprocess.run([forceshade, "drive", "--device", "haply", "--law", "wall", "--uncertified"], text=True, capture_output=True,
                            env={**os.environ, "FORCESHADE_HAPLY_SERVICE": "127.0.0.1:1"}, timeout=60)
    checks.expect(nobody.returncode == 3 and "no Inverse Service answers at 127.0.0.1:1" in nobody.stderr, f"nobody: {nobody.stderr}")
    wrong = subprocess.run([forceshade, "drive", "--device", "haply", "--law", "wall", "--uncertified"], text=True, capture_output=True,
                           env={**os.environ, "FORCESHADE_HAPLY_SERVICE": "nowhere"}, timeout=60)
    checks.expect(wrong.returncode == 3 and "expected HOST:PORT" in wrong.stderr, f"nowhere: {wrong.stderr}")


if __name__ == "__main__":
    least = {"recording": (recording, 7), "assumptions": (assumptions, 10)}
    least[mode][0]()
    sys.exit(checks.exit_code(least[mode][1]))
