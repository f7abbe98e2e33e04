#!/usr/bin/env python3
"""hostile_test.py FORCESHADE [NAME...]: each program and file of the tables whose name begins so gets the words of its verdict, in
bounded time and memory, and leaves no process. Those that are slow only with --slow, and then no others. --times prints each."""

import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

import hostile_renderers
import hostile_files
import hostile_objects
import hostile_simulators  # they fill the table
from hostile_programs import CASES

MOST_SECONDS, MOST_KB, AT_A_TIME, WAITING_AT_A_TIME = 120, 300_000, 2, 10


def peak_kb(process):
    try:
        with open(f"/proc/{process}/status") as status:
            return next((int(line.split()[1]) for line in status if line.startswith("VmHWM")), 0)
    except OSError:
        return 0


def with_mark(mark):
    found = []
    for process in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{process}/cmdline", "rb", buffering=0) as words:
                if mark.encode() in words.read().split(b"\0"):
                    found.append(process)
        except OSError:
            pass  # it has ended
    return found


def fault_of(forceshade, name, number):
    """The fault of the verdict about this one, or None."""
    case, mark = CASES[name], f"hostile_{os.getpid()}_{number}"
    with tempfile.TemporaryDirectory() as scratch, open(os.path.join(scratch, "printed"), "w+b") as printed:
        run = subprocess.Popen([forceshade] + case.run(mark, scratch), stdin=subprocess.DEVNULL, stdout=printed, stderr=subprocess.STDOUT,
                               cwd=scratch, env=os.environ | {"MARK": mark})  # fmt: skip
        begin, peak = time.monotonic(), 0
        while run.poll() is None:
            peak = max(peak, peak_kb(run.pid))
            if time.monotonic() - begin > MOST_SECONDS:
                run.kill()
                return f"it had not ended after {MOST_SECONDS} s"
            time.sleep(0.02)
        printed.seek(0)
        verdict = printed.read(100_000).decode(errors="replace")
    if run.returncode != case.code:
        return f"exit code {run.returncode}; expected {case.code}: {verdict}"
    if not any(one in verdict for one in case.words.split("|")):
        return f'expected "{case.words}", got: {verdict[:2000]}'
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
    options = [word for word in sys.argv[2:] if word.startswith("--")]
    prefixes = tuple(word for word in sys.argv[2:] if word not in options) or ("",)
    names = [name for name, case in CASES.items() if name.startswith(prefixes) and case.slow == ("--slow" in options)]
    assert names, "no such case"
    numbers = {name: number for number, name in enumerate(names)}
    faults = {}
    with tempfile.TemporaryDirectory() as cache:
        os.environ |= {"CACHE": cache, "FORCESHADE": forceshade}
        hostile_objects.precompile()
        # Those that wait take no time of a processor.
        for waits, at_a_time in ((True, WAITING_AT_A_TIME), (False, AT_A_TIME)):
            some = [name for name in names if CASES[name].waits == waits]
            with ThreadPoolExecutor(at_a_time) as pool:
                faults |= zip(some, pool.map(lambda name: fault_of(forceshade, name, numbers[name]), some))
    for name in names:
        if faults[name]:
            print(f"FAILED: {name}: {faults[name]}")
    kinds = [name.split()[0] for name in names]
    counts = ", ".join(f"{kinds.count(kind)} {kind}s" for kind in dict.fromkeys(kinds))
    print(f"{len(names)} hostile ones ({counts}), {sum(map(bool, faults.values()))} faults")
    return any(faults.values())


if __name__ == "__main__":
    sys.exit(main())
