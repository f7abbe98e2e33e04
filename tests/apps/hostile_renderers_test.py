#!/usr/bin/env python3
"""hostile_renderers_test.py FORCESHADE [NAME...]: each of hostile_renderers.py whose name begins so fails with the words of its
verdict, in bounded time and memory, and leaves no process. --times prints each."""

import os
import pathlib
import shlex
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

import hostile_renderers

MOST_SECONDS, MOST_KB, AT_A_TIME = 60, 300_000, 2


def peak_kb(process):
    try:
        with open(f"/proc/{process}/status") as status:
            return next((int(line.split()[1]) for line in status if line.startswith("VmHWM")), 0)
    except OSError:
        return 0


def with_mark(mark):
    found = []
    for entry in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            if mark.encode() in entry.read_bytes().split(b"\0"):
                found.append(entry.parent.name)
        except OSError:
            pass  # it has ended
    return found


def fault_of(forceshade, name, number):
    """What is wrong with the verdict about this renderer, or None."""
    words, mark = hostile_renderers.CASES[name][0], f"hostile_{os.getpid()}_{number}"
    command = "exec " + shlex.join([sys.executable, "-S", "-E", hostile_renderers.__file__, name, mark])
    # A busy machine may be slow to start a renderer, so that only those that do not answer or end get little time.
    timeout = "1" if hostile_renderers.LATE in words else "2" if "did not end" in words else "20"
    with tempfile.TemporaryDirectory() as scratch, open(os.path.join(scratch, "printed"), "w+b") as printed:
        run = subprocess.Popen(
            [forceshade, "conform", "--law", "wall", "--stiffness", "1.5", "--points", "256", "--answer-timeout", timeout, "--command", command],
            stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.STDOUT, cwd=scratch, env=os.environ | {"MARK": mark},
        )  # fmt: skip
        begin, peak = time.monotonic(), 0
        while run.poll() is None:
            peak = max(peak, peak_kb(run.pid))
            if time.monotonic() - begin > MOST_SECONDS:
                run.kill()
                return f"it had not ended after {MOST_SECONDS} s"
            time.sleep(0.02)
        printed.seek(0)
        verdict = printed.read(100_000).decode(errors="replace")
    if run.returncode != 1:
        return f"exit code {run.returncode}; expected 1: {verdict}"
    if not any(one in verdict for one in words.split("|")):
        return f'expected "{words}", got: {verdict[:2000]}'
    if len(verdict) > 20_000:
        return f"a verdict of {len(verdict)} characters"
    if peak > MOST_KB:
        return f"it took {peak} kB of memory; expected at most {MOST_KB}"
    if left := with_mark(mark):
        return f"it left the processes {left}"
    if "--times" in sys.argv:
        print(f"{time.monotonic() - begin:.2f} s {peak} kB {name}: {verdict.strip()[-160:]!r}", flush=True)
    return None


def main():
    forceshade = os.path.realpath(sys.argv[1])
    asked = [word for word in sys.argv[2:] if word != "--times"]
    names = [name for name in hostile_renderers.CASES if name.startswith(tuple(asked) or "")]
    assert names, "no such renderer"
    with ThreadPoolExecutor(AT_A_TIME) as pool:
        faults = list(pool.map(lambda of: fault_of(forceshade, of[1], of[0]), enumerate(names)))
    for name, fault in zip(names, faults):
        if fault:
            print(f"FAILED: {name}: {fault}")
    print(f"{len(names)} hostile renderers, {sum(map(bool, faults))} faults")
    return any(faults)


if __name__ == "__main__":
    sys.exit(main())
