#!/usr/bin/env python3
"""Turns what `forceshade recording export` or `drive --out NAME.csv` wrote into the recording of another system.

as_another_system.py EXPORTED.csv FROM TO > another_system.csv: the samples between two times of the device (s); in m and mN, in axes of
its own, turned and shifted against those of the scene, with nine significant digits.
"""

import csv
import math
import sys

SHIFT_MM = (40.0, -25.0, 110.0)
ANGLE = math.radians(35)


def turned(v):
    """About (1, 2, 2)/3, by Rodrigues' formula."""
    axis = (1 / 3, 2 / 3, 2 / 3)
    along = sum(a * b for a, b in zip(axis, v))
    across = (axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2], axis[0] * v[1] - axis[1] * v[0])
    cosine, sine = math.cos(ANGLE), math.sin(ANGLE)
    return [cosine * v[i] + sine * across[i] + (1 - cosine) * along * axis[i] for i in range(3)]


def main():
    first, last = float(sys.argv[2]), float(sys.argv[3])
    print("time_s,px,py,pz,fx,fy,fz")
    with open(sys.argv[1], newline="") as file:
        for row in csv.DictReader(file):
            time = float(row["device_t_s"])
            if row["status"] == "end" or not first <= time <= last:
                continue
            position = turned([float(row[name]) for name in ("x_mm", "y_mm", "z_mm")])
            force = turned([float(row[name]) for name in ("fx_N", "fy_N", "fz_N")])
            numbers = [time] + [(p + s) / 1000 for p, s in zip(position, SHIFT_MM)] + [1000 * f for f in force]
            print(",".join(f"{number:.9g}" for number in numbers))


main()
