#!/usr/bin/env python3
"""positions.py LAWS SEED: prints laws and positions for code_rows and model_rows: the hard cases of tests/laws, then LAWS laws with 16
positions each, aimed at the regions that the proofs distinguish. The last lines count the positions of each region."""

import collections
import math
import pathlib
import random
import struct
import sys

NAMES = ["wall", "cylinder", "bump-cylinder", "bump-1p", "bump-2p", "bump-3p", "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"]
TRIPLES = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (7, 24, 25), (20, 21, 29), (12, 35, 37), (9, 40, 41), (28, 45, 53)]
QUANTUM = 2.0**-30
draws = random.Random(int(sys.argv[2]))


def near(value):
    """The binary32 nearest to value."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def bits(value):
    return struct.unpack("<I", struct.pack("<f", value))[0]


def beside(value, steps):
    """The binary32 that lies so many numbers above value."""
    order = bits(near(value))
    order = (order if order < 2**31 else 2**31 - order) + steps
    return struct.unpack("<f", struct.pack("<I", order if order >= 0 else 2**31 - order))[0]


def below(count):
    return int(draws.random() * count)


def between(low, high):
    return low + (high - low) * draws.random()


def one_of(items):
    return items[below(len(items))]


def sign():
    return one_of((1.0, -1.0))


def short(value):
    """A number of few bits near value, for ties of the rounding."""
    if value == 0:
        return 0.0
    mantissa, exponent = math.frexp(value)
    length = one_of((1, 2, 4, 8, 12))
    return near(math.ldexp(round(mantissa * 2**length), exponent - length))


def stiffness():
    value = near(10 ** between(-2.99, 2.99))
    return value if below(3) else min(max(short(value), 0.0011), 1000.0)


def law():
    """Parameters, and the region that they are of."""
    region = one_of(("any shape", "half a circle", "nearly half a circle", "a narrow bump", "a depth that is a number",
                     "ends of the domain"))
    radius = near(10 ** between(-0.99, 4))
    width = near(2 * radius * draws.random())
    if region == "half a circle":
        width = 2 * radius
    elif region == "nearly half a circle":
        width = beside(2 * radius, -1 - below(50))
    elif region == "a narrow bump":  # the tail of 8R² + (w/2)² is not 0
        radius = near(10 ** between(2, 4))
        width = near(2 * radius * 2.0 ** between(-22, -12))
    elif region == "a depth that is a number":
        leg, _, longest = one_of(TRIPLES)
        size = 2.0 ** (below(13) - 6)
        radius, width = near(longest * size), near(2 * leg * size)
    elif region == "ends of the domain":
        radius = one_of((near(0.1) if near(0.1) >= 0.1 else beside(0.1, 1), 10000.0))
        width = one_of((2 * radius, near(0.001001)))
    if not 0.001001 <= width <= 2 * radius:
        width = 2 * radius
    return radius, width, stiffness(), region


def borders(radius, width):
    """Half the width, half the top polygon's, the depth of the axis, and the height of three polygons."""
    half = width / 2
    third = math.asin(min(half / radius, 1)) / 3
    top = radius * math.sin(third)
    return half, top, math.sqrt(max((radius - half) * (radius + half), 0)), 2 * top * math.sin(2 * third)


def surface(name, radius, width, x):
    half, top, depth, height = borders(radius, width)
    if name in ("cylinder", "bump-cylinder"):
        return -depth + sign() * math.sqrt(max(radius * radius - x * x, 0))
    if abs(x) > half or name in ("wall", "bump-1p", "bump-1p-shaded"):
        return 0.0
    if name.startswith("bump-2p"):
        return half / (radius + depth) * (half - abs(x))
    return height if abs(x) <= top else height * (half - abs(x)) / (half - top)


def along(name, radius, width):
    half, top, _, _ = borders(radius, width)
    region = one_of(("over the bump", "over the bump", "over the bump", "its end", "the top's end", "few bits", "x = 0", "x of a quantum",
                     "beside the bump", "the radius"))
    x = {"over the bump": lambda: between(-half, half),
         "its end": lambda: beside(sign() * half, below(5) - 2),
         "the top's end": lambda: beside(sign() * top, below(7) - 3),
         "few bits": lambda: short(between(-half, half)),
         "x = 0": lambda: sign() * 0.0,
         "x of a quantum": lambda: sign() * beside(QUANTUM, below(3) - 1) if below(2) else sign() * 2.0 ** between(-149, -28),
         "beside the bump": lambda: between(-10000, 10000),
         "the radius": lambda: beside(sign() * radius, below(5) - 2)}[region]()
    return near(x), region


def up(name, radius, width, x):
    depth = borders(radius, width)[2]
    at = surface(name, radius, width, x)
    region = one_of(("the surface", "the surface", "just below", "just below", "below", "the axis", "few bits, deep",
                     "z of a quantum", "z = 0",
                     "anywhere"))
    z = {"the surface": lambda: beside(at, below(7) - 3),
         "just below": lambda: at - radius * 2.0 ** between(-47, -20),
         "below": lambda: at - 10 ** between(-8, 1),
         "the axis": lambda: beside(-depth, below(5) - 2),
         "few bits, deep": lambda: short(-between(0, min(radius, 100))),
         "z of a quantum": lambda: sign() * beside(QUANTUM, below(3) - 1) if below(2) else sign() * 2.0 ** between(-149, -28),
         "z = 0": lambda: sign() * 0.0,
         "anywhere": lambda: between(-10000, 10000)}[region]()
    return near(z), region


def hard_cases(name):
    """R, w, K, x and z of positions whose force lies next to a tie of the rounding."""
    file = pathlib.Path(__file__).resolve().parents[2] / "laws" / (name.replace("-", "_") + ".cases")
    for line in file.read_text().splitlines()[1:]:
        if line and not line.startswith("#"):
            yield [float.fromhex(word) for word in line.split(",")[:5]]


def main():
    counts = collections.Counter()
    for name in NAMES:
        for radius, width, force, x, z in hard_cases(name):
            print("law", name, *(f"{bits(each):x}" for each in (radius, width, force)))
            for place in ((x, 0.0, z), (-x, 1.0, z)):
                print(*(f"{bits(each):x}" for each in place))
            counts["next to a tie"] += 2
    for leg, depth, longest in TRIPLES:  # at z = -(R + d)/2 two forces cancel: contact, and no force
        print("law bump-cylinder", *(f"{bits(each):x}" for each in (longest, 2 * leg, 0.75)))
        for steps in (0, 1, -1):
            print(*(f"{bits(each):x}" for each in (0.0, 0.0, beside(-(longest + depth) / 2, steps))))
        counts["opposite forces"] += 3
    for index in range(int(sys.argv[1])):
        name = NAMES[index % len(NAMES)]
        radius, width, force, shape = law()
        print("law", name, *(f"{bits(each):x}" for each in (radius, width, force)))
        for number in range(16):
            x, where = along(name, radius, width)
            z, height = up(name, radius, width, x)
            y = near(one_of((0.0, 1.0, -3.5, between(-10000, 10000))))
            place = [x, y, z]
            if number == 15:  # at and beyond the end of the domain
                place[below(3)] = one_of((10000.0, -10000.0, beside(10000, 1), -beside(10000, 1), math.inf, -math.inf, math.nan, 3e38))
                where = height = "the end of the domain"
            counts.update({shape, where, height})
            print(*(f"{bits(each):x}" for each in place))
    for region, count in sorted(counts.items()):
        print(f"# {count} positions: {region}")


if __name__ == "__main__":
    main()
