# SPDX-License-Identifier: BSD-3-Clause
"""check_test.py STAND-IN LIBRARY FORCESHADE: `device check` promises that nothing pushes, so it never has the forces of the device
enabled, as a run has."""

import sys

from stand_in import Checks, Run

checks = Checks()
program, library, forceshade = sys.argv[1:4]


def enabled_by(*words):
    run = Run(program, library, [forceshade, *words], "--assume", "longest-gap=3600000")
    events = [event["event"] for event in run.log]
    checks.expect(events[:1] == ["opened"], f"{words}: the device is opened: {events} {run.err}")
    return "enabled" in events


checks.expect(not enabled_by("device", "check", "dhd", "--seconds", "0.2"), "a check enables no forces")
checks.expect(enabled_by("drive", "--device", "dhd", "--law", "wall", "--certificate", "none", "--seconds", "0.2"), "a run does")
sys.exit(checks.exit_code(4))
