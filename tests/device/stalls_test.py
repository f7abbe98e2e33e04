# SPDX-License-Identifier: BSD-3-Clause
"""A stall of 50 ms is measured as one, and an earlier one is not counted twice."""

import signal
import sys
import time

from checks import Checks
from stalls import Watch

checks, watch = Checks(), Watch()
if not watch.can_see:
    print("skipped: the system permits no real-time priority")
    sys.exit(77)
begin, longest = time.monotonic_ns(), 0.0
watch.processes[0].send_signal(signal.SIGSTOP)  # as a machine that stands still stops it
time.sleep(0.05)
watch.processes[0].send_signal(signal.SIGCONT)
while longest < 45:  # until it is noted
    longest = max(longest, watch.longest_since(begin))
checks.expect(watch.longest_since(begin + 10**12) == 0, "a stall was seen that has not been")
sys.exit(checks.exit_code(1))
