# SPDX-License-Identifier: BSD-3-Clause
"""What the tests in Python share: their counts, several runs at a time, and a certified run whose recording is verified."""

import concurrent.futures
import functools
import json
import subprocess
import sys
import time

from stalls import Witness, may_run_in_real_time


class Checks:
    """Counts what was not as expected, and says it."""

    def __init__(self):
        self.wrong, self.made = 0, 0

    def expect(self, holds, words):
        self.made += 1
        if not holds:
            self.wrong += 1
            print("WRONG:", words, flush=True)

    @functools.cached_property
    def witness(self):
        return Witness()

    def in_time(self, run, is_late, tries=8):
        """What the first run gives that is not late, or the last of so many. Ends the test as skipped where each run was late, and the
        machine stood still during most of them; but where something was wrong before, that is the outcome."""
        witness, stalls = self.witness, 0
        for _ in range(tries):
            begin = time.monotonic_ns()
            outcome = run()
            if not is_late(outcome):
                return outcome
            stalls += witness.stalled_since(begin)
        if 2 * stalls > tries and not self.wrong:
            print(f"skipped: {tries} runs were late, and this machine stood still or was busy during {stalls} of them: {outcome}")
            sys.exit(77)
        return outcome

    def exit_code(self, least):
        """The last line of a test: it fails, too, where fewer checks were made than it has."""
        print(f"{self.made} checks, {self.wrong} wrong")
        return 1 if self.wrong or self.made < least else 0


# What is said on a machine that is too busy for a run, which is then tried again. A hand that jumps in a frame that is late by some
# 10 ms has only gone too fast.
BUSY = ("too irregular", "no frame of the device came in time", "stopped the run: watchdog", "has not answered for", "no answer in time",
        "did not answer within", "its watchdog got no force in time", "the servo loop has stood still", "stopped the run: velocity")


def at_once(run, names, most):
    """So many at a time: each keeps a third of a processor busy."""
    with concurrent.futures.ThreadPoolExecutor(most) as pool:
        return dict(zip(names, pool.map(run, names)))


def certify_wall(forceshade, folder):
    """Options of drive with the certificate of the wall, a recording and a summary, all in this folder."""
    certify = [forceshade, "certify", "--law", "wall", "--stiffness", "0.5", "--out", "certificate"]
    subprocess.run(certify, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return ["--certificate", "certificate/certificate.json", "--record", "run.fsr", "--json", "summary", "--overwrite"]


def recorded(forceshade, folder, checks):
    """The summary of such a run, whose recording is verified."""
    verify = subprocess.run([forceshade, "recording", "verify", "run.fsr"], cwd=folder, text=True, capture_output=True)
    checks.expect(verify.returncode == 0, f"recording verify: {verify.stdout}{verify.stderr}")
    print(verify.stdout, end="")
    with open(folder + "/summary") as file:
        summary = json.load(file)
    checks.expect(summary["paced_by"] == "device", f"summary: {summary}")
    return summary


def in_real_time():
    """What stands in front of a command so that a busy machine does not make it late; nothing where the system does not permit it."""
    return "chrt --fifo 50 " if may_run_in_real_time() else ""
