# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of runs."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from . import _forceshade

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._subject import File


class Recording(NamedTuple):
    """The result of read_recording()."""

    samples: Any
    """A structured array with a row for each tick, or a pandas.DataFrame: the columns of docs/recording.md; mm, N, mJ, ns."""
    metadata: dict[str, str]
    """The subject, the device and the settings of the run."""
    problems: list[str]
    """The reasons why it is not a whole run as it was written, a sentence each; empty if it is whole."""

    def __repr__(self) -> str:
        return f"<Recording of {len(self.samples)} ticks, {'whole' if not self.problems else self.problems[0]}>"


def read_recording(file: File, *, frame: bool = False) -> Recording:
    """The recording of a run, which forceshade drive --out writes.

    frame: whether its samples are a pandas.DataFrame, which needs pandas; else they are a structured NumPy array.

    Raises OSError where the file cannot be opened, Error where it is no recording or a part of it is damaged, and ImportError
    where pandas is asked for and not there. A run that was cut off is read as far as it goes; `problems` says so.
    """
    from ._subject import path_of

    data, columns, metadata, problems = _forceshade.read_recording(os.fsencode(path_of(file)))
    layout = np.dtype(columns)
    samples: npt.NDArray[np.void] = np.ndarray(len(data) // layout.itemsize, layout, data)
    if frame:
        try:
            import pandas  # type: ignore[import]
        except ImportError:
            raise ImportError("frame=True needs pandas; expected it to be installed, such as Debian's python3-pandas") from None
        return Recording(pandas.DataFrame(samples), metadata, problems)
    return Recording(samples, metadata, problems)
