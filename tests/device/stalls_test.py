# SPDX-License-Identifier: BSD-3-Clause
"""A stall is seen, and a test that fails is skipped only where there was one each time."""

import os
import signal
import subprocess
import sys
import time

from checks import Checks
from stalls import Witness

STALLS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "stalls.py")
checks = Checks()

witness = Witness()
if witness.can_see:
    checks.expect(all(watch.poll() is None for watch in witness.watches), "a watch has ended")
    begin = time.monotonic_ns()
    watch = witness.watches[0]
    watch.send_signal(signal.SIGSTOP)  # as a machine that stands still stops it
    time.sleep(0.02)
    watch.send_signal(signal.SIGCONT)
    deadline = time.monotonic() + 10
    while not witness.stalled_since(begin) and time.monotonic() < deadline:
        time.sleep(0.001)
    checks.expect(witness.stalled_since(begin), "a stall of 20 ms was not seen")
    checks.expect(not witness.stalled_since(time.monotonic_ns() + 10**12), "a stall was seen that has not been")
else:
    checks.expect(witness.stalled_since(0), "without real-time priority every run may be late")
    checks.expect(not any(watch.poll() is None for watch in witness.watches), "nothing can watch without real-time priority")

for command, codes in ((["true"], (0,)), (["sh", "-c", "exit 3"], (3, 77))):
    run = subprocess.run([sys.executable, STALLS, *command], text=True, capture_output=True)
    checks.expect(run.returncode in codes, f"{command}: {run}")
    checks.expect((run.returncode == 77) == ("skipped: " in run.stdout), f"{command}: {run}")
sys.exit(checks.exit_code(6))
