# SPDX-License-Identifier: BSD-3-Clause
"""framed_deaths.py FORCESHADE haply|dhd|command LIBRARY [PHASE | PATIENT]: ends the client, what it speaks with, and the link between them at
each phase of a run, and prints for how many ms the arm then felt a force. LIBRARY is the stand-in's for DHD. Exit code 1 where a force
stayed or a side did not end as it should; scripts/real judges the times. PATIENT is a program (deaths/patient.cpp) that takes
the place of `forceshade drive`: in contact, those deaths that no time has a part in, each of which must happen."""

import os
import signal
import subprocess
import sys
import tempfile
import time

import arms
from checks import Checks

PHASES = ("opened", "settling", "free", "in contact", "tripping", "stopping")
IN_ORDER = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
STOPPED = "stopped"


class Death:
    """Who dies, of which signal; or an event of the stand-in's in the place of a signal, by phase."""

    def __init__(self, who, number=None, name="", events=None, options=()):
        self.who, self.number, self.events, self.options = who, number, events, options
        self.name = name or f"{who}: {number.name}"

    def happens_in(self, phase):
        return not self.events or phase in self.events


SIGNALS = [Death("client", number) for number in (*IN_ORDER, signal.SIGKILL, signal.SIGSEGV, signal.SIGABRT, signal.SIGSTOP)]
PULLED = {"opened": ["unplug@1"], "settling": ["unplug@300"], "free": ["unplug@1700"], "in contact": ["unplug@contact"],
          "tripping": ["jump@contact", "unplug@contact"]}
DEATHS = {
    "haply": [*SIGNALS, *(Death(who, number) for who in ("service", "link") for number in (signal.SIGKILL, signal.SIGSTOP))],
    "dhd": [*SIGNALS, *(Death("cable", name=f"cable: pulled, and calls {words}", events=PULLED, options=[f"unplugged={how}"])
                        for how, words in (("error", "fail"), ("block", "never return"), ("stale", "succeed")))],
    "command": [*SIGNALS, *(Death("program", number) for number in (signal.SIGKILL, signal.SIGSTOP))],
}


def is_timeless(kind, death):
    """Who stands still is missed after a time, and it is the device's own watchdog that ends the force of a client of DHD that is gone."""
    is_gone = death.who == "client" and death.number not in IN_ORDER
    return death.number != signal.SIGSTOP and "unplugged=block" not in death.options and not (kind == "dhd" and is_gone)


def made(kind, death, phase, patient):
    events = death.events[phase] if death.events else ["jump@contact"] if phase == "tripping" else []
    if death.who == "link":
        return arms.Haply(events, between=True)
    return arms.KINDS[kind](events, options=[*death.options, *(["watchdog-works=no"] if patient and kind == "dhd" else [])])


def moment_of(arm, phase, client):
    """Waits for it; false where it does not come."""
    def first(event, after=0):
        return arm.first(event, after, lambda: client.poll() is None)

    contact = first("contact") if phase not in ("opened", "settling") else None
    if phase == "free":
        come = contact and first("free", contact)
    elif phase == "tripping":
        come = contact and first("jump", contact)
    else:
        come = contact or first(phase)
    if not come or client.poll() is not None:
        return False
    if phase != "tripping":
        time.sleep(0.02)
    if phase == "stopping":
        client.send_signal(signal.SIGINT)
        time.sleep(0.001)
    return client.poll() is None


def died(kind, death, phase, forceshade, patient=None):
    """ms from the death to the last moment of force, none where it stays until the device's own time-out; the client's exit code and
    words; and its faults, among them those of its recording. None of all where the moment did not come."""
    with made(kind, death, phase, patient) as arm, tempfile.TemporaryDirectory() as folder:
        command = [forceshade, "drive", "--device", arm.device, "--law", "wall", "--uncertified", "--watchdog-timeout", "1", "--seconds", "9"]
        if patient:
            command = [patient, arm.device]
        client = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                  env={**os.environ, **arm.environment})
        try:
            if death.number is None:
                moment = arm.first("unplug", is_alive=lambda: client.poll() is None)
                if moment is None:
                    return None
            elif moment_of(arm, phase, client):
                moment = time.monotonic_ns()
                os.kill({"client": client.pid, "link": arm.link}.get(death.who) or arm.partner, death.number)
            else:
                return None
            stands_still = death.who == "client" and death.number == signal.SIGSTOP
            if stands_still:
                time.sleep(0.3)
                client.kill()
            _, words = client.communicate()
            if death.who == "link" and death.number == signal.SIGSTOP:
                time.sleep(0.3)  # until the service has noticed it
                arm.between.kill()
            until = None if death.who in ("service", "program") else arm.felt_until()
            end = STOPPED if stands_still else client.returncode
            faults = arm.verdict() if death.who in ("client", "cable") else set()
            if patient:
                verify = subprocess.run([forceshade, "recording", "verify", "run.fsr"], cwd=folder, text=True, capture_output=True)
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
    """Within which the arm has to be let go in contact, on a machine that never stands still; None where its own time-out decides."""
    arm_class = arms.KINDS[kind]
    if death.who in ("service", "program"):
        return None
    if death.number in IN_ORDER:
        return 4  # a tick, a frame, and the threads that wake up for them
    if death.number in (signal.SIGSTOP, None) or arm_class is arms.Dhd:
        return arm_class.longest_ms + 3
    return 12  # the system takes some ms to end a process


def is_in_order(death, phase, late, end, words, faults):
    """Whether the arm was let go at all, the client ended as it should, and the stand-in blames it for nothing but its death."""
    if late is None and death.who not in ("service", "program"):
        return False
    if death.who != "client":
        is_ended = end == 3 and words or end in (0, 130) and phase == "stopping"
        return is_ended and not faults - {"left-open", "abrupt-end", "force-at-end", "after-unplug"}
    if death.number in IN_ORDER:
        codes = {"opened": (0, 3, 130), "settling": (0, 3, 130), "tripping": (0, 3)}.get(phase, (0,))
        return end in codes and not faults - {"left-open"}
    codes = (STOPPED,) if death.number == signal.SIGSTOP else (-death.number, 0) if phase == "stopping" else (-death.number,)
    return end in codes and not faults - {"left-open", "abrupt-end", "force-at-end"}


def cell_of(kind, death, phase, forceshade, patient, checks):
    if not death.happens_in(phase) or patient and not is_timeless(kind, death):
        return "-"
    outcome = died(kind, death, phase, forceshade, patient)
    if outcome is None:
        checks.expect(not patient, f"{death.name}, {phase}: did not happen")
        return "did not happen"
    checks.expect(is_in_order(death, phase, *outcome), f"{death.name}, {phase}: {outcome}")
    late, end = outcome[:2]
    if late is None:
        return f"exit code {end}"
    return "0" if late == 0 else f"{late:.1f}"


def main(forceshade, kind, library, phases):
    patient = os.path.abspath(phases[0]) if os.path.exists(phases[0]) else None
    phases = ["in contact"] if patient else phases
    checks = Checks()
    arms.Dhd.library = library
    print(f"| death | {' | '.join(phases)} |\n|---|{'---|' * len(phases)}")
    for death in DEATHS[kind]:
        print(f"| {death.name} | {' | '.join(cell_of(kind, death, phase, forceshade, patient, checks) for phase in phases)} |", flush=True)
    return checks.exit_code(1)


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), sys.argv[2], os.path.abspath(sys.argv[3]), sys.argv[4:] or PHASES))
