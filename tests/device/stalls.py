# SPDX-License-Identifier: BSD-3-Clause
"""Whether the machine itself stood still while a test ran, as a virtual machine does whose host is busy. A process on each processor,
of higher priority than any other, is to be woken every ms, and notes when it was not.

stalls.py COMMAND...: runs a test; where it fails while the machine stood still, again, and after the third time it is skipped."""

import atexit
import os
import subprocess
import sys
import tempfile
import time

LEAST_NS = 4_000_000  # a run is ended after 25 ms of silence, and has several steps that may each be late
TRIES = 3


def may_run_in_real_time():
    return subprocess.run(["chrt", "--fifo", "50", "true"], stdin=subprocess.DEVNULL, capture_output=True).returncode == 0


class Witness:
    """Where the system permits no real-time priority, other processes make a run late, and it says always that there was a stall."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        self.notes = [os.path.join(self.folder.name, str(processor)) for processor in sorted(os.sched_getaffinity(0))]
        self.watches = []
        self.can_see = may_run_in_real_time()
        if self.can_see:
            self.watches = [subprocess.Popen([sys.executable, os.path.abspath(__file__), "--watch", note], stdin=subprocess.DEVNULL,
                                             stdout=subprocess.DEVNULL) for note in self.notes]
        self.can_see = self.can_see and all(self.has_begun(watch, note) for watch, note in zip(self.watches, self.notes))
        atexit.register(self.end)

    @staticmethod
    def has_begun(watch, note):
        while watch.poll() is None and not os.path.exists(note):
            time.sleep(0.001)
        return watch.poll() is None

    def end(self):
        for watch in self.watches:
            watch.kill()
            watch.wait()
        self.folder.cleanup()

    def stalled_since(self, begin_ns):
        """Whether a stall ended after this time of time.monotonic_ns()."""
        for note in self.notes:
            if os.path.exists(note):
                with open(note) as file:
                    if any(int(line) > begin_ns for line in file if line.endswith("\n")):
                        return True
        return not self.can_see


def watch(note):
    """On the processor that the note's name says, until the test is gone: the end of each stall, in ns."""
    os.sched_setaffinity(0, {int(os.path.basename(note))})
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(99))
    test = os.getppid()
    last = time.monotonic_ns()
    with open(note, "a", buffering=1) as file:
        while os.getppid() == test:
            time.sleep(0.001)
            now = time.monotonic_ns()
            if now - last > LEAST_NS:
                print(now, file=file)
            last = now


def main(command):
    witness = Witness()
    for _ in range(TRIES):
        begin = time.monotonic_ns()
        code = subprocess.run(command).returncode
        if code == 0 or not witness.stalled_since(begin):
            return code
        print(f"failed with exit code {code}, while this machine stood still or was busy", flush=True)
    print(f"skipped: this machine stood still or was busy during each of {TRIES} runs")
    return 77


if __name__ == "__main__":
    if sys.argv[1] == "--watch":
        watch(sys.argv[2])
    else:
        sys.exit(main(sys.argv[1:]))
