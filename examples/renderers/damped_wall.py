#!/usr/bin/env python3
"""A damped wall at z = 0 for `forceshade conform` (docs/damping.md), in fractions: each force is the definition's own."""

import json
import struct
import sys
from fractions import Fraction

from wall import force, hello

DAMPING = {"damping": 0.002, "share": 0.25}  # N·s/mm along the force, and the filter's share
RATE = 1000
B, SHARE = (Fraction(struct.unpack("f", struct.pack("f", DAMPING[key]))[0]) for key in ("damping", "share"))


def nearest(exact):
    """The nearest binary32 number, ties to even; none here is too large for one."""
    if exact == 0:
        return Fraction(0)
    power = abs(exact).numerator.bit_length() - abs(exact).denominator.bit_length()
    power -= abs(exact) < Fraction(2) ** power
    unit = Fraction(2) ** max(power - 23, -149)
    return round(exact / unit) * unit  # a half goes to the even number


class Damper:
    """The velocity along z alone, since this wall pushes along no other axis."""

    def __init__(self):
        self.last, self.speed, self.since = None, Fraction(0), 0

    def damped(self, position, periods, spring):
        if self.last is not None:
            self.since = min(self.since + periods, 17)
        if not all(abs(coordinate) <= 10_000 for coordinate in position):
            return 0
        if periods:
            at = Fraction(position[2]) if abs(position[2]) >= 2.0**-30 else Fraction(0)
            if self.last is None or self.since > 16:
                self.speed = Fraction(0)
            else:
                new = RATE * (at - self.last) / self.since
                for _ in range(self.since):
                    self.speed = nearest(self.speed + SHARE * (new - self.speed))
                    if abs(self.speed) < Fraction(2) ** -20:
                        self.speed = Fraction(0)
            self.last, self.since = at, 0
        spring = Fraction(struct.unpack("f", struct.pack("f", spring))[0])
        return float(nearest(min(2 * spring, max(Fraction(0), spring - B * self.speed))))


def main():
    stiffness, damper = 0, Damper()
    for line in sys.stdin:
        asked = json.loads(line)
        if "scene" in asked:
            answer = hello(asked["scene"]) | {"name": "a damped wall in Python", "memory": "path", "rate_Hz": RATE, "damping": DAMPING}
            stiffness = asked["scene"]["parameters"].get("stiffness_N_per_mm", 0)
        elif "positions" in asked:
            if asked.get("reset"):
                damper = Damper()
            positions = [struct.unpack(">3f", bytes.fromhex(at)) for at in asked["positions"]]
            forces = (damper.damped(at, periods, force(*at, stiffness)[2])
                      for at, periods in zip(positions, asked.get("periods", [1] * len(positions))))
            answer = {"answers": [struct.pack(">3f", 0, 0, one).hex() for one in forces]}
        else:
            return  # goodbye
        print(json.dumps(answer), flush=True)


main()
