# SPDX-License-Identifier: BSD-3-Clause
"""The surface of a mesh: friction, stiffness and damping."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import inf
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _forceshade
from ._arrays import array_of, narrow_of
from ._subject import File, stiffness_of, text_of

Friction = Union[float, tuple[float, float]]  # a coefficient, or a static and a dynamic one
Materials = tuple[Sequence[Mapping[str, Any]], npt.ArrayLike]  # a list, and the number in it of each triangle


def words_of_friction(friction: Friction) -> str:
    parts = friction if isinstance(friction, (tuple, list)) else (friction,)
    return ",".join(text_of(part, "friction", '"0.5"') for part in parts)


def materials_of(
    friction: Friction | None, materials: File | Materials | None
) -> tuple[list[tuple[float | None, float, float, float, float]], list[int]]:
    """A list of (stiffness, static, dynamic, damping, drag), and the number in it of each triangle; none where all have the first."""
    if materials is not None and (not isinstance(materials, (tuple, list)) or len(materials) != 2):
        raise TypeError("a file of materials is for a mesh file; expected a pair (list, numbers) for arrays")
    listed: Sequence[Mapping[str, Any]] = [] if friction is None else [{"friction": friction}]
    numbers: list[int] = []
    if materials is not None:
        listed, given = materials
        array = array_of(given, "materials")
        if array.ndim != 1 or array.dtype.kind not in "iu" or (array < 0).any() or (array >= len(listed)).any():
            raise ValueError(f"materials: expected for each triangle the number of its material, 0 to {len(listed) - 1}")
        numbers = array.tolist()
    made = []
    for i, material in enumerate(listed):
        if unknown := set(material) - {"friction", "stiffness", "damping", "drag"}:
            raise ValueError(f"materials[{i}] has {sorted(unknown)}; expected friction, stiffness, damping, drag or none")
        own = material.get("stiffness")
        static, dynamic = _forceshade.friction("friction", words_of_friction(material.get("friction", 0)))
        damping, drag = (narrow_of(material.get(key, inf), f"materials[{i}]: {key}") for key in ("damping", "drag"))
        made.append((None if own is None else stiffness_of(own), static, dynamic, damping, drag))
    return made, numbers
