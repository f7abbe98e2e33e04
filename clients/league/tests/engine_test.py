#!/usr/bin/env python3
"""engine_test.py MESH FORCE COMMAND...: an adapter of a physics engine on short scenes. A frictionless sphere of 1 kg is pushed down by
10 N on a box, where every engine's motion is right and it reports FORCE times what presses, and slides over a flat mesh; MESH says
whether it still has 1 m/s there: right or wrong."""

import json
import math
import subprocess
import sys

RATE_HZ, PUSH_N, GRAVITY = 240, 10, 9.81
DECLARED = {"name", "version", "reports", "constraint", "binary", "sides", "smallest_radius_m", "speed_cap_m_per_s", "settings"}


def mesh(cells=16):
    at = [2 * k / cells - 1 for k in range(cells + 1)]
    row = cells + 1
    corners = [(j * row + i, j * row + i + 1, (j + 1) * row + i + 1, (j + 1) * row + i) for j in range(cells) for i in range(cells)]
    return {"vertices": [[x, y, 0] for y in at for x in at], "triangles": [t for a, b, c, d in corners for t in ([a, b, c], [a, c, d])],
            "sides": "one"}


class Adapter:
    def __init__(self, command, ground, velocity):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        sphere = {"radius": 0.1, "mass_kg": 1, "position": [-0.5, -0.37, 0.1], "velocity": velocity, "turns": False}
        self.hello = self.ask({"forceshade": "conform 1", "scene": {
            "kind": "simulation", "name": "a flat floor", "units_per_metre": 1, "rate_Hz": RATE_HZ, "gravity": [0, 0, -GRAVITY],
            "friction": 0, "ground": ground, "sphere": sphere}})

    def ask(self, words):
        self.process.stdin.write(json.dumps(words) + "\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline() or '{"no": "answer"}')

    def run(self, steps, **reset):
        return self.ask({"applied": [[0, 0, -PUSH_N]] * steps, **reset})["motion"]

    def end(self):
        self.process.communicate('{"goodbye":true}\n', timeout=60)
        assert self.process.returncode == 0, self.process.returncode


def main(expected, share, command):
    box = Adapter(command, {"box": {"half": [2, 2, 0.5], "centre": [0, 0, -0.5]}}, [0, 0, 0])
    hello = box.hello
    assert hello["forceshade"] == "conform 1" and hello["kind"] == "simulator", hello
    assert DECLARED <= hello.keys(), f"not declared: {DECLARED - hello.keys()}"
    motion = box.run(2 * RATE_HZ)
    assert motion == box.run(2 * RATE_HZ, reset=True), "a reset does not equal a fresh start"
    box.end()
    assert math.dist(motion[-1]["position"], [-0.5, -0.37, 0.1]) < 0.002, motion[-1]
    pressed = sum(n[2] * q for *n, q in motion[-1]["contacts"]) if hello["reports"] != "nothing" else PUSH_N + GRAVITY
    if hello["reports"] == "impulse":
        pressed *= RATE_HZ
    sliding = Adapter(command, mesh(), [0.8, 0.6, 0])
    moved = sliding.run(RATE_HZ)[-1]
    sliding.end()
    speed = math.hypot(*moved["velocity"][:2])
    told = f"{pressed / (PUSH_N + GRAVITY):.3f}"
    print(f"{hello['name']} {hello['version']}: {told} of the force on a box, {speed:.3f} m/s over a flat mesh")
    assert told == share, f"expected: {share}"
    assert ("right" if abs(speed - 1) < 0.01 else "wrong") == expected, f"expected: {expected}"


main(*sys.argv[1:3], sys.argv[3:])
