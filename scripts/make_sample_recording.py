#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a made-up but plausible hand, sampled at 1 kHz: it strokes across a bump, then taps its top.

The same file comes out every time. Usage: make_sample_recording.py [FILE], by default examples/recordings/strokes.csv.
"""

import math
import pathlib
import random
import sys

RADIUS = 15.24  # mm
WIDTH = 25.4  # mm
DEPTH = math.sqrt(RADIUS**2 - (WIDTH / 2) ** 2)  # of the cylinder's axis below the plane, mm
TOP = RADIUS - DEPTH  # mm
REACH = 20.0  # strokes end here, on the plane beside the bump, mm
PERIOD = 0.001  # s

rng = random.Random(1995)


def minimum_jerk(s):
    """From 0 at s = 0 to 1 at s = 1, with zero velocity and acceleration at both ends."""
    return s**3 * (10 - 15 * s + 6 * s**2)


def surface(x):
    """Plane and cylinder, with the corner between them rounded as a fingertip rounds it."""
    edge = WIDTH / 2
    beyond = max(abs(x) - edge, 0)
    cylinder = math.sqrt(RADIUS**2 - min(abs(x), edge) ** 2) - DEPTH - beyond * edge / DEPTH
    softness = 0.4  # mm
    return softness * math.log1p(math.exp(cylinder / softness))


def stroke_height(x, t):
    """1 mm below the plane beside the bump, 0.5 to 2 mm below the surface on it."""
    on_bump = max(surface(x), 0) / TOP
    return surface(x) - 1 - on_bump * (0.25 + 0.65 * math.sin(2 * math.pi * 0.37 * t))


def moves():
    """(duration, x, y, z) of the end of each move; z is None where the hand follows the surface."""
    yield 1.2, -REACH, 0.0, -1.0
    for stroke in range(8):
        yield rng.uniform(0.75, 0.95), REACH if stroke % 2 == 0 else -REACH, rng.uniform(-4, 4), None
    yield 0.5, -12.0, 1.0, 14.0
    yield 0.5, 0.8, 0.5, TOP + 6
    for _ in range(4):
        yield 0.22, rng.uniform(-1.5, 1.5), 0.5, TOP - rng.uniform(0.8, 1.8)
        yield 0.26, rng.uniform(-1.5, 1.5), 0.5, TOP + rng.uniform(4, 7)
    yield 0.7, 6.0, 0.0, 30.0


def hand(moves):
    """The hand's position as a function of time, and when it comes to rest."""
    schedule = []
    start, begin = 0.0, (-26.0, 4.0, 35.0)
    for duration, x, y, z in moves:
        end = (x, y, stroke_height(x, start + duration) if z is None else z)
        schedule.append((start, duration, begin, end, z is None))
        start, begin = start + duration, end

    def position(t):
        at, duration, begin, end, follows = [move for move in schedule if move[0] <= t][-1]
        share = minimum_jerk(min((t - at) / duration, 1))
        x, y, z = (b + (e - b) * share for b, e in zip(begin, end))
        return x, y, stroke_height(x, t) if follows else z

    return position, start


def tremor():
    """Physiological: 8 to 12 Hz, a few hundredths of a millimetre, waxing and waning as its three tones beat."""
    tones = [(rng.uniform(8, 12), rng.uniform(0, 2 * math.pi), rng.uniform(0.007, 0.016)) for _ in range(3)]
    return lambda t: sum(size * math.sin(2 * math.pi * rate * t + phase) for rate, phase, size in tones)


def sample_times(count):
    """A timer's ticks with its jitter: some 20 µs, and now and then late by up to half a millisecond."""
    last = 0.0
    for k in range(count):
        late = abs(rng.gauss(0, 20e-6)) + (rng.uniform(1e-4, 5e-4) if rng.random() < 0.004 else 0)
        last = max(last, k * PERIOD + (late if k else 0))
        yield last


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "examples" / "recordings" / "strokes.csv"
    path = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    position, end = hand(moves())
    tremors = [tremor() for _ in range(3)]
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("t_s,x_mm,y_mm,z_mm\n")
        for t in sample_times(round((end + 0.3) / PERIOD)):
            numbers = [p + shake(t) for p, shake in zip(position(t), tremors)]
            # Adding 0.0 turns a rounded -0.0 into 0.0.
            file.write(f"{t:.6f}," + ",".join(f"{round(n, 3) + 0.0:.3f}" for n in numbers) + "\n")


if __name__ == "__main__":
    main()
