# SPDX-License-Identifier: BSD-3-Clause
"""hostile.py MODE LOG: a device's program (docs/command-device.md) that does wrong what MODE says, at its answer 50 from the first that
has a force, or at its end. LOG gets a line for each line that it was sent, and "end of input"."""

import json
import os
import signal
import sys
import time

mode, log_file = sys.argv[1:3]
AT = 50
log = open(log_file, "a", buffering=1)
HELLO = {"forceshade-device": 1, "name": "test arm", "workspace_mm": [[-100, -100, -100], [100, 100, 100]], "peak_force_N": 3,
         "continuous_force_N": 1, "resolution_mm": 0.05, "buttons": 2, "paces": False}
begin = time.monotonic()


def write(text):
    sys.stdout.write(text + "\n")
    sys.stdout.flush()


def answer(**other):
    write(json.dumps({"time_s": time.monotonic() - begin, "position_mm": [0, 0, 20], "buttons": 0, **other}))


def wait():
    while True:
        time.sleep(1)


def fork_daemon():
    if os.fork() == 0:
        os.setsid()
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
        os.closerange(0, 3)
        wait()


ANSWERS = {"garbage": lambda: write("}{"), "crashes": os.abort}


def main():
    if mode == "forks":
        fork_daemon()
    if mode in ("ignores-signals", "hangs-at-end"):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
    write(json.dumps({**HELLO, "to_calibrate": "turn each joint to its stop"} if mode == "uncalibrated" else HELLO))
    count = 0
    for line in sys.stdin:
        print(time.monotonic(), line.strip(), file=log)
        if "end" in json.loads(line):
            if mode == "hangs-at-end":
                wait()
            return
        count += count > 0 or any(json.loads(line)["force_N"])
        if mode in ANSWERS and count == AT:
            ANSWERS[mode]()
        elif mode == "chatters" and count % 10 == 0:
            print("a word to nobody " * 10, file=sys.stderr, flush=True)
            answer()
        else:
            answer(calibrated=mode != "uncalibrated", forces_on=mode != "off")
    print(time.monotonic(), "end of input", file=log)
    if mode == "ignores-signals":
        wait()


main()
