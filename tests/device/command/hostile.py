# SPDX-License-Identifier: BSD-3-Clause
"""hostile.py MODE LOG: a device's program (docs/command-device.md) that does wrong what MODE says, in its hello or at its answer 50 from
the first that has a force. LOG gets a line for each line that it was sent, and "end of input"."""

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


HELLOS = {
    "no-peak": lambda: write(json.dumps({key: value for key, value in HELLO.items() if key != "peak_force_N"})),
    "peak-text": lambda: write(json.dumps({**HELLO, "peak_force_N": "3 N"})),
    "peak-nan": lambda: write(json.dumps({**HELLO, "peak_force_N": float("nan")})),
    "other-version": lambda: write(json.dumps({**HELLO, "forceshade-device": 2})),
    "unknown-key": lambda: write(json.dumps({**HELLO, "peek_force_N": 3})),
    "workspace-turned": lambda: write(json.dumps({**HELLO, "workspace_mm": [[100, 0, 0], [0, 1, 1]]})),
    "continuous-above-peak": lambda: write(json.dumps({**HELLO, "continuous_force_N": 4})),
    "half-a-button": lambda: write(json.dumps({**HELLO, "buttons": 0.5})),
    "paces-by-number": lambda: write(json.dumps({**HELLO, "paces": 1})),
    "no-hello": lambda: write("hello"),
    "key-twice": lambda: write(json.dumps(HELLO)[:-1] + ', "buttons": 3}'),
    "silent": wait,
    "fails": lambda: write(json.dumps({"failure": "no arm at /dev/ttyACM0"})),
    "exits": lambda: sys.exit("no arm is connected"),
    "long-hello": lambda: write(" " * 100_000),
    "uncalibrated": lambda: write(json.dumps({**HELLO, "to_calibrate": "turn each joint to its stop"})),
}
ANSWERS = {
    "garbage": lambda: write("}{"),
    "exits-at": lambda: sys.exit("the arm was unplugged"),
    "crashes": lambda: os.abort(),
}


def main():
    if mode == "forks":
        fork_daemon()
    if mode in ("ignores-signals", "hangs-at-end"):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)
    HELLOS.get(mode, lambda: write(json.dumps(HELLO)))()
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
            answer(calibrated=mode != "uncalibrated")
    print(time.monotonic(), "end of input", file=log)
    if mode == "ignores-signals":
        wait()


main()
