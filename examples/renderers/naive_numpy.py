#!/usr/bin/env python3
"""The law bump-3p-shaded with NumPy, as one writes it at first: the thesis's formulas, no domain, and binary32 throughout, since NumPy
keeps the type of the positions."""

import numpy as np

from renderer import NotRendered, render


def bump(radius, width, stiffness):
    angle = 2 / 3 * np.arcsin(width / (2 * radius))
    axis = np.sqrt(radius**2 - (width / 2) ** 2)
    top_width = 2 * (width / 2 * np.cos(angle) - axis * np.sin(angle))
    top = width / 2 * np.sin(angle) + axis * np.cos(angle) - axis

    def forces(positions, _):
        x, _, z = positions.T
        beside = np.abs(x)
        side = top * (width / 2 - beside) / (width / 2 - top_width / 2)
        height = np.where(beside <= top_width / 2, top, np.where(beside <= width / 2, side, 0))
        size = stiffness * np.maximum(height - z, 0)
        across = np.where(beside <= width / 2, x / radius, 0)
        return np.stack([size * across, 0 * size, size * np.sqrt(1 - across**2)], axis=1)

    return forces


def open_scene(scene):
    if scene["name"] != "bump-3p-shaded":
        raise NotRendered("it renders the law bump-3p-shaded alone")
    numbers = scene["parameters"]
    return bump(numbers["radius_mm"], numbers["width_mm"], numbers["stiffness_N_per_mm"])


np.seterr(all="ignore")
render({"name": "a bump in naive NumPy", "memory": "none", "claims": "definition"}, open_scene)
