# SPDX-License-Identifier: BSD-3-Clause
"""A third-party renderer, held against the exact definition."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, Protocol

import numpy as np
import numpy.typing as npt

from . import _forceshade
from ._arrays import array_of
from ._checks import _count, _expect_subject
from ._subject import Subject, word_of

Floats = npt.NDArray[np.float32]
Counts = npt.NDArray[np.uint32]


class OpenedRenderer(Protocol):
    """A renderer on one scene."""

    def answers(self, positions: Floats, reset: bool, /) -> Floats:
        """The answers to the next positions of the path, (n, 3), in its own units; reset: a new path begins with them."""


class OpenedDampedRenderer(Protocol):
    """A renderer with damping on one scene."""

    def answers(self, positions: Floats, reset: bool, periods: Counts, /) -> Floats:
        """The same; periods: those since the position before each, (n,)."""


class RendererOfScenes(Protocol):
    """A renderer that can be opened on any scene, also a turned or renumbered one, and remembers its path where it declares so."""

    def open(self, scene: Mapping[str, Any], /) -> OpenedRenderer | OpenedDampedRenderer:
        """scene: a dictionary like the JSON in docs/conformance-protocol.md. What is opened is asked with periods where `declares`
        has damping. Raises NotImplementedError, with the reason, for a scene that it does not render."""


@dataclass(frozen=True, repr=False)
class Conformance:
    """The result of conform(). It is true where all that is applicable held. As a text, it says all that did and did not hold. A
    test is `conform(...).check()`."""

    held: bool
    applicable: bool
    """True if the renderer renders this scene. If not, nothing held."""
    words: str
    contents: dict[str, Any] = field(compare=False)
    """As `forceshade conform --json` writes it: docs/conformance.md."""

    def __bool__(self) -> bool:
        return self.held

    def __str__(self) -> str:
        return self.words

    def __repr__(self) -> str:
        """In one short line, with the first that did not hold."""
        failed = [line for line in self.words.splitlines() if line.startswith("FAILED")]
        if not failed:
            return f"<Conformance: {'held' if self.held else 'not applicable'}>"
        return f"<Conformance: {failed[0]}{f', and {len(failed) - 1} more' if failed[1:] else ''}; check() says where>"

    def check(self) -> Conformance:
        """This, where all that is applicable held. Else raises AssertionError with all words: the first wrong positions, and the
        lines to paste into a test."""
        if not self.held:
            raise AssertionError(self.words)
        return self


class _Function:
    """A function of positions, which has no memory, as a renderer of one scene."""

    def __init__(self, function: Callable[..., Any], scene: str, vectorised: bool) -> None:
        self._function, self._scene, self._vectorised = function, scene, vectorised

    def open(self, scene: Mapping[str, Any], /) -> _Function:
        if json.dumps(scene) != self._scene:
            raise NotImplementedError("a function renders one scene; an object with a method open(scene) renders others, too")
        return self

    def answers(self, positions: Floats, reset: bool, /) -> Any:
        if self._vectorised:
            return self._function(positions)
        return np.array([self._function(*position) for position in positions.tolist()], dtype=np.float32)


def _checked(answers: object, count: int) -> Floats:
    array = array_of(answers, "answers")
    if array.dtype != np.float32:
        raise TypeError(f"expected answers as float32, got {array.dtype}; .astype(numpy.float32) rounds them to the nearest")
    if array.shape != (count, 3):
        raise ValueError(f"expected answers of the shape ({count}, 3), got {array.shape}")
    return array


def conform(
    renderer: RendererOfScenes | Callable[..., Any],
    subject: Subject,
    *,
    declares: Mapping[str, Any],
    name: str = "a renderer in Python",
    version: str = "",
    vectorised: bool = True,
    points: int = 20000,
    seed: int = 1,
    tolerance: str = "0 ulp",
) -> Conformance:
    """Holds a renderer against the exact definition of the subject, and against invariants, which need no definition.

    renderer: a function of positions, (n, 3) float32, which returns as many answers, (n, 3) float32, in its own units; with
    vectorised=False, a function of x, y and z that returns three numbers, which are rounded to float32. Its answer depends on the
    position alone. Or an object with a method open(scene), a RendererOfScenes. declares: what the hello of
    docs/conformance-protocol.md has, but for forceshade, kind, name and version: memory, answers, claims, length_unit, force_unit,
    frame, domain_mm, rate_Hz, loop_energy_mJ, for a mesh sides, shading, proxy_radius_mm, and for an object with damping damping.
    What is missing is not guessed: the result says so. tolerance: "4 ulp", "1e-6 N" or "0.1 %".

    What the renderer raises is part of the result, which then did not hold. Ctrl-C ends it. Raises ValueError for a number out of
    its range or another tolerance, and TypeError.

    >>> import forceshade, numpy
    >>> def wall(positions):
    ...     forces = numpy.zeros_like(positions)
    ...     touches = (abs(positions) <= 10000).all(axis=1) & (positions[:, 2] <= -(2.0**-30))
    ...     forces[touches, 2] = -0.5 * positions[touches, 2]
    ...     return forces
    >>> declares = {"memory": "none", "answers": "force", "claims": "definition", "length_unit": "mm", "force_unit": "N",
    ...             "frame": ["x", "y", "z"], "domain_mm": 10000, "rate_Hz": None, "loop_energy_mJ": 0}
    >>> bool(conform(wall, forceshade.Law("wall", stiffness=0.5), declares=declares, points=1000))
    True
    """
    checked = _expect_subject(subject)
    first: list[str] = []

    def opened(scene_text: str) -> tuple[str, Callable[[bytearray, bool, bytearray], Floats]]:
        scene = json.loads(scene_text)
        first.append(json.dumps(scene))
        hello = {"kind": "renderer", "name": name, "version": version, **declares}
        its = renderer if hasattr(renderer, "open") else _Function(renderer, first[0], vectorised)

        def answers(asked: bytearray, reset: bool, since: bytearray) -> Floats:
            positions = np.frombuffer(asked, np.float32).reshape(-1, 3)
            periods = np.frombuffer(since, np.uint32) if since else np.ones(len(positions), np.uint32)
            return _checked(it.answers(positions, reset, *([periods] if "damping" in declares else [])), len(positions))

        try:
            it = its.open(scene)
        except NotImplementedError as reason:
            return json.dumps({**hello, "accepts": False, "reason": str(reason) or "it does not render this scene"}), answers
        return json.dumps(hello), answers

    if not hasattr(renderer, "open") and not callable(renderer):
        raise TypeError(f"expected a function or an object with a method open, got {type(renderer).__name__}")
    if "damping" in declares and not hasattr(renderer, "open"):
        raise TypeError("expected an object with a method open for a renderer that declares damping, got a function")
    held, applicable, words, text = _forceshade.conform(
        checked, opened, _count(points, "points", 1, 10**9), _count(seed, "seed", 0, 2**64 - 1), word_of(tolerance, "tolerance")
    )
    return Conformance(held, applicable, words, json.loads(text))
