# SPDX-License-Identifier: BSD-3-Clause
"""The arm of an Inverse3 in a simulated hand, in m, N and s: a mass that the hand draws along its stroke."""

import math

MIDDLE = (0.0, -0.15, 0.20)  # of the workspace, in the service's frame
MASS = 0.3  # kg: a hand's 0.21 and the arm
SPRING, DAMPING = 300.0, 8.0  # N/m, N·s/m: towards where the hand means to be
HEIGHT, DEPTH = 0.010, 0.003  # m above and below the middle
STROKE = 0.020  # m, to each side
PERIOD, FALL, RISE, MOVE = 1.6, 0.4, 1.2, 0.2  # s: of a stroke, when the hand goes down and up, and for how long it moves
LONGEST_STEP = 0.0005  # s


def minimum_jerk(u):
    u = min(max(u, 0.0), 1.0)
    return u * u * u * (10 + u * (6 * u - 15))


class Arm:
    def __init__(self):
        self.time = 0.0
        self.position = list(self.meant(0.0))
        self.velocity = [0.0, 0.0, 0.0]
        self.force = (0.0, 0.0, 0.0)  # that acts

    def meant(self, time):
        t = time % PERIOD
        down = minimum_jerk((t - FALL) / MOVE) - minimum_jerk((t - RISE) / MOVE)
        return (
            MIDDLE[0] + STROKE * math.sin(2 * math.pi * 0.5 * time),
            MIDDLE[1],
            MIDDLE[2] + HEIGHT - (HEIGHT + DEPTH) * down,
        )

    def advance(self, seconds):
        steps = max(1, math.ceil(seconds / LONGEST_STEP))
        h = seconds / steps
        for _ in range(steps):
            self.time += h
            goal = self.meant(self.time)
            for i in range(3):
                pull = SPRING * (goal[i] - self.position[i]) - DAMPING * self.velocity[i] + self.force[i]
                self.velocity[i] += h * pull / MASS
                self.position[i] += h * self.velocity[i]
