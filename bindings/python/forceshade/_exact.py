# SPDX-License-Identifier: BSD-3-Clause
"""The exact force and the geometry of the bump."""

from __future__ import annotations

import operator
from fractions import Fraction
from typing import TYPE_CHECKING, NamedTuple, SupportsFloat, Union


from . import _arrays, _forceshade
from ._arrays import Rounding

if TYPE_CHECKING:
    from ._subject import Quantity, Status

Exact = Union[Fraction, str]

# Two rational numbers with denominators up to the first never agree in as many digits as the second.
_LARGEST_DENOMINATOR = 10**40
_ENOUGH_DIGITS = 120
_CLOSE = Fraction(1, 10**115)


class ExactForce(NamedTuple):
    """An exact force (N), and what its position is: a rational number, or correctly rounded decimal digits in a text."""

    x: Exact
    y: Exact
    z: Exact
    status: Status


class Geometry(NamedTuple):
    """The geometry of a bump, in correctly rounded decimal digits."""

    d: str
    """mm: how deep the axis of the cylinder lies below the plane."""
    h: str
    """mm: the height of the bump."""
    w_prime: str
    """mm: the width of the flat top of bump-3p."""
    h_prime: str
    """mm: its height."""
    theta: str
    """rad."""


def _digits(digits: int) -> int:
    try:
        count = operator.index(digits)
    except TypeError:
        raise TypeError(f"digits: expected an integer, got {digits!r}") from None
    if not 1 <= count <= 10_000:
        raise ValueError(f"digits is {count}; expected 1 to 10000")
    return count


def force_of(
    reference: _forceshade.Reference, x: SupportsFloat, y: SupportsFloat, z: SupportsFloat, digits: int, rounding: Rounding
) -> ExactForce:
    """Subject.reference()."""
    from ._subject import Status

    count = _digits(digits)
    point = _arrays.as_floats([x, y, z], "position", rounding)
    if point.shape != (3,):
        raise TypeError("expected three numbers x, y, z in mm")
    position = (float(point[0]), float(point[1]), float(point[2]))
    status, texts = reference.decimals(position, _ENOUGH_DIGITS)
    rounded = texts if count == _ENOUGH_DIGITS else None
    components: list[Exact] = []
    for axis, text in enumerate(texts):
        rational = _rational(reference, position, axis, text)
        if rational is None and rounded is None:
            rounded = reference.decimals(position, count)[1]
        components.append(rational if rational is not None else (rounded or texts)[axis])
    return ExactForce(components[0], components[1], components[2], Status(status))


def _rational(reference: _forceshade.Reference, position: tuple[float, float, float], axis: int, text: str) -> Fraction | None:
    """The rational number that the component is; found from its digits, and then compared with it exactly."""
    if text == "0":
        return Fraction(0)
    if "e" in text:
        return None
    value = Fraction(text)
    candidate = value.limit_denominator(_LARGEST_DENOMINATOR)
    if abs(candidate - value) > abs(value) * _CLOSE:
        return None
    is_equal = reference.compare(position, axis, f"{candidate.numerator}/{candidate.denominator}") == 0
    return candidate if is_equal else None


def geometry(*, radius: Quantity, width: Quantity, digits: int = 50) -> Geometry:
    """d, h, w', h' (mm) and theta (rad) of a bump, each in `digits` correctly rounded significant decimal digits (1 to 10 000).

    radius: R, mm, in [0.1, 10 000]. width: w, mm, in [0.001, 2 R].

    Raises ValueError outside.

    >>> geometry(radius=15.24, width=25.4, digits=20).h
    '6.8157729301346436345'
    """
    from ._subject import length_of

    return Geometry(*_forceshade.geometry(length_of(radius, "radius"), length_of(width, "width"), _digits(digits)))
