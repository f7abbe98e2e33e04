# SPDX-License-Identifier: BSD-3-Clause
"""The stand-in for Haply's Inverse Service as a process of a test's."""

import importlib.util
import json
import os
import subprocess
import sys
import tempfile

sys.path.insert(1, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from checks import Checks  # noqa: E402,F401


def skip_without_websockets():
    if importlib.util.find_spec("websockets") is None:
        print("skipped: the Python package websockets is not there (Debian package python3-websockets)")
        sys.exit(77)


class StandIn:
    def __init__(self, program, *words, sessions=1):
        self.folder = tempfile.TemporaryDirectory()
        self.log_file, report = os.path.join(self.folder.name, "log"), os.path.join(self.folder.name, "report")
        self.report_file = report
        command = [sys.executable, program, "haply", "--port", "0", "--sessions", str(sessions), "--report", report, "--log", self.log_file]
        self.process = subprocess.Popen(command + list(words), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        if not line.startswith("listening on "):
            raise RuntimeError("the stand-in did not start: " + line + self.process.communicate()[1])
        self.address = line.split()[-1]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()
        self.folder.cleanup()

    def log(self):
        with open(self.log_file) as file:
            return [json.loads(line) for line in file if line.endswith("\n")]

    def verdict(self):
        """Once it has ended: its exit code and its report."""
        self.process.communicate()
        with open(self.report_file) as file:
            return self.process.returncode, json.load(file)
