# SPDX-License-Identifier: BSD-3-Clause
"""Measures how long the machine itself stood still, as a virtual machine does whose host is busy. A process on each processor,
of higher priority than any other, is to be woken every ms, and notes by how much it was later."""

import atexit
import os
import subprocess
import sys
import tempfile
import time

PERIOD_NS = 1_000_000
LEAST_NS = 100_000  # later than this is noted


def may_run_in_real_time():
    return subprocess.run(["chrt", "--fifo", "50", "true"], stdin=subprocess.DEVNULL, capture_output=True).returncode == 0


class Watch:
    """can_see is False where the system permits no real-time priority: then other processes make the watch late, too."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        notes = [os.path.join(self.folder.name, str(processor)) for processor in sorted(os.sched_getaffinity(0))]
        self.can_see = may_run_in_real_time()
        self.processes = [subprocess.Popen([sys.executable, os.path.abspath(__file__), note], stdin=subprocess.DEVNULL)
                          for note in notes if self.can_see]
        atexit.register(self.end)
        while self.can_see and not all(map(os.path.exists, notes)):
            time.sleep(0.001)
        self.files = [open(note) for note in notes if self.can_see]

    def end(self):
        for process in self.processes:
            process.kill()
            process.wait()
        self.folder.cleanup()

    def longest_since(self, begin_ns):
        """In ms, of those that ended after this time of time.monotonic_ns() and were not asked for before."""
        lines = [line.split() for file in self.files for line in file]
        return max((int(late) / 1e6 for end, late in lines if int(end) > begin_ns), default=0.0)


def watch(note):
    """On the processor that the note's name says, until its parent is gone."""
    os.sched_setaffinity(0, {int(os.path.basename(note))})
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(99))
    parent, last = os.getppid(), time.monotonic_ns()
    with open(note, "a", buffering=1) as file:
        while os.getppid() == parent:
            time.sleep(PERIOD_NS / 1e9)
            now = time.monotonic_ns()
            if now - last > PERIOD_NS + LEAST_NS:
                print(now, now - last - PERIOD_NS, file=file)
            last = now


if __name__ == "__main__":
    watch(sys.argv[1])
