#!/usr/bin/env python3
"""The edge scheme of the thesis (3.3) as printed (reference/laws/errata.md), on a mesh: N = [x1(N02 + N03) + x2(N01 + N03) + x3(N01 +
N02)]/2(x1 + x2 + x3), which is no unit vector; xi is the distance from side i and N0i the mean of the normals beside it. With the
argument --normalised it is one."""

import sys

import numpy as np

from god_object_epsilon import god_object
from renderer import render


def open_scene(scene):
    held, triangles = god_object(scene), np.array(scene["mesh"]["triangles"])
    K = scene["parameters"]["stiffness_N_per_mm"]

    def beyond(t, k):
        """The triangle on the other side of the side that is opposite to corner k, or t itself at the rim."""
        side = {triangles[t][(k + 1) % 3], triangles[t][(k + 2) % 3]}
        return next((n for n in range(len(triangles)) if n != t and side <= set(triangles[n])), t)

    def force(position, begins):
        if not (np.abs(position) <= 1e4).all():
            return np.zeros(3)
        place, triangles_met = held.follow(position, begins)
        away = place - position
        if len(set(triangles_met)) != 1:
            return K * away
        t = triangles_met[0]
        sides = [np.roll(held.corners[t], -k, axis=0)[1:] for k in range(3)]
        x = [np.linalg.norm(np.cross(b - a, place - a)) / np.linalg.norm(b - a) for a, b in sides]
        N = [(held.normals[t] + held.normals[beyond(t, k)]) / 2 for k in range(3)]
        mean = (x[0] * (N[1] + N[2]) + x[1] * (N[0] + N[2]) + x[2] * (N[0] + N[1])) / (2 * sum(x))
        return K * np.linalg.norm(away) * (mean / np.linalg.norm(mean) if "--normalised" in sys.argv else mean)

    return lambda positions, reset: [force(at, reset and tick == 0) for tick, at in enumerate(positions.astype(float))]


render({"name": "the edge scheme as printed", "memory": "path", "claims": "definition", "sides": ["front", "both"], "shading": ["edge"],
        "proxy_radius_mm": 0}, open_scene)
