# SPDX-License-Identifier: BSD-3-Clause
"""Arrays as the compiled module takes them: binary32, where they lie."""

from __future__ import annotations

import numbers
import operator
import os
import sys
import warnings
from decimal import ROUND_05UP, Context, Decimal
from fractions import Fraction
from math import inf, isfinite, isinf
from typing import Any, Literal, Optional

import numpy as np
import numpy.typing as npt

from . import _forceshade

Floats = npt.NDArray[np.float32]
Bytes = npt.NDArray[np.uint8]
Rounding = Optional[Literal["nearest"]]


def expect_rounding(rounding: Rounding) -> bool:
    """True if numbers may be rounded."""
    if rounding is None:
        return False
    if not isinstance(rounding, str):
        raise TypeError(f'rounding: expected "nearest" or None, got {rounding!r}')
    if rounding != "nearest":
        raise ValueError(f'rounding: expected "nearest" or None, got {rounding!r}')
    return True


_DIGITS = Context(prec=800, rounding=ROUND_05UP)  # so that a number which is rounded again was rounded once


def nearest_of(value: Any) -> float:
    """The binary32 number nearest to a real one. Raises OverflowError beyond binary64."""
    return _forceshade.nearest(float(value) if isinstance(value, numbers.Integral) else value)


def real_of(value: object, name: str) -> Any:
    """The value, which has to be a real number."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name}: expected a number, got {value!r}")
    return value


def narrow_of(value: object, name: str) -> float:
    """The binary32 number nearest to one that has to be in its range, or infinite."""
    real = real_of(value, name)
    try:
        narrow = nearest_of(real)
    except OverflowError:
        narrow = inf
    if isinf(narrow) and abs(real) != inf:
        raise ValueError(f"{name} is {value}; expected a number that binary32 holds")
    return narrow


def decimal_of(value: Any) -> str:
    """A real number as it would be typed: in the fewest digits, unless these lie on another side of a tie of binary32, as they may of
    binary64, which does not hold every Fraction or long double either. Raises OverflowError beyond binary64."""
    wide = float(value)
    if isinf(wide) and value != wide:
        raise OverflowError
    short = repr(wide)
    if not isfinite(wide) or nearest_of(Fraction(short)) == nearest_of(value):
        return short
    if isinstance(value, numbers.Rational):
        over, under = int(value.numerator), int(value.denominator)
    else:
        over, under = (value if hasattr(value, "as_integer_ratio") else float(value)).as_integer_ratio()
    return str(_DIGITS.divide(Decimal(over), Decimal(under)))


def _has_mask(values: object, depth: int = 0) -> bool:
    if isinstance(values, (list, tuple)):  # no array is deeper than 32
        return depth < 32 and any(_has_mask(one, depth + 1) for one in values if not isinstance(one, (float, int)))
    return isinstance(values, np.ma.MaskedArray)


def array_of(values: object, name: str) -> npt.NDArray[Any]:
    """The values as an array. Refuses masks, which numpy.asarray() drops without a word, also those of values that make an array
    themselves."""
    array = None if _has_mask(values) else np.asanyarray(values)
    if array is None or _has_mask(array):
        is_filled_by_nan = isinstance(values, np.ma.MaskedArray) and values.dtype.kind == "f"
        advice = f", such as {name}.filled(numpy.nan)" if is_filled_by_nan else ""
        raise TypeError(f"{name} are a masked array; expected one without a mask{advice}")
    return np.asarray(array)


def _is_changed(array: npt.NDArray[Any], narrow: Floats) -> bool:
    """True if binary32 does not hold all of the array's numbers."""
    if array.ndim > 0 and len(array) > 64 and _is_changed(array[:64], narrow[:64]):  # the usual case, without a look at all
        return True
    is_same = narrow == array
    if array.dtype.kind in "iu":  # beyond 2^53, binary64, in which they are compared, does not hold them all either
        is_same &= (array <= 2**53) & (array >= -(2**53))
    return not is_same.all() and not (is_same | (array != array)).all()


def _warn() -> None:
    """Warns of rounding at the line that called the package."""
    frame, level = sys._getframe(), 1
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        frame, level = frame.f_back, level + 1
    warnings.warn(_forceshade.rounded, _forceshade.RoundingWarning, stacklevel=level)


def as_floats(values: object, name: str, rounding: Rounding) -> Floats:
    """The values as binary32, the same memory where it can be, else rounded, with a warning where that was not asked for and
    changed one. `name` is plural: "positions"."""
    may_round = expect_rounding(rounding)
    try:
        array = array_of(values, name)
    except ValueError:
        raise ValueError(f"{name} are lists of different lengths; expected an array of numbers") from None
    kind, dtype = array.dtype.kind, array.dtype
    if kind not in "iuf":
        types = sorted({type(one).__name__ for one in array.flat})[:3] if kind == "O" else []
        what = "objects of " + ", ".join(types) if types else f"of type {dtype}"
        such_as = f", in an array such as numpy.array({name}, float)" if types and {"float", "int"} >= set(types) else ""
        raise TypeError(f"{name} are {what}; expected numbers{such_as}")
    if kind == "f" and dtype.itemsize <= 4:
        if dtype == np.float32 and array.flags.aligned and dtype.isnative:
            return array
        return array.astype(np.float32)  # each of them is held
    with np.errstate(over="ignore", invalid="ignore"):
        narrow = array.astype(np.float32)
    if not may_round and _is_changed(array, narrow):
        _warn()
    return narrow


def as_positions(positions: object, rounding: Rounding) -> Floats:
    """An array (..., 3)."""
    array = as_floats(positions, "positions", rounding)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise ValueError(f"positions have the shape {array.shape}; expected (..., 3): x, y, z in mm")
    return array


def _is_at_the_same_place(a: npt.NDArray[Any], b: npt.NDArray[Any]) -> bool:
    where, there = a.__array_interface__["data"][0], b.__array_interface__["data"][0]
    return bool(where == there) and a.strides == b.strides and a.shape == b.shape


def shares(a: npt.NDArray[Any], b: npt.NDArray[Any]) -> bool:
    try:
        return np.shares_memory(a, b, max_work=100_000)
    except Exception:  # numpy.TooHardError, whose place changes from version to version
        return True


def _expect_writable(array: object, name: str, dtype: npt.DTypeLike, shape: tuple[int, ...]) -> None:
    if not isinstance(array, np.ndarray):
        raise TypeError(f"{name}: expected a NumPy array, got {type(array).__name__}")
    if array.dtype != dtype or not array.dtype.isnative:
        raise TypeError(f"{name} is of type {array.dtype}; expected {np.dtype(dtype)}")
    if array.shape != shape:
        raise ValueError(f"{name} has the shape {array.shape}; expected {shape}")
    if not array.flags.writeable:
        raise ValueError(f"{name} is read-only; expected an array that can be written")
    if not array.flags.aligned:
        raise ValueError(f"{name} is not aligned; expected numbers that lie at multiples of their size")
    extent = array.itemsize  # in bytes, of the axes so far, from the one with the smallest stride
    for stride, length in sorted((abs(stride), length) for stride, length in zip(array.strides, array.shape) if length > 1):
        if stride < extent:
            raise ValueError(f"{name} has axes that overlap or interleave; expected elements apart from each other")
        extent += stride * (length - 1)


def count_of_threads(threads: object) -> int:
    if isinstance(threads, bool) or not hasattr(threads, "__index__"):
        raise TypeError(f"threads: expected a number of them, got {threads!r}")
    count = operator.index(threads)
    if count < 1:
        raise ValueError(f"threads: expected 1 or more, got {count}")
    return min(count, 256)


def output(out: object, positions: Floats) -> Floats:
    """The array for the forces: `out`, which has been looked at, or a new one."""
    if out is None:
        return np.empty(positions.shape, np.float32)
    _expect_writable(out, "out", np.float32, positions.shape)
    assert isinstance(out, np.ndarray)
    if shares(out, positions) and not _is_at_the_same_place(out, positions):
        raise ValueError("out and positions overlap; expected the very same array, or memory of its own")
    return out


def states(its: object, dtype: np.dtype[np.void], positions: Floats, *others: npt.NDArray[Any] | None) -> npt.NDArray[np.void]:
    """The states of as many paths as there are positions, which are written, too."""
    _expect_writable(its, "states", dtype, positions.shape[:-1])
    assert isinstance(its, np.ndarray)
    if not its.flags.c_contiguous:
        raise ValueError("states have gaps between them; expected an array that lies without gaps, as numpy.zeros() makes it")
    if any(other is not None and shares(its, other) for other in (positions, *others)):
        raise ValueError("states overlap the positions, out or status; expected memory of their own")
    return its


def statuses(status: object, positions: Floats, forces: Floats) -> Bytes | None:
    """The array for the statuses."""
    if status is None:
        return None
    _expect_writable(status, "status", np.uint8, positions.shape[:-1])
    assert isinstance(status, np.ndarray)
    if shares(status, positions) or shares(status, forces):
        raise ValueError("status overlaps the positions or out; expected memory of its own")
    return status
