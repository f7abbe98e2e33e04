# SPDX-License-Identifier: BSD-3-Clause
"""deaths.py STAND-IN FORCESHADE [PHASE]: ends the client, the service and the link between them at each phase of a run, and prints
for how long the arm then felt a force, from the stand-in's own log. Exit code 1 where the arm felt what it should not."""

import os
import signal
import subprocess
import sys
import tempfile
import time

from stand_in import Checks, StandIn, skip_without_websockets

skip_without_websockets()
checks = Checks()
program, forceshade = sys.argv[1:3]
PHASES = {"connected": "inventory", "settling": "settling", "in contact": "contact"}
phases = sys.argv[3:] or list(PHASES)
ENDS_IN_ORDER = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
KILLS = (signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT)
TRIES = 6  # on a busy machine the run may end before its moment comes


def waits_for(log, event, timeout=20):
    """The time of the first such event, in ns; none where it does not come."""
    for _ in range(int(timeout / 0.005)):
        times = [entry["time_ns"] for entry in log() if entry["event"] == event]
        if times:
            return times[0]
        time.sleep(0.005)
    return None


def died(phase, target, number):
    """ms from the death to the last moment of force, how the client ended, or none where the moment did not come."""
    with StandIn(program, "--longest-gap", "20000") as service, tempfile.TemporaryDirectory() as folder:
        command = [forceshade, "drive", "--device", "haply", "--law", "wall", "--uncertified", "--watchdog-timeout", "1", "--seconds", "5"]
        client = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                  env={**os.environ, "FORCESHADE_HAPLY_SERVICE": service.address})
        try:
            if waits_for(service.log, PHASES[phase]) is None:
                return None
            time.sleep(0.02)
            moment = time.monotonic_ns()
            os.kill(client.pid if target == "client" else service.process.pid, number)
            if target == "service":
                _, words = client.communicate(timeout=20)
                return None, client.returncode, words
            if number == signal.SIGSTOP:
                time.sleep(0.5)
                stopped = [entry for entry in service.log() if entry["event"] == "idle"]
                os.kill(client.pid, signal.SIGKILL)
                client.wait(timeout=20)
                if phase == "in contact" and not stopped:
                    return 0, "still under force", ""
                return (stopped[0]["time_ns"] - moment) / 1e6 if stopped else 0, "stopped", ""
            client.communicate(timeout=20)
            ended = waits_for(service.log, "ended")
            session = [entry for entry in service.log() if entry["event"] == "ended"][0] if ended else None
            if session is None:
                return None
            until = session["force_until_ns"] if session["force_at_end_N"] > 0.01 or client.returncode < 0 else session["last_message_ns"]
            return max(0, (until - moment) / 1e6) if phase == "in contact" else 0, client.returncode, session["force_at_end_N"]
        finally:
            client.kill()
            client.communicate()


def tried(*death):
    for _ in range(TRIES):
        outcome = died(*death)
        if outcome is not None:
            return outcome
    return None


def row(name, target, number, is_right):
    cells = []
    for phase in phases:
        outcome = tried(phase, target, number)
        checks.expect(outcome is not None and is_right(phase, *outcome), f"{name}, {phase}: {outcome}")
        late, end = (None, "did not happen") if outcome is None else outcome[:2]
        cells.append(f"exit {end}, the device's own time-out" if target == "service" else "-" if late is None else f"{late:.1f} ms")
    print(f"| {name} | {' | '.join(cells)} |", flush=True)


def main():
    print(f"| death | {' | '.join(phases)} |\n|---|{'---|' * len(phases)}")
    for number in ENDS_IN_ORDER:
        row(f"client: {number.name}", "client", number,
            lambda phase, late, end, force: force == 0 and end in ((0,) if phase == "in contact" else (0, 3, 130)))
    for number in KILLS:
        row(f"client: {number.name}", "client", number, lambda phase, late, end, force: end == -number)
    row("client: SIGSTOP", "client", signal.SIGSTOP, lambda phase, late, end, words: end == "stopped")
    for number in (signal.SIGKILL, signal.SIGSTOP):
        row(f"service: {number.name}", "service", number,
            lambda phase, late, end, words: end == 3 and "Inverse" in words)


main()
sys.exit(checks.exit_code(9 * len(phases)))
