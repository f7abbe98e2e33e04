# SPDX-License-Identifier: BSD-3-Clause
"""The stand-in for Haply's Inverse Service as a process of a test's."""

import importlib.util
import json
import multiprocessing
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
    """The program itself."""

    def __init__(self, program, *words, sessions=1):
        self.folder = tempfile.TemporaryDirectory()
        self.log_file, report = os.path.join(self.folder.name, "log"), os.path.join(self.folder.name, "report")
        self.report_file = report
        its_words = ["--port", "0", "--sessions", str(sessions), "--report", report, "--log", self.log_file, *words]
        self.process = self.started(program, its_words)
        line = self.process.stdout.readline()
        if not line.startswith("listening on "):
            raise RuntimeError("the stand-in did not start: " + line + self.process.communicate()[1])
        self.address = line.split()[-1]

    @staticmethod
    def started(program, words):
        return subprocess.Popen([sys.executable, program, "haply", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

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


class Forked:
    """The part of Popen for a process that runs main(words) of the stand-in with the modules that this process has read."""

    def __init__(self, main, words):
        read, write = os.pipe()
        self.process = multiprocessing.get_context("fork").Process(target=self.run, args=(main, words, read, write))
        self.process.start()
        os.close(write)
        self.stdout = os.fdopen(read)

    @staticmethod
    def run(main, words, read, write):
        os.close(read)
        for stream in (1, 2):
            os.dup2(write, stream)
        os.close(write)
        sys.exit(main(words))

    def poll(self):
        return None if self.process.is_alive() else self.process.exitcode

    def kill(self):
        self.process.kill()

    def communicate(self):
        said = self.stdout.read() if not self.stdout.closed else ""
        self.stdout.close()
        self.process.join()
        return said, said

    @property
    def returncode(self):
        return self.process.exitcode


class ForkedStandIn(StandIn):
    """As the program, but for its beginning, which takes a tenth of a second of a processor."""

    @staticmethod
    def started(program, words):
        sys.dont_write_bytecode = True
        folder = os.path.dirname(program)
        if folder not in sys.path:
            sys.path.insert(0, folder)
        from haply.service import main

        return Forked(main, words)
