#!/usr/bin/env python3
"""check.py FILE.json: a renderer against test vectors. This one is a wall at z = 0 in binary64, rounded at the end."""

import json
import struct
import sys


def number(bits):
    """The binary32 number with these eight hexadecimal digits."""
    return struct.unpack(">f", bytes.fromhex(bits))[0]


def my_force(x, y, z, stiffness):
    if not all(abs(coordinate) <= 10_000 for coordinate in (x, y, z)):
        return (0, 0, 0)  # outside the domain, or not a number
    return (0, 0, stiffness * -z if z <= -(2.0**-30) else 0)


def main():
    vectors = json.load(open(sys.argv[1]))
    stiffness = vectors["subject"]["parameters"]["stiffness_N_per_mm"]
    wrong = 0
    for path in vectors["paths"]:  # a renderer with memory begins again here
        for case in path:
            mine = my_force(*map(number, case["position_bits"]), stiffness)
            if struct.pack(">3f", *mine).hex() != "".join(case["force_bits"]):
                wrong += 1
                print(f"case {case['id']}, {case['flag']}: {vectors['flags'][case['flag']]['meaning']}")
                print(f"  at {case['position_mm']} mm: {mine} N; expected {case['exact_force_N']}")
    print(f"{wrong} wrong of {sum(map(len, vectors['paths']))}")
    return wrong > 0


if __name__ == "__main__":
    sys.exit(main())
