#!/usr/bin/env python3
"""A sphere on a ground for `forceshade conform simulator` (docs/conformance-protocol.md), simulated without a penalty and without
an error: where a step would end in the ground, it ends at the nearest place that touches it. Tests make it wrong, a line at a time."""

import json
import math
import sys


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def add(a, b, times=1.0):
    return [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


class Plane:
    """A ground that is flat: all of its triangles, or the top of a box."""

    def __init__(self, normal, height):
        self.normal, self.height = normal, height

    def push(self, centre, radius):
        """The direction and length of the way out of the ground; none where the sphere is not in it."""
        depth = self.height + radius - dot(self.normal, centre)
        return (self.normal, depth) if depth > 0 else None


class Triangles:
    def __init__(self, corners):
        self.corners = [(three, [(min(axis), max(axis)) for axis in zip(*three)]) for three in corners]

    @staticmethod
    def nearest(p, a, b, c):
        ab, ac, ap = add(b, a, -1), add(c, a, -1), add(p, a, -1)
        d1, d2 = dot(ab, ap), dot(ac, ap)
        if d1 <= 0 and d2 <= 0:
            return a
        bp = add(p, b, -1)
        d3, d4 = dot(ab, bp), dot(ac, bp)
        if d3 >= 0 and d4 <= d3:
            return b
        cp = add(p, c, -1)
        d5, d6 = dot(ab, cp), dot(ac, cp)
        if d6 >= 0 and d5 <= d6:
            return c
        vc, vb, va = d1 * d4 - d3 * d2, d5 * d2 - d1 * d6, d3 * d6 - d5 * d4
        if vc <= 0 <= d1 and d3 <= 0:
            return add(a, ab, d1 / (d1 - d3))
        if vb <= 0 <= d2 and d6 <= 0:
            return add(a, ac, d2 / (d2 - d6))
        if va <= 0 and d4 >= d3 and d5 >= d6:
            return add(b, add(c, b, -1), (d4 - d3) / ((d4 - d3) + (d5 - d6)))
        return add(add(a, ab, vb / (va + vb + vc)), ac, vc / (va + vb + vc))

    def push(self, centre, radius):
        x, y, z = centre
        ways = [add(centre, self.nearest(centre, *three), -1) for three, (xs, ys, zs) in self.corners
                if xs[0] - radius < x < xs[1] + radius and ys[0] - radius < y < ys[1] + radius
                and zs[0] - radius < z < zs[1] + radius]
        if not ways:
            return None
        squared, way = min((dot(way, way), way) for way in ways)
        distance = math.sqrt(squared)
        return ([x / distance for x in way], radius - distance) if distance < radius else None


def ground_of(scene):
    ground, units = scene["ground"], scene["units_per_metre"]
    if "box" in ground:
        return Plane([0, 0, 1], ground["box"]["centre"][2] + ground["box"]["half"][2])
    if any(x is None for vertex in ground["vertices"] for x in vertex):
        raise ValueError("a vertex is no number")
    corners, planes = [], set()
    for triangle in ground["triangles"]:
        a, b, c = (ground["vertices"][i] for i in triangle)
        normal = cross(add(b, a, -1), add(c, a, -1))
        length = math.sqrt(dot(normal, normal))
        if length == 0:
            continue
        normal = [x / length for x in normal]
        corners.append((a, b, c))
        planes.add((*(round(x, 9) for x in normal), round(dot(normal, a) / units, 9)))
    if len(planes) == 1:
        x, y, z, height = planes.pop()
        length = math.sqrt(dot((x, y, z), (x, y, z)))
        return Plane([x / length, y / length, z / length], height * units)
    return Triangles(corners)


class World:
    def __init__(self, scene):
        self.scene, self.ground = scene, ground_of(scene)
        self.reset()

    def reset(self):
        sphere = self.scene["sphere"]
        self.position, self.velocity = list(sphere["position"]), list(sphere["velocity"])

    def step(self, applied):
        sphere, dt = self.scene["sphere"], 1 / self.scene["rate_Hz"]
        mass, units = sphere["mass_kg"], self.scene["units_per_metre"]
        free = add(add(self.velocity, self.scene["gravity"], dt), applied, dt / mass)
        position = add(self.position, free, dt)
        pushed = [0.0, 0.0, 0.0]
        for _ in range(20):
            out = self.ground.push(add(position, pushed), sphere["radius"])
            if out is None or out[1] < 1e-13 * units:
                break
            pushed = add(pushed, *out)
        length = math.sqrt(dot(pushed, pushed))
        contacts = []
        if length > 0:
            contacts.append([x / length for x in pushed] + [mass * length / (dt * dt)])
        self.position = add(position, pushed)
        self.velocity = add(free, pushed, 1 / dt)
        return {"position": self.position, "velocity": self.velocity, "contacts": contacts}


def main():
    about = {"forceshade": "conform 1", "kind": "simulator", "name": "an exact simulator", "version": "1", "reports": "force",
             "constraint": "hard", "binary": 64, "sides": "two", "smallest_radius_m": 0, "speed_cap_m_per_s": None,
             "settings": "it has none"}
    world = None
    for line in sys.stdin:
        asked = json.loads(line)
        if "scene" in asked:
            answer = dict(about)
            try:
                world = World(asked["scene"])
            except ValueError as reason:
                answer |= {"accepts": False, "reason": str(reason)}
        elif "applied" in asked:
            if asked.get("reset"):
                world.reset()
            if any(x is None for force in asked["applied"] for x in force):
                answer = {"accepts": False, "reason": "a force is no number"}
            else:
                answer = {"motion": [world.step(force) for force in asked["applied"]]}
        else:
            return  # goodbye
        print(json.dumps(answer), flush=True)


main()
