# SPDX-License-Identifier: BSD-3-Clause
"""What the tests in Python share: their counts, several runs at a time, and a certified run whose recording is verified."""

import concurrent.futures
import json
import subprocess

from stalls import may_run_in_real_time


class Checks:
    """Counts what was not as expected, and says it."""

    def __init__(self):
        self.wrong, self.made = 0, 0

    def expect(self, holds, words):
        self.made += 1
        if not holds:
            self.wrong += 1
            print("WRONG:", words, flush=True)

    def exit_code(self, least):
        """The last line of a test: it fails, too, where fewer checks were made than it has."""
        print(f"{self.made} checks, {self.wrong} wrong")
        return 1 if self.wrong or self.made < least else 0


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
    """What stands in front of a command so that other programs do not make it late; nothing where the system does not permit it."""
    return "chrt --fifo 50 " if may_run_in_real_time() else ""
