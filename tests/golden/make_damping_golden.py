#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes damping/: paths through the damper of docs/damping.md, and single ticks chosen to hurt, in rational numbers.

Usage: make_damping_golden.py [directory]          (the default is damping/ beside this file; the output is always the same)
       make_damping_golden.py --check DIRECTORY    (computes the rows of such a folder again and compares every column)

Written from that page alone. A decision is a comparison of fractions, and a number is rounded once, where the page says so. Spring
forces are given to the stage, so any binary32 numbers serve as such: those of a wall and of a ball, drawn ones, and extremes.
"""

import csv
import random
import struct
import sys
from collections import Counter
from fractions import Fraction
from math import inf, isnan
from pathlib import Path

QUANTUM, SLOWEST, FARTHEST, STRONGEST = Fraction(1, 2**30), Fraction(1, 2**20), 10000, 2**26
reached = Counter()


def single(number):
    """The binary32 nearest to a float, an integer or a decimal; those of this program are within its range."""
    return struct.unpack("<f", struct.pack("<f", float(number)))[0]


def nearest(exact):
    """The binary32 nearest to a fraction, ties to even."""
    size = abs(exact)
    if not size:
        return 0.0
    exponent = size.numerator.bit_length() - size.denominator.bit_length()
    if Fraction(2)**exponent > size:
        exponent -= 1
    unit = Fraction(2)**(max(exponent, -126) - 23)
    whole, rest = divmod(size, unit)
    if 2 * rest == unit:
        reached["ties"] += 1
    if 2 * rest > unit or (2 * rest == unit and whole % 2):
        whole += 1
    return float(whole * unit) * (1 if exact > 0 else -1) or 0.0


def beside(number, steps):
    """The binary32 that is so many steps above in size."""
    return struct.unpack("<f", struct.pack("<I", struct.unpack("<I", struct.pack("<f", number))[0] + steps))[0]


def shortest(number):
    """The shortest decimal that reads back as this binary32."""
    if number in (inf, -inf) or isnan(number):
        return str(number)
    for digits in range(1, 10):
        text = f"{number:.{digits}g}"
        if single(text) == number:
            return text[:-2] if text.endswith(".0") else text
    raise AssertionError(number)


# ---------------------------------------------------------------- the definition

class Damping:
    def __init__(self, rate, share, damping, most, drag, full_at):
        assert 1 <= rate <= 2**17 and Fraction(1, 2**10) <= share <= 1 and (most == inf or 1 <= most <= 2**10)
        assert all(b == 0 or Fraction(1, 2**20) <= b <= 16 for b in (damping, drag)) and Fraction(1, 2**10) <= full_at <= 2**10
        assert damping or drag, "without both there is no stage"
        self.numbers = rate, share, damping, most, drag, full_at
        self.rate, self.share, self.damping, self.drag, self.full_at = map(Fraction, (rate, share, damping, drag, full_at))
        self.most = None if most == inf else Fraction(most)
        self.position, self.velocity, self.periods = None, (0.0,) * 3, 0

    def tick(self, position, periods, force, is_refused=False, limits=(inf, inf)):
        """The damped force; None where the tick is invalid. limits: the most of B and B_t that acts where the force is from."""
        if self.position is not None:
            self.periods = min(self.periods + periods, 17)
        if is_refused or not all(abs(c) <= FARTHEST for c in position):
            reached["invalid positions"] += 1
            return None
        if periods:
            self.move(tuple(Fraction(c) if abs(c) >= QUANTUM else Fraction(0) for c in position))
        else:
            reached["no time has passed"] += 1
        here = [Fraction(min(its, limit)) for its, limit in zip((self.damping, self.drag), limits)]
        if here != [self.damping, self.drag]:
            reached["a face damps less" if any(here) else "a face does not damp"] += 1
        return self.force(tuple(force), *here)

    def move(self, x):
        if self.position is None or self.periods > 16:
            reached["begins" if self.position is None else "begins again"] += 1
            self.velocity = (0.0,) * 3
        else:
            if self.periods > 1:
                reached["missed positions"] += 1
            for _ in range(self.periods):
                self.velocity = tuple(self.filtered(v, self.rate * (to - at) / self.periods)
                                      for v, at, to in zip(self.velocity, self.position, x))
        self.position, self.periods = x, 0

    def filtered(self, v, u):
        after = nearest(Fraction(v) + self.share * (u - Fraction(v)))
        if after and abs(after) < SLOWEST:
            reached["comes to rest"] += 1
        return after if abs(after) >= SLOWEST else 0.0

    def force(self, given, damping, most_drag):
        if not all(abs(c) < STRONGEST for c in given):
            reached["too strong, or no number"] += 1
            return given
        if not any(given):
            return (0.0,) * 3
        f, v = ([Fraction(c) for c in a] for a in (given, self.velocity))
        square, along = sum(c * c for c in f), sum(a * b for a, b in zip(v, f))
        scale = 1 - damping * along / square
        if scale <= 0:
            reached["s = 0" if scale < 0 else "s is 0 exactly"] += 1
            scale = Fraction(0)
        if self.most is not None and scale >= self.most:
            reached["s = S" if scale > self.most else "s is S exactly"] += 1
            scale = self.most
        full = scale * square / self.full_at**2
        if most_drag and any(v):
            reached["full drag" if full > 1 else "drag is just full" if full == 1 else "part of the drag"] += 1
        drag = min(Fraction(1), full) * most_drag
        damped = tuple(nearest(scale * a - drag * (b - along * a / square)) for a, b in zip(f, v))
        if any(0 < abs(c) < 2.0**-126 for c in damped):
            reached["subnormal forces"] += 1
        return damped


# ---------------------------------------------------------------- files

PARAMETERS = ["rate_Hz", "alpha", "damping_Ns_mm", "most", "drag_Ns_mm", "drag_from_N"]
POSITION, SPRING = ["x_mm", "y_mm", "z_mm"], ["fx_N", "fy_N", "fz_N"]
VELOCITY, FORCE = ["vx_mm_s", "vy_mm_s", "vz_mm_s"], ["Fx_N", "Fy_N", "Fz_N"]
LIMITS = ["damping_limit_Ns_mm", "drag_limit_Ns_mm"]  # only of a path on faces that have some


def rows_of(damping, path):
    """path: (periods, position, spring force) for each tick, and the limits where it is on faces that have some."""
    for periods, position, force, *limits in path:
        damped = damping.tick(position, periods, force, False, *limits)
        status = "invalid" if damped is None else "contact" if any(force) else "free"
        given = (0.0,) * 3 if damped is None else force
        yield [periods, *map(shortest, position), status, *map(shortest, given),
               *map(shortest, (*damping.velocity, *(damped or (0.0,) * 3), *(limits[0] if limits else ())))]


def single_tick(numbers, velocity, force):
    damping = Damping(1000.0, 1.0, *numbers)
    damping.position, damping.velocity = (Fraction(0),) * 3, velocity
    return [*map(shortest, (*numbers, *velocity, *force, *damping.tick((0.0,) * 3, 0, force)))]


def check(folder):
    def values(row, names):
        return tuple(single(row[name]) for name in names)
    wrong = rows = 0
    with open(folder / "parameters.csv", encoding="ascii") as file:
        parameters = {row["path"]: values(row, PARAMETERS) for row in csv.DictReader(file)}
    for name, numbers in parameters.items():
        damping = Damping(*numbers)
        with open(folder / f"{name}.csv", encoding="ascii") as file:
            for row in csv.DictReader(file):
                limits = values(row, LIMITS) if LIMITS[0] in row else (inf, inf)
                force = damping.tick(values(row, POSITION), int(row["periods"]), values(row, SPRING), False, limits) or (0.0,) * 3
                rows += 1
                wrong += list(map(shortest, (*damping.velocity, *force))) != list(map(shortest, values(row, VELOCITY + FORCE)))
    with open(folder / "ticks.csv", encoding="ascii") as file:
        for row in csv.DictReader(file):
            given = values(row, PARAMETERS[2:]), values(row, VELOCITY), values(row, SPRING)
            rows += 1
            wrong += single_tick(*given)[-3:] != list(map(shortest, values(row, FORCE)))
    print(f"{rows} rows, {wrong} wrong")
    return wrong


# ---------------------------------------------------------------- paths

def smooth(random_, ticks, size, speed):
    """A path of the hand: it goes for drawn places, and slows before them."""
    at, toward, v = [0.0] * 3, [0.0] * 3, [0.0] * 3
    for tick in range(ticks):
        if tick % 40 == 0:
            toward = [random_.uniform(-size, size) for _ in at]
        for i in range(3):
            v[i] = 0.8 * v[i] + 0.2 * max(-speed, min(speed, 0.1 * (toward[i] - at[i])))
            at[i] += v[i]
        yield tuple(map(single, at))


def wall(x, stiffness=0.5):
    return (0.0, 0.0, single(-stiffness * x[2]) if x[2] < 0 else 0.0)


def ball(x, radius=8.0, stiffness=0.3):
    length = sum(c * c for c in x)**0.5
    if not 0 < length < radius:
        return (0.0,) * 3
    return tuple(single(stiffness * (radius - length) * c / length) for c in x)


def paths():
    r = random.Random(54)
    for name, numbers in (("wall", (1000, 1, 0.002, 2, 0, 0.25)), ("strong", (1000, 0.5, 0.03, 1.5, 0, 0.25))):
        yield name, numbers, [(1, x, wall(x)) for x in smooth(r, 200, 4, 0.6)]
    count = 0.03
    yield "counts", (1000, 0.25, 0.005, inf, 0, 0.25), [
        (1, x, wall(x)) for x in (tuple(single(count * round(c / count)) for c in y) for y in smooth(r, 200, 1, 0.05))]
    yield "drag", (1000, 0.125, 0.001, 2, 0.0005, 0.25), [(1, x, ball(x)) for x in smooth(r, 300, 9, 0.4)]
    late = []
    for x in smooth(r, 300, 6, 0.5):
        kind = r.randrange(12)
        if kind == 0:
            x = r.choice([(float("nan"), 0.0, 0.0), (20000.0, 0.0, -1.0), (0.0, -inf, 0.0), (0.0, 0.0, beside(10000.0, 1))])
        if kind == 1 and late:
            x = late[-1][1]
        late.append((r.choice([2, 3, 5, 15, 16, 17, 40]) if kind < 4 else 0 if kind == 4 else 1, x,
                     ball(x) if all(abs(c) <= 10000 for c in x) else (0.0,) * 3))
    yield "late", (500, 0.1, 0.003, 4, 0.001, 0.5), [(1, (inf, 0.0, 0.0), (0.0,) * 3), (3, (0.0,) * 3, (0.0, 0.0, 1.0))] + late
    jumps = []
    for tick in range(300):
        x = tuple(single(r.choice([-1, 1]) * 2.0**r.uniform(-33, 13.28)) for _ in range(3))
        f = tuple(single(r.choice([-1, 0, 1]) * 2.0**r.uniform(-149, 25.9)) for _ in range(3))
        if tick % 20 == 0:
            f = r.choice([(inf, 0.0, 0.0), (float("nan"), 1.0, 0.0), (2.0**26, 0.0, 1.0), (0.0, beside(2.0**26, -1), 0.0)])
        jumps.append((r.choice([1, 1, 1, 2, 16]), x if tick % 7 else jumps[-1][1] if jumps else x, f))
    yield "jumps", (2**17, beside(1.0, -1), 16, 2**10, 2.0**-20, 2.0**-10), jumps
    yield "slow", (1, 2.0**-10, 2.0**-20, 1, 16, 2**10), [
        (1, x, ball(x)) for x in smooth(r, 200, 6, 0.5)]
    stop = [(1, (0.0, single(0.02 * min(tick, 20)), -1.0), (single(0.1), 0.0, 0.5)) for tick in range(100)]
    yield "rest", (1000, 0.25, 0.002, 2, 0.002, 0.25), stop
    numbers = [inf, 0.0, 2.0**-20, single(0.0007), single(0.004), 0.5]
    yield "faces", (1000, 0.5, 0.004, 2, 0.001, 0.25), [
        (0 if tick % 50 == 9 else 1, x, ball(x), (r.choice(numbers), r.choice(numbers)))
        for tick, x in enumerate(smooth(r, 300, 6, 0.5))]


def odd(r):
    """A binary32 in [1, 2) whose last bit is set."""
    return 1 + (2 * r.randrange(2**22) + 1) * 2.0**-23


def ticks():
    r = random.Random(55)

    def power(low, high):
        return 2.0**r.randint(low, high)

    def legal(v):
        return single(v) if 2.0**-20 <= abs(v) <= 2.0**32 else 0.0
    for _ in range(25):  # f along an axis: F = f - B v, a middle between two binary32 numbers or a step beside it
        b, f = power(-20, 4), odd(r) * power(-3, 4)
        for v in (f * 2.0**-24 * r.choice([1, 3, 5]), f * r.choice([0.5, 0.25, -0.25]) * odd(r)):
            v = legal(v / b)
            for step in (-1, 0, 1):
                yield (b, inf, 0.0, 0.25), (0.0, 0.0, beside(v, step) if v else v), (0.0, 0.0, f)
    for _ in range(20):  # s = 0 and s = S, exactly and a step beside
        b, most, f = power(-12, 0), r.choice([1.0, 1.5, 2.0, 3.0, 1024.0]), tuple(odd(r) * power(-3, 3) for _ in range(3))
        for scale in (1.0, 1 - most):
            v = tuple(single(scale * c / b) for c in f)
            exact = tuple(single(c) for c in (Fraction(scale) * Fraction(c) / Fraction(b) for c in f))
            for step in (-1, 0, 1) if exact[0] else (0,):
                yield (b, most, 0.0, 0.25), (beside(v[0], step) if v[0] else 0.0, *v[1:]), f
    for _ in range(20):  # s f a tie in every component
        f = tuple(odd(r) for _ in range(3))
        yield (1.0, inf, 0.0, 0.25), tuple(-c / 2 for c in f), f
        yield (0.5, 1.5, 0.0, 0.25), tuple(-4 * c for c in f), f
    for _ in range(20):  # drag that is just full, in ties, and a step beside
        f0, bt = power(-4, 4), power(-10, 2)
        v = legal(odd(r) * power(-1, 6))
        for step in (-1, 0, 1):
            yield (0.0, 2.0, bt * 1.5, f0), (v, v / 2, 0.0), (0.0, 0.0, beside(f0, step))
    for _ in range(40):  # v nearly across f: v·f cancels
        f = tuple(single(r.uniform(-1, 1)) for _ in range(3))
        v = (single(f[1] * 100), single(-f[0] * 100), legal(r.choice([0.0, 2.0**-20, 2.0**-12])))
        yield (single(0.01), 2.0, single(0.001), 0.25), v, f
    for size in (-149, -140, -127, -100, 20, 25):
        for _ in range(12):
            f = tuple(single(r.choice([-1, 0, 1, 1]) * r.uniform(1, 1.9) * 2.0**size) for _ in range(3))
            v = tuple(legal(r.choice([-1, 0, 1]) * r.uniform(1, 2) * power(-20, 31)) for _ in range(3))
            yield (power(-20, 4), r.choice([1.0, 2.0, 1024.0, inf]), r.choice([0.0, power(-20, 4)]), power(-10, 10)), v, f


def write(folder):
    def table(name, header, rows):
        with open(folder / f"{name}.csv", "w", encoding="ascii", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([header, *rows])
    folder.mkdir(exist_ok=True)
    parameters = []
    for name, given, path in paths():
        damping = Damping(*map(single, given))
        parameters.append([name, *map(shortest, damping.numbers)])
        limits = LIMITS if len(path[0]) == 4 else []
        table(name, ["periods", *POSITION, "status", *SPRING, *VELOCITY, *FORCE, *limits], rows_of(damping, path))
    table("parameters", ["path", *PARAMETERS], parameters)
    table("ticks", [*PARAMETERS[2:], *VELOCITY, *SPRING, *FORCE],
          (single_tick(tuple(map(single, numbers)), v, f) for numbers, v, f in ticks()))
    for event, times in sorted(reached.items()):
        print(f"{times:6} {event}")
    missing = {"ties", "invalid positions", "no time has passed", "begins", "begins again", "missed positions", "comes to rest",
               "too strong, or no number", "s = 0", "s is 0 exactly", "s = S", "s is S exactly", "full drag", "drag is just full",
               "part of the drag", "subnormal forces", "a face damps less", "a face does not damp"} - set(reached)
    assert not missing, missing


if __name__ == "__main__":
    if sys.argv[1:2] == ["--check"]:
        sys.exit(check(Path(sys.argv[2])) != 0)
    write(Path(sys.argv[1]) if sys.argv[1:] else Path(__file__).resolve().parent / "damping")
