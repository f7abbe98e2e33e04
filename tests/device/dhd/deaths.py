# SPDX-License-Identifier: BSD-3-Clause
"""deaths.py STAND-IN LIBRARY FORCESHADE [PHASE]: ends the client at each phase of a run, and prints for how long the device then gave
a force, from what the stand-in kept outside of the client, with its simulated watchdog. Exit code 1 where it gave one for too long."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time

from stand_in import Checks

checks = Checks()
program, library, forceshade = sys.argv[1:4]
PHASES = {"opened": "opened", "settling": "settling", "in contact": "contact"}
phases = sys.argv[4:] or list(PHASES)
ENDS_IN_ORDER = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
KILLS = (signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT)
TRIES = 6       # on a busy machine the run may end before its moment comes
WATCHDOG = 31.875  # ms
LATE = 60       # ms: an end in order, on a busy machine


def waits_for(log, event, timeout=20):
    """Whether such an event comes."""
    for _ in range(int(timeout / 0.005)):
        try:
            with open(log) as file:
                if any(json.loads(line)["event"] == event for line in file if line.endswith("\n")):
                    return True
        except FileNotFoundError:
            pass
        time.sleep(0.005)
    return False


def died(phase, number, assumption=""):
    """ms from the death to the last moment of force, how the client ended, and the faults; none where the moment did not come."""
    with tempfile.TemporaryDirectory() as folder:
        log, report = os.path.join(folder, "log"), os.path.join(folder, "report")
        more = {"FORCESHADE_DHD_LIBRARY": library, "FORCESHADE_STANDIN_JOURNAL": log,
                "FORCESHADE_STANDIN_DHD": "longest-gap=20000" + ("," + assumption if assumption else "")}
        command = [forceshade, "drive", "--device", "dhd", "--law", "wall", "--uncertified", "--watchdog-timeout", "1", "--seconds", "5"]
        client = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, **more})
        try:
            if not waits_for(log, PHASES[phase]):
                return None
            time.sleep(0.02)
            if client.poll() is not None:
                return None
            moment = time.monotonic_ns()
            os.kill(client.pid, number)
            if number == signal.SIGSTOP:
                time.sleep(0.5)
                os.kill(client.pid, signal.SIGKILL)
            client.wait(timeout=20)
        finally:
            client.kill()
            client.wait()
        judge = [sys.executable, program, "dhd", "--library", library, "--judge", log, "--report", report]
        subprocess.run(judge, stderr=subprocess.DEVNULL, check=False)
        with open(report) as file:
            verdict = json.load(file)
        session = verdict["sessions"][-1]
        until = session["force_until_ns"]
        is_felt = phase == "in contact"
        late = None if until == 0 and is_felt else max(0, (until - moment) / 1e6) if is_felt else 0
        return late, "stopped" if number == signal.SIGSTOP else client.returncode, set(verdict["faults"])


def row(number, is_right):
    cells = []
    for phase in phases:
        outcome = None
        for _ in range(TRIES):
            outcome = died(phase, number)
            if outcome is not None and is_right(phase, *outcome):
                break
        checks.expect(outcome is not None and is_right(phase, *outcome), f"{number.name}, {phase}: {outcome}")
        cells.append("did not happen" if outcome is None else "for ever" if outcome[0] is None else f"{outcome[0]:.1f} ms")
    print(f"| {number.name} | {' | '.join(cells)} |", flush=True)


def main():
    print(f"| death of the client | {' | '.join(phases)} |\n|---|{'---|' * len(phases)}")
    for number in ENDS_IN_ORDER:
        row(number, lambda phase, late, end, faults: late is not None and late < LATE and not faults - {"left-open"} and
            end in ((0,) if phase == "in contact" else (0, 3, 130)))
    for number in KILLS:
        row(number, lambda phase, late, end, faults: late is not None and late <= WATCHDOG and end == -number and "left-open" in faults)
    row(signal.SIGSTOP, lambda phase, late, end, faults: late is not None and late <= WATCHDOG and end == "stopped")
    # What the watchdog is for: a device that refuses one.
    without = died("in contact", signal.SIGKILL, "watchdog-works=no")
    checks.expect(without is not None and without[0] is None, f"without a watchdog: {without}")
    print(f"without a watchdog, SIGKILL in contact: the force stays {'on' if without and without[0] is None else 'off'}")


main()
sys.exit(checks.exit_code(7 * len(phases) + 1))
