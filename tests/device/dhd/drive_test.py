# SPDX-License-Identifier: BSD-3-Clause
"""drive_test.py STAND-IN LIBRARY FORCESHADE recording|assumptions: the command over the stand-in, which finds no fault of it;
what it says of everything that goes wrong; and its exit codes."""

import os
import subprocess
import sys
import tempfile

import stand_in
from checks import Checks, at_once, certify_wall, recorded

checks = Checks()
program, library, forceshade, mode = sys.argv[1:5]


class Run:
    """drive with these options over a stand-in with those."""

    def __init__(self, options, words=(), folder=None, device="dhd"):
        with tempfile.TemporaryDirectory() as own:
            self.drive(options, words, folder or own, device)

    def drive(self, options, words, folder, device):
        command = [forceshade, "drive", "--device", device, "--law", "wall", "--stiffness", "0.5", "--watchdog-timeout", "1"]
        if "--certificate" not in options:
            command.append("--uncertified")
        run = stand_in.Run(program, library, command + list(options), *words, cwd=folder)
        self.text, self.faults, self.session = run.out + run.err, run.faults, run.session
        said = [line.split()[-1] for line in run.err.splitlines() if line.startswith("the client ended with exit code")]
        self.code = int(said[0]) if said else 0
        self.verdict = run.code

    def expect(self, what, code, *words):
        checks.expect(self.code == code, f"{what}: exit code {self.code}, expected {code}: {self.text}")
        for one in words:
            checks.expect(one in self.text, f"{what}: \"{one}\" is not in: {self.text}")
        checks.expect(self.verdict == 0 and not self.faults, f"{what}: the stand-in found {self.faults}: {self.text}")


def assume(*assumptions):
    return [word for one in assumptions for word in ("--assume", one)]


def recording():
    with tempfile.TemporaryDirectory() as folder:
        run = Run(["--seconds", "2"] + certify_wall(forceshade, folder), folder=folder)
        run.expect("a certified run", 0, "forces            as commanded; the vendor's library adds its gravity compensation",
                   "omega.3, serial number 1234: left-handed: no", "the device ends a force that is not renewed for 31.875 ms")
        checks.expect(run.session["largest_force_N"] > 0.1, f"no contact: {run.session}")
        device = recorded(forceshade, folder, checks)["device"]
        checks.expect("which no certificate covers" in device["forces"], f"summary: {device}")
        checks.expect(device["serial"] == "1234", f"summary: {device}")


def assumptions():
    helped = subprocess.run([sys.executable, program, "dhd", "--library", library, "--help"], text=True, capture_output=True).stdout
    known = {line.split("=")[0].strip() for line in helped[helped.index("assumptions ("):helped.index("events (")].splitlines()[1:]}
    others = {"set-force-off": ["ok"], "not-finite": ["accept"], "watchdog": ["240"], "watchdog-works": ["no"], "time-guard": ["200"],
              "last-error": ["process"], "error-kept": ["no"], "expert": ["thread"], "status-length": ["16"], "brakes": ["off"],
              "forces": ["on"], "enable-uncalibrated": ["ok"], "max-force": ["ignore"], "call-time": ["100"], "serial": ["77"],
              "model": ["delta.3", "omega.6", "omega.7", "omega.7-left", "sigma.3", "sigma.7", "lambda.3", "lambda.7", "falcon"]}
    elsewhere = {"unplugged", "calibrated", "available", "pressed", "clock", "longest-gap", "most-force"}
    checks.expect(known == set(others) | elsewhere, f"assumptions that are not run: {known ^ (set(others) | elsewhere)}")
    each = [(name, value) for name, values in others.items() for value in values]
    runs = at_once(lambda one: Run(["--seconds", "0.5"], assume("=".join(one))), each, 2)
    for one, run in runs.items():
        run.expect("=".join(one), 0)
        checks.expect(run.session["end"] == "closed" and run.session["force_at_end_N"] == 0, f"{one}: {run.session}")
    words = {"watchdog-works=no": "the device refuses a watchdog", "model=omega.7-left": "left-handed: yes, gripper open by 12 mm",
             "model=falcon": "Falcon: left-handed: no"}
    for (name, value), run in runs.items():
        expected = words.get(f"{name}={value}")
        checks.expect(not expected or expected in run.text, f"{name}={value}: {expected} is not in {run.text}")
    every = assume("set-force-off=ok", "not-finite=accept", "watchdog=240", "last-error=process", "error-kept=no", "status-length=16",
                   "brakes=off", "forces=on", "enable-uncalibrated=ok", "time-guard=200")
    Run(["--seconds", "1"], every).expect("every assumption the other way", 0)
    shown = {"button": (assume("set-force-off=ok") + ["--event", "force-button@contact"], "its force button was pressed"),
             "block": (assume("unplugged=block") + ["--event", "unplug@contact"], "has not answered for 25 ms"),
             "stale": (assume("unplugged=stale") + ["--event", "unplug@contact"], "no longer connected")}
    for name, run in at_once(lambda name: Run(["--seconds", "4"], shown[name][0]), shown, 2).items():
        if name == "block":  # it cannot be closed any more
            checks.expect(run.code == 3 and shown[name][1] in run.text and set(run.faults) <= {"left-open", "force-at-end"}, f"block: {run.text} {run.faults}")
        else:
            run.expect(name, 3, shown[name][1])
    locked = Run(["--seconds", "0.2"], assume("available=no"))
    checks.expect(locked.code == 3 and "another program uses the device" in locked.text, locked.text)
    for device, expected in (("dhd:1234", None), ("dhd:#0", None), ("dhd:99", "there is no such device"), ("dhd:#1", "an index below 1"),
                             ("dhd:x", "expected a serial number")):
        run = Run(["--seconds", "0.2"], device=device)
        if expected is None:
            run.expect(device, 0)
        else:
            checks.expect(run.code == 3 and expected in run.text and not run.faults, f"{device}: {run.code} {run.text}")
    nowhere = subprocess.run([forceshade, "drive", "--device", "dhd", "--law", "wall", "--uncertified"], text=True, capture_output=True,
                             env={**os.environ, "FORCESHADE_DHD_LIBRARY": "/nowhere/libdhd.so"}, timeout=60)
    checks.expect(nowhere.returncode == 3 and "/nowhere/libdhd.so" in nowhere.stderr, f"nowhere: {nowhere.stderr}")
    check = stand_in.Run(program, library, [forceshade, "device", "check", "dhd"])
    checks.expect(check.code == 0 and "sees 1, of which 1 can be opened" in check.out and check.session["forces"] == 0,
                  f"check: {check.out} {check.err} {check.session}")


if __name__ == "__main__":
    least = {"recording": (recording, 9), "assumptions": (assumptions, 100)}
    least[mode][0]()
    sys.exit(checks.exit_code(least[mode][1]))
