#!/usr/bin/env python3
"""A god-object on a mesh as programs for haptics have it: binary64, and epsilons where a comparison could go either way."""

import numpy as np

from renderer import NotRendered, render

EPSILON_MM = 1e-6


def nearest(position, normals, offsets):
    """To the position, of the points in front of all planes."""
    while len(normals):
        pushes = np.linalg.lstsq(normals @ normals.T, offsets - normals @ position, rcond=1e-9)[0]
        if (pushes >= 0).all():
            return position + normals.T @ pushes
        pulling = np.argmin(pushes)
        normals, offsets = np.delete(normals, pulling, axis=0), np.delete(offsets, pulling)
    return position


class GodObject:
    def __init__(self, vertices, triangles, both_sides):
        self.corners = vertices[triangles]
        self.sides = first, second = [self.corners[:, k] - self.corners[:, 0] for k in (1, 2)]
        normals = np.cross(first, second)
        self.normals = normals / np.linalg.norm(normals, axis=1, keepdims=True)
        self.both_sides = both_sides
        self.place = None

    def first_hit(self, way):
        """Möller and Trumbore: which triangle the way from the god-object meets first, and where on the way, or None."""
        first, second = self.sides
        across = np.cross(way, second)
        determinant = (first * across).sum(axis=1)
        from_corner = self.place - self.corners[:, 0]
        with np.errstate(all="ignore"):  # of triangles that the way does not cross
            u = (from_corner * across).sum(axis=1) / determinant
            turned = np.cross(from_corner, first)
            v = (turned @ way) / determinant
            along = (turned * second).sum(axis=1) / determinant
            towards = self.normals @ way
            hit = (u >= -1e-9) & (v >= -1e-9) & (u + v <= 1 + 1e-9) & (along >= 0) & (along <= 1)
            hit &= (np.abs(towards) > 1e-12) if self.both_sides else (towards < -1e-12)
        triangle = np.argmin(np.where(hit, along, np.inf))
        return (triangle, along[triangle], -np.sign(towards[triangle]) * self.normals[triangle]) if hit.any() else None

    def follow(self, position, begins):
        """The place of the god-object once the hand is at the position, and the triangles that hold it."""
        if begins or self.place is None:
            self.place = position
        for _ in range(16):  # a plane holds beyond its triangle, until the next time
            before = self.place
            held_by = self.go_towards(position)
            if not held_by or np.linalg.norm(self.place - before) <= 4 * EPSILON_MM:
                break
        return self.place, held_by

    def go_towards(self, position):
        held_by, normals, offsets = [], np.empty((0, 3)), np.empty(0)
        for _ in range(8):
            way = nearest(position, normals, offsets) - self.place
            hit = self.first_hit(way)
            if hit is None:
                self.place = self.place + way
                break
            triangle, along, normal = hit
            self.place = self.place + along * way + EPSILON_MM * normal
            held_by.append(triangle)
            normals = np.vstack([normals, normal])
            offsets = np.append(offsets, normal @ self.corners[triangle, 0] + EPSILON_MM)
        return held_by


def god_object(scene):
    if scene["kind"] != "mesh":
        raise NotRendered("it renders meshes alone")
    vertices = np.array([[float.fromhex(one) for one in vertex] for vertex in scene["mesh"]["vertices_mm"]])
    return GodObject(vertices, np.array(scene["mesh"]["triangles"]), scene["parameters"]["sides"] == "both")


def open_scene(scene):
    held = god_object(scene)
    stiffness = scene["parameters"]["stiffness_N_per_mm"]

    def forces(positions, reset):
        answers = np.zeros((len(positions), 3))
        for tick, position in enumerate(positions.astype(float)):
            if (np.abs(position) <= 1e4).all():  # in the domain, and a number
                answers[tick] = stiffness * (held.follow(position, reset and tick == 0)[0] - position)
        return answers

    return forces


if __name__ == "__main__":
    render({"name": "a god-object with epsilons", "memory": "path", "claims": "invariants", "sides": ["front", "both"],
            "shading": ["none"], "meshes": "any", "proxy_radius_mm": 0, "loop_energy_mJ": 0}, open_scene)
