# SPDX-License-Identifier: BSD-3-Clause
"""deaths.py FORCESHADE: ends forceshade, and a device's program, while the arm feels a force, and prints how long it took until the
program had a zero force or the end of its input. Exit code 1 where it had neither, or a process is left.

deaths.py --program LOG is that program: an arm that goes into the wall and out of it. LOG gets the time of each line that it is sent."""

import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(1, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from checks import Checks, in_real_time  # noqa: E402

TRIES = 6  # on a busy machine the run may end before its moment comes


def program(log_file):
    with open(log_file, "a", buffering=1) as log:
        print(json.dumps({"forceshade-device": 1, "name": "an arm", "workspace_mm": [[-100, -100, -100], [100, 100, 100]],
                          "peak_force_N": 3, "continuous_force_N": 1, "resolution_mm": 0.05, "buttons": 0, "paces": False}), flush=True)
        begin = time.monotonic()
        for line in sys.stdin:
            print(time.monotonic_ns(), os.getpid(), line.strip(), file=log)
            if "end" in json.loads(line):
                return
            seconds = time.monotonic() - begin
            print(json.dumps({"time_s": seconds, "position_mm": [0, 0, 1.5 + 2.5 * math.cos(math.pi * seconds)], "buttons": 0}), flush=True)
        print(time.monotonic_ns(), os.getpid(), "end of input", file=log)


def lines_of(log):
    """(time in ns, process, line), as far as they are whole."""
    if not os.path.exists(log):
        return []
    with open(log) as file:
        whole = [line.rstrip("\n").split(" ", 2) for line in file if line.endswith("\n")]
    return [(int(time_ns), int(process), line) for time_ns, process, line in whole]


def gives_force(line):
    return line.startswith('{"force_N"') and any(json.loads(line)["force_N"])


def left(log):
    """Processes that have the log in their command line."""
    found = []
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/cmdline", "rb") as file:
                words = file.read()
        except OSError:
            continue
        if log.encode() in words and b"--program" in words and int(process) != os.getpid():
            found.append(process)
    return found


def death(forceshade, target, number):
    """ms until a zero force or the end of input, the exit code and words of forceshade, and the processes left; none where the
    moment did not come."""
    with tempfile.TemporaryDirectory() as folder:
        log = os.path.join(folder, "log")
        command = [forceshade, "drive", "--device", f"command:exec {in_real_time()}python3 {os.path.abspath(__file__)} --program {log}", "--law", "wall",
                   "--uncertified", "--watchdog-timeout", "1", "--seconds", "20"]
        client = subprocess.Popen(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            while not any(gives_force(line) for _, _, line in lines_of(log)):
                if client.poll() is not None:
                    return None
                time.sleep(0.01)
            time.sleep(0.05)
            if client.poll() is not None:
                return None
            moment = time.monotonic_ns()
            os.kill(client.pid if target == "forceshade" else lines_of(log)[-1][1], number)
            _, words = client.communicate(timeout=20)
            deadline = time.monotonic() + 5
            while left(log) and time.monotonic() < deadline:
                time.sleep(0.01)
            ends = [time_ns for time_ns, _, line in lines_of(log) if time_ns > moment and not gives_force(line)]
            return (ends[0] - moment) / 1e6 if ends else None, client.returncode, words, left(log)
        finally:
            client.kill()
            client.communicate()


def main(forceshade):
    checks = Checks()
    print("| death | the program has a zero force, or the end of its input, after |\n|---|---|")
    for target, number, code in (("forceshade", signal.SIGINT, 0), ("forceshade", signal.SIGTERM, 0), ("forceshade", signal.SIGHUP, 0),
                                 ("forceshade", signal.SIGKILL, -9), ("forceshade", signal.SIGSEGV, -11), ("program", signal.SIGKILL, 3)):
        outcome = None
        for _ in range(TRIES):
            outcome = outcome or death(forceshade, target, number)
        is_right = outcome and outcome[1] == code and not outcome[3] and (
            outcome[0] is not None if target == "forceshade" else "the program was killed by signal 9" in outcome[2])
        checks.expect(is_right, f"{target}: {number.name}: {outcome}")
        cell = "?" if not outcome else f"{outcome[0]:.1f} ms" if outcome[0] is not None else f"exit code {outcome[1]}: the program is gone"
        print(f"| {target}: {number.name} | {cell} |", flush=True)
    return checks.exit_code(6)


if sys.argv[1] == "--program":
    program(sys.argv[2])
else:
    sys.exit(main(os.path.abspath(sys.argv[1])))
