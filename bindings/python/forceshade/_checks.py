# SPDX-License-Identifier: BSD-3-Clause
"""Properties of a renderer, and certificates."""

from __future__ import annotations

import errno
import json
import operator
import os
from typing import Any, Mapping, NamedTuple, Sequence

from . import _forceshade
from ._subject import File, Subject, path_of, word_of


class PropertyResult(NamedTuple):
    """The result of checking one property."""

    name: str
    """"equivalence", "continuity", "unit normals", "passivity", or that of a further property."""
    cases: int
    held: bool
    counterexample: str
    """The shrunk one, in words; empty where it held."""


class Certificate(NamedTuple):
    """The result of certify()."""

    held: bool
    """True if every check held."""
    standing: str
    """"sufficient", "insufficient" (every check held, but forceshade drive needs more evidence), or "failed"."""
    lacks: str
    """The missing evidence, in words, where it is insufficient."""
    remedy: str
    """The command that gathers it."""
    contents: dict[str, Any]
    """The contents of its file: certificate/schema.md."""

    @classmethod
    def read(cls, file: File) -> Certificate:
        """That of a file, which certify() or the command wrote. Raises OSError where it cannot be opened, and Error, with the key
        and what was expected, where it is no certificate."""
        return _certificate(*_forceshade.read_certificate(os.fsencode(path_of(file))))

    def __repr__(self) -> str:
        names = ", ".join(subject["name"] for subject in self.contents["subjects"])
        return f"<Certificate of {names}: {self.standing}>"


def _certificate(text: str, held: bool, standing: str, lacks: str, remedy: str) -> Certificate:
    return Certificate(held, standing, lacks, remedy, json.loads(text))


def _expect_room(path: str, overwrite: bool) -> None:
    """That a file can be made there, which is known before the work and not after it."""
    folder = os.path.dirname(path) or "."
    if os.path.isdir(path):
        raise IsADirectoryError(errno.EISDIR, "expected the name of a file, got that of a folder", path)
    if os.path.lexists(path) and not overwrite:
        raise FileExistsError(f"{path} is there already; expected another name, or overwrite=True")
    if not os.path.isdir(folder):
        raise FileNotFoundError(errno.ENOENT, "expected a folder that is there", folder)
    if not os.access(folder, os.W_OK | os.X_OK):
        raise PermissionError(errno.EACCES, "expected a folder in which a file can be made", folder)


def _count(number: object, name: str, least: int, most: int) -> int:
    try:
        count = operator.index(number)  # type: ignore[arg-type]
    except TypeError:
        raise TypeError(f"{name}: expected an integer, got {number!r}") from None
    if not least <= count <= most:
        raise ValueError(f"{name} is {count}; expected {least} to {most}")
    return count


def _expect_subject(subject: object) -> Subject:
    if not isinstance(subject, Subject):
        raise TypeError(f"expected a Law, HeightMap or Mesh, got {type(subject).__name__}")
    return subject


def properties(subject: Subject, *, cases: int = _forceshade.usual_cases, seed: int = 0) -> list[PropertyResult]:
    """Checks the properties of a renderer on generated cases: equivalence with the exact definition, continuity, unit normals,
    passivity, and further ones of its kind, `cases` of each. The same seed gives the same cases.

    Ctrl-C ends it. Raises ValueError for fewer cases than one.

    >>> import forceshade
    >>> [result.held for result in properties(forceshade.Law("wall", stiffness=0.5), cases=20)]
    [True, True, True, True]
    """
    checked = _expect_subject(subject)
    results = _forceshade.properties(checked, _count(cases, "cases", 1, 2**31 - 1), _count(seed, "seed", 0, 2**64 - 1))
    return [PropertyResult(**result) for result in results]


def certify(
    subjects: Subject | Sequence[Subject],
    *,
    points: int | None = None,
    cases: int = _forceshade.usual_cases,
    seed: int = 0,
    threads: int | None = None,
    out: File | None = None,
    overwrite: bool = False,
) -> Certificate:
    """Checks renderers against the exact definition at many points, and their properties, as forceshade certify does.

    points: of each subject, and a quarter as many with other parameters; default: as many as forceshade drive requires.
    threads: default: as many as this process may use processors. out: a file, into which the certificate goes as JSON; one
    that is there already is replaced only with overwrite=True.

    The certificate is bound to this package's compiled code: library_digest(). Ctrl-C ends it. Raises OSError before any work
    where the file cannot be made, ValueError for a number out of its range, and TypeError.
    """
    all_of_them = [subjects] if isinstance(subjects, Subject) else [_expect_subject(subject) for subject in subjects]
    if not all_of_them:
        raise ValueError("expected one subject at least")
    usual = max(_forceshade.points_of_kind(subject._kind) for subject in all_of_them)
    path = None if out is None else os.fsdecode(os.fspath(out))
    if path is not None:
        _expect_room(path, overwrite)
    made = _forceshade.certify(
        list(all_of_them),
        _count(usual if points is None else points, "points", 1, 2**62),
        _count(cases, "cases", 1, 2**31 - 1),
        _count(seed, "seed", 0, 2**64 - 1),
        _count(len(os.sched_getaffinity(0)) if threads is None else threads, "threads", 1, 1024),
    )
    if path is not None:
        _forceshade.write_file(os.fsencode(path), made[0])
    return _certificate(*made)


class PlanState(NamedTuple):
    """The state of a plan of work, which any number of processes and machines do (docs/cluster.md)."""

    digest: str
    units: int
    done: int
    taken: int
    expired: int
    """Units whose process gave no sign of life for longer than their lease."""
    missing: str
    """The units without a result, in words; empty where all are done."""
    alarms: list[str]
    """Files that differ from the result of the same unit: one machine computes wrongly."""


def make_plan(
    folder: File,
    subject: Mapping[str, str],
    *,
    points: int = 0,
    cases: int = _forceshade.usual_cases,
    seed: int = 0,
    units: int = 1000,
) -> PlanState:
    """Divides what certify() does into about so many units of work in a new folder, as forceshade certify plan does.

    subject: options of docs/subjects.md, such as {"law": "all"}. points: of each subject; 0: as many as forceshade drive requires.
    """
    made = _forceshade.make_plan(
        os.fsencode(folder),
        [(word_of(key, "subject"), word_of(value, key)) for key, value in subject.items()],
        _count(points, "points", 0, 10**12),
        _count(cases, "cases", 1, 10**9),
        _count(seed, "seed", 0, 2**64 - 1),
        _count(units, "units", 1, 10**6),
    )
    return PlanState(**made)


def plan_state(folder: File) -> PlanState:
    """The state of the plan in a folder, whoever made it."""
    return PlanState(**_forceshade.plan_state(os.fsencode(folder)))


def work_on_plan(folder: File, *, threads: int | None = None, wait: bool = True) -> PlanState:
    """Does units until all are done, beside any number of other processes; without wait, until the others have taken the rest.
    Ctrl-C ends it, and what is done stays."""
    count = len(os.sched_getaffinity(0)) if threads is None else threads
    _forceshade.work_on_plan(os.fsencode(folder), _count(count, "threads", 1, 1024), wait)
    return plan_state(folder)


def merged_plan(folder: File) -> Certificate:
    """The certificate of a plan whose units are all done. Raises Error where units are missing or two results differ."""
    certificate, state = _forceshade.merged_plan(os.fsencode(folder))
    if state["missing"] or state["alarms"]:
        why = ", ".join(state["alarms"]) + " differ from the results beside them" if state["alarms"] else "missing: " + state["missing"]
        raise _forceshade.Error(f"{os.fsdecode(folder)}: there is no certificate; {why}")
    return _certificate(*certificate)
