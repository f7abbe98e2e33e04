#!/usr/bin/env python3
"""Formulas of the thesis with their errata left in (reference/laws/errata.md), in binary64 and otherwise right: thesis_as_printed.py
SECTION renders the law that the formula of this section would give."""

import sys

import numpy as np

from renderer import NotRendered, render


def unit(slope):
    return np.stack([-slope, 0 * slope, 1 + 0 * slope]) / np.sqrt(1 + slope**2)


def wall(x, z, R, w, K):
    """2.2.1: F = k((x - x0)·n) n for (x - x0)·n >= 0."""
    return np.where(z >= 0, K * z, 0) * unit(0 * x)


def cylinder(x, z, R, w, K):
    """2.2.2: F = k(‖l‖ - R) l for ‖l‖ - R >= 0, l a unit vector from the axis."""
    up = z + np.sqrt(R**2 - w**2 / 4)
    length = np.hypot(x, up)
    return np.where(length >= R, K * (length - R), 0) * np.stack([x, 0 * x, up]) / length


def two_polygons(x, R, w):
    height = R - np.sqrt(R**2 - w**2 / 4)
    inside = 2 * np.abs(x) <= w
    slope = np.where(inside, np.where(x < 0, 2, -2) * height / w, 0)
    return np.where(inside, height * (1 - 2 * np.abs(x) / w), 0), slope


def indentation(x, z, R, w, K):
    """2.5: the indentation is z - U, a spring on it pushes along N."""
    height, slope = two_polygons(x, R, w)
    return np.where(z < height, K * (z - height), 0) * unit(slope)


def height_map(x, z, R, w, K):
    """2.5.1: F = K(U - z)N if |U - z| >= 0."""
    height, slope = two_polygons(x, R, w)
    return np.where(np.abs(height - z) >= 0, K * (height - z), 0) * unit(slope)


def cap_slope(x, inside, R):
    return np.where(inside, -x / np.sqrt(np.where(inside, R**2 - x**2, 1)), 0)


def force_shading(x, z, R, w, K):
    """3.2: F = K(-z)N if |z| <= 0."""
    return np.where(np.abs(z) <= 0, -K * z, 0) * unit(cap_slope(x, 2 * np.abs(x) <= w, R))


def kinks(x, z, R, w, K):
    """2.5, 3.2: U is only piecewise differentiable. This reading takes the plane's gradient on the rim of the bump."""
    return np.where(z < 0, -K * z, 0) * unit(cap_slope(x, 2 * np.abs(x) < w, R))


def sign_of_zero(x, z, R, w, K):
    """4.4.2: D = (sgn(x) 2h/w, 1)/√(1 + 4h²/w²), with sgn(0) = 0."""
    height, slope = two_polygons(x, R, w)
    across, along, up = unit(slope)
    return np.where(z < height, K * (height - z), 0) * np.stack([np.abs(np.sign(x)) * across, along, up])


SECTIONS = {
    "2.2.1": ("wall", wall),
    "2.2.2": ("cylinder", cylinder),
    "2.5": ("bump-2p", indentation),
    "2.5.1": ("bump-2p", height_map),
    "3.2": ("bump-1p-shaded", force_shading),
    "kinks": ("bump-1p-shaded", kinks),
    "4.4.2": ("bump-2p", sign_of_zero),
}


def open_scene(scene):
    law, formula = SECTIONS[section]
    if scene["name"] != law:
        raise NotRendered(f"section {section} is about the law {law} here")
    numbers = scene["parameters"]
    R, w, K = (numbers.get(name, 0) for name in ("radius_mm", "width_mm", "stiffness_N_per_mm"))

    def forces(positions, _):
        read = np.where(np.abs(positions) < 2**-30, 0, positions).astype(float)
        valid = (np.abs(positions) <= 1e4).all(axis=1)
        return np.where(valid, formula(read[:, 0], read[:, 2], R, w, K), 0).T

    return forces


if len(sys.argv) != 2 or sys.argv[1] not in SECTIONS:
    sys.exit(f"usage: {sys.argv[0]} {'|'.join(SECTIONS)}")
section = sys.argv[1]
np.seterr(all="ignore")
render({"name": f"section {section} as printed", "memory": "none", "claims": "definition"}, open_scene)
