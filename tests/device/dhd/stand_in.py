# SPDX-License-Identifier: BSD-3-Clause
"""The stand-in for DHD: a client is run with it, and its verdict is read."""

import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(1, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from checks import Checks  # noqa: E402,F401

PYTHON = [sys.executable, "-SEB"]  # starts in half of the time without the site's modules, and leaves no compiled ones in the sources


class Run:
    """A client's output, its faults, and its last session."""

    def __init__(self, program, library, command, *words, cwd=None):
        with tempfile.TemporaryDirectory() as folder:
            report, log = os.path.join(folder, "report"), os.path.join(folder, "log")
            whole = [*PYTHON, program, "dhd", "--library", library, "--report", report, "--log", log, *words, "--", *command]
            done = subprocess.run(whole, cwd=cwd, text=True, capture_output=True)
            self.code, self.out, self.err = done.returncode, done.stdout, done.stderr
            self.verdict, self.faults, self.session, self.log = None, {}, None, []
            if os.path.exists(report):
                with open(report) as file:
                    self.verdict = json.load(file)
                self.faults = self.verdict["faults"]
                self.session = (self.verdict["sessions"] or [None])[-1]
                with open(log) as file:
                    self.log = [json.loads(line) for line in file]
