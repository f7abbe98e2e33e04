# SPDX-License-Identifier: BSD-3-Clause
"""framed_deaths.py FORCESHADE haply|dhd|command LIBRARY PATIENT: in contact, ends the client, what it speaks with, or the link between
them, and prints for how many ms the arm then felt a force. LIBRARY is the stand-in's for DHD. PATIENT (patient.cpp) drives in the
place of `forceshade drive`, so that lateness ends nothing: it is judged by the order of events, and those deaths are tried that no
time has a part in. scripts/real has died() measure the times of all. Exit code 1 where a force stayed or a side did not end as
it should."""

import os
import signal
import subprocess
import sys
import tempfile
import time

import arms
from checks import Checks

STOPPED = "stopped"


class Death:
    """The process that dies, and its signal; or an event of the stand-in's in the place of a signal."""

    def __init__(self, who, number=None, name="", options=()):
        self.who, self.number, self.options = who, number, options
        self.name = name or f"{who}: {number.name}"


SIGNALS = [Death("client", number) for number in (signal.SIGTERM, signal.SIGKILL, signal.SIGSTOP)]
DEATHS = {
    "haply": [*SIGNALS, Death("link", signal.SIGKILL)],
    "dhd": [*SIGNALS, *(Death("cable", name=f"cable: pulled, and calls {words}", options=[f"unplugged={how}"])
                        for how, words in (("error", "fail"), ("block", "never return")))],
    "command": [*SIGNALS, Death("program", signal.SIGKILL)],
}


def is_timeless(kind, death):
    """A process that stands still is missed after a time, and the device's own watchdog ends the force of a DHD client that is gone."""
    keeps_pushing = kind == "dhd" and death.number == signal.SIGKILL
    return death.number != signal.SIGSTOP and "unplugged=block" not in death.options and not keeps_pushing


# With these a hand moves by a frame's step from answer to answer, however late, and nothing but an end lets it go.
TIMELESS = {"haply": ["--clock", "messages", "--assume", "idle-after=never"],
            "dhd": ["clock=1000", "watchdog-works=no"],
            "command": ["by-lines"]}


def made(kind, death, patient):
    options = [*death.options, *(TIMELESS[kind] if patient else [])]
    more = {"between": True} if death.who == "link" else {}
    return arms.KINDS[kind](["unplug@contact"] if death.who == "cable" else [], options, **more)


def died(kind, death, forceshade, patient=None):
    """ms from the death to the last moment of force, none where it stays until the device's own time-out; the client's exit code and
    words; and its faults, among them those of its recording. None of all where the moment did not come."""
    with made(kind, death, patient) as arm, tempfile.TemporaryDirectory() as folder:
        command = [forceshade, "drive", "--device", arm.device, "--law", "wall", "--certificate", "none", "--watchdog-timeout", "1",
                   "--seconds", "9"]
        if patient:
            command = [patient, arm.device]
        client = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                  env={**os.environ, **arm.environment})
        try:
            moment = arm.first("unplug" if death.who == "cable" else "contact", lambda: client.poll() is None)
            if moment is None:
                return None
            if death.number:
                time.sleep(0.02)
                moment = time.monotonic_ns()
                os.kill({"client": client.pid, "link": arm.link}.get(death.who) or arm.partner, death.number)
            stands_still = death.number == signal.SIGSTOP
            if stands_still:
                time.sleep(0.3)
                client.kill()
            _, words = client.communicate()
            until = None if death.who == "program" else arm.felt_until()
            end = STOPPED if stands_still else client.returncode
            faults = arm.verdict() if death.who in ("client", "cable") else set()
            if patient:
                verify = subprocess.run([forceshade, "recording", "check", "run.fsr"], cwd=folder, text=True, capture_output=True)
                said = verify.stdout + verify.stderr
                if verify.returncode != 0 if end in (0, 3) else "no end: cut off" not in said:
                    faults = faults | {said}
            return None if until is None else max(0, (until - moment) / 1e6), end, words, faults
        except ProcessLookupError:  # its partner was gone before
            return None
        finally:
            client.kill()
            client.wait()


def most_ms(kind, death):
    """Within which the arm has to be let go, on a machine that never stands still."""
    arm_class = arms.KINDS[kind]
    if death.number == signal.SIGTERM:
        return 4  # a tick, a frame, and the threads that wake up for them
    if death.number in (signal.SIGSTOP, None) or arm_class is arms.Dhd:
        return arm_class.longest_ms + 3
    return 12  # the system takes some ms to end a process


def is_in_order(death, late, end, words, faults):
    """Returns true if the arm was let go, the client ended as it should, and the stand-in blames it for nothing but its death."""
    if late is None and death.who != "program":
        return False
    if death.who != "client":
        return end == 3 and words and not faults - {"left-open", "abrupt-end", "force-at-end", "after-unplug"}
    if death.number == signal.SIGTERM:
        return end == 0 and not faults
    expected = STOPPED if death.number == signal.SIGSTOP else -death.number
    return end == expected and not faults - {"left-open", "abrupt-end", "force-at-end"}


def main(forceshade, kind, library, patient):
    checks = Checks()
    arms.Dhd.library = library
    tried = [death for death in DEATHS[kind] if is_timeless(kind, death)]
    for death in tried:
        outcome = died(kind, death, forceshade, patient)
        checks.expect(outcome is not None and is_in_order(death, *outcome), f"{death.name}: {outcome}")
        if outcome:
            print(f"{death.name}: exit code {outcome[1]}, force for {outcome[0]} ms", flush=True)
    return checks.exit_code(2)


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], os.path.abspath(sys.argv[3]), os.path.abspath(sys.argv[4])))
