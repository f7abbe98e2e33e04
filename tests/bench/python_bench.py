# SPDX-License-Identifier: BSD-3-Clause
"""The cost of the package for Python: a call, batches in and out of the cache beside numpy.copyto, and a whole program.

No test, but figures for docs/python.md; run it on an idle machine, beside forceshade_c_bench, which has C++'s times:
PYTHONPATH=build/release/python python3 tests/bench/python_bench.py
"""

import subprocess
import sys
import time
import timeit

import numpy as np

import forceshade

BUMPS = {"wall": {}, "bump-2p": {"radius": 15.24, "width": 25.4}, "bump-3p-shaded": {"radius": 15.24, "width": 25.4}}
SCRIPT = """
import forceshade, numpy
at = numpy.zeros((1_000_000, 3), numpy.float32); at[:, 2] = -1
forceshade.Law("bump-2p", radius=15.24, width=25.4, stiffness=0.5).forces(at)
"""


def stroke(count):
    """The positions of forceshade_c_bench."""
    ms = (np.arange(count) % 4096).astype(np.float32)
    x, z = 12 * np.sin(np.float32(0.0015) * ms), -1 - np.float32(0.5) * np.sin(np.float32(0.01) * ms)
    return np.stack([x, np.zeros_like(x), z], axis=-1)


def best(work, count, repetitions=7):
    """ns for each of so many."""
    return min(timeit.repeat(work, number=1, repeat=repetitions)) / count * 1e9


def main():
    for name, shape in BUMPS.items():
        law = forceshade.Law(name, stiffness=0.5, **shape)
        session = forceshade.Session(law)
        for what, call in (("force", law.force), ("step", session.step)):
            ns = min(timeit.repeat(lambda: call(3.0, 0.0, -0.5), number=100_000, repeat=7)) / 1e5 * 1e9
            print(f"{name}: {what}(x, y, z): {ns:.0f} ns")
        for count in (4096, 10_000_000):
            at = stroke(count)
            out = at.copy()  # memory that has been written before
            rounds = max(1, 1_000_000 // count)
            batch = best(lambda: [law.forces(at, out=out) for _ in range(rounds)], count * rounds)
            copy = best(lambda: [np.copyto(out, at) for _ in range(rounds)], count * rounds)
            print(f"{name}: forces() of {count}: {batch:.2f} ns each; numpy.copyto {copy:.2f} ns")
    times = []
    for script in ("import numpy", "import forceshade", SCRIPT):
        times.append(min(run(script) for _ in range(5)))
    print(f"python3 that imports numpy {times[0]:.2f} s, forceshade {times[1]:.2f} s, and a million forces {times[2]:.2f} s")


def run(script):
    started = time.perf_counter()
    subprocess.run([sys.executable, "-c", script], check=True)
    return time.perf_counter() - started


main()
