#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Your own device (docs/command-device.md), which needs Python alone: a simulated hand that strokes the surface.

  forceshade drive --device "command:python3 examples/devices/stroking_hand.py" --law wall --certificate none --seconds 5

To drive hardware, put its commands in the place of the class Hand: it is given a force in N and gives a position in mm.
"""

import gc
import json
import math
import sys
import time

MASS = 0.1  # kg
PULL, DAMPING = 0.5, 0.014  # N/mm and N·s/mm: of the hand, towards where it means to be


class Hand:
    def __init__(self):
        self.position, self.velocity = [0.0, 0.0, 6.0], [0.0, 0.0, 0.0]  # mm, mm/s
        self.begin = self.last = time.monotonic()

    def move(self, force):
        """Moves under this force until now. The time in s, and the position in mm."""
        now = time.monotonic()
        step, self.last = min(now - self.last, 0.005), now
        seconds = now - self.begin
        meant = (10 * math.sin(math.pi * seconds), 0, 2 + 4 * math.cos(2 * math.pi * seconds / 3))  # mm: it lifts off every 3 s
        for axis in range(3):
            pull = PULL * (meant[axis] - self.position[axis]) - DAMPING * self.velocity[axis]
            self.velocity[axis] += 1000 * (pull + force[axis]) / MASS * step
            self.position[axis] += self.velocity[axis] * step
        return seconds, self.position

    def let_go(self):
        """Hardware sets the force of its motors to zero here."""


def write(**line):
    print(json.dumps(line), flush=True)


def main():
    gc.disable()  # its pauses would make an answer late
    write(**{"forceshade-device": 1}, name="simulated hand", workspace_mm=[[-100, -100, -100], [100, 100, 100]], peak_force_N=5,
          continuous_force_N=2, resolution_mm=0.05, buttons=0, paces=False)
    hand = Hand()
    try:
        for line in sys.stdin:  # it ends, too, where forceshade was killed
            order = json.loads(line)
            if "end" in order:
                break
            seconds, position = hand.move(order["force_N"])
            write(time_s=seconds, position_mm=position, buttons=0)
    finally:
        hand.let_go()


main()
