"""A side study as data: parts with their cases, what is measured of one, tables and figures.

Cheap to import, as the workflow makes its rules of it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from importlib import import_module
from operator import attrgetter
from typing import Any

from foilstudy.base.costs import Cost
from foilstudy.base.fingerprint import Code

DECIDING = (
    "config.foils",
    "config.scene",
    "linalg",
    "model",
    "solve",
    "measure",
    "pipeline",
    "study",
)
"""Packages and modules of the package that decide what is measured."""
PRESENTING = ("base", "plot", "study")
"""Those that decide how it is shown."""

Case = Any
"""A string, or a frozen dataclass of strings, numbers and truth values."""
_SAFE = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.+-]*")


def case_name(case: Case) -> str:
    """Name of a case in files and on command lines.

    The unit goes behind the number, a truth value is named if true, and what is None is left out:
    ``corner-thickness50um-height170mm-size1.25mm-seed0-prestressed``.

    Raises
    ------
    ValueError
        If a value makes no file name.
    """
    words = [case] if isinstance(case, str) else [_word(f.name, case) for f in fields(case)]
    name = "-".join(filter(None, words))
    if not _SAFE.fullmatch(name):
        raise ValueError(f"{case!r} makes no file name: give it letters, digits and _ . + -")
    return name


def _word(name: str, case: Case) -> str:
    value = getattr(case, name)
    if value is None or isinstance(value, str):
        return value or ""
    if isinstance(value, bool):
        return name if value else ""
    stem, _, unit = name.rpartition("_")
    return f"{stem or unit}{value:.12g}{unit if stem else ''}"


@dataclass(frozen=True)
class Lazy:
    """A function by ``module:function``, imported when called: plans stay cheap to import.

    Attributes
    ----------
    arguments : tuple
        Further arguments, behind those of the call.
    """

    place: str
    arguments: tuple = ()

    def load(self) -> Callable:
        """Import the function."""
        module, name = self.place.split(":")
        return attrgetter(name)(import_module(module))

    def __call__(self, *arguments, **named):
        return self.load()(*arguments, *self.arguments, **named)


def _code(functions: Iterable[Callable], rooms: tuple[str, ...]) -> Code:
    """Of the modules of functions; those outside the package, which no workflow runs, count not."""
    package = f"{__name__.partition('.')[0]}."
    places = (getattr(each, "place", None) or each.__module__ for each in functions)
    modules = {place.partition(":")[0] for place in places if place.startswith(package)}
    entries = tuple(sorted(module.removeprefix(package) for module in modules))
    return Code(entries, rooms, without=("study.kernel", "study.stale"))


@dataclass(frozen=True)
class Record:
    """What was measured of one case.

    Attributes
    ----------
    result : dict or list
        As measured; lists of numbers come back as arrays, numbers that were not finite as None,
        as NaN within arrays.
    digest : str
        Of the result; empty until it is written.
    """

    part: str
    case: Case
    result: Any
    cost: Cost
    digest: str = ""


Records = Mapping[str, Mapping[Case, Record]]
"""By part and case, in the order of the plan."""
Results = dict[str, dict[Case, Any]]
"""What was measured, by part and case."""


def results(records: Records) -> Results:
    """Findings of a study whose tables and figures need no costs."""
    return {
        part: {case: record.result for case, record in cases.items()}
        for part, cases in records.items()
    }


@dataclass(frozen=True)
class Part:
    """Cases of a study that are measured alike, a job and a record each.

    Attributes
    ----------
    name : str
        Also of the folder of the records.
    measure : callable
        ``measure(case)`` returns a dict, list or dataclass of numbers and text. With `needs`,
        ``measure(case, PART={case: Record})`` for every part that is needed.
    needs : mapping of str to callable
        By part, the cases of it whose records a case takes.
    arrays : tuple of str
        Keys of the result that are large arrays.
    memory_mb : int or callable
        Of a job, or as a function of the case.
    priority : int
        Jobs of the highest go first.
    """

    name: str
    cases: tuple[Case, ...]
    measure: Callable
    needs: Mapping[str, Callable[[Case], Iterable[Case]]] = field(default_factory=dict)
    arrays: tuple[str, ...] = ()
    memory_mb: int | Callable[[Case], int] = 1000
    priority: int = 0

    def __post_init__(self):
        if len(self.by_name) < len(self.cases):
            raise ValueError(f"{self.name}: two cases have the same name")

    @cached_property
    def by_name(self) -> dict[str, Case]:
        """Cases by their names."""
        return {case_name(case): case for case in self.cases}

    def case(self, name: str) -> Case:
        """The case of a name.

        Raises
        ------
        KeyError
            If there is none.
        """
        if name not in self.by_name:
            raise KeyError(f"{self.name} has no case {name!r} but {', '.join(self.by_name)}")
        return self.by_name[name]

    def memory(self, case: str) -> int:
        """MB for the job of a case."""
        return self.memory_mb(self.case(case)) if callable(self.memory_mb) else self.memory_mb

    @property
    def code(self) -> str:
        """Fingerprint of `measured_by`."""
        return self.measured_by.fingerprint()

    @property
    def measured_by(self) -> Code:
        """What measures a case."""
        return _code((self.measure,), DECIDING)

    def files(self, case: str) -> list[str]:
        """Files of a record in the folder of the study, the JSON first."""
        return [f"{self.name}/{case}.{kind}" for kind in ("json", "npz")[: 1 + bool(self.arrays)]]


@dataclass(frozen=True)
class Study:
    """A plan, what is measured of each case, tables and figures.

    Attributes
    ----------
    name : str
        Target of the workflow, and name on command lines.
    title : str
        In messages.
    parts : tuple of Part
        A part needs earlier ones only.
    tables : mapping of str to callable
        By file name, a function of the findings that returns text, or rows as dicts for CSV.
        ``costs.csv`` comes of itself.
    figures : mapping of str to callable
        By file name without suffix, a function of the findings that returns a matplotlib figure.
    findings : callable
        Makes of the records (``records[PART][case]``) what tables and figures are functions of; by
        default, these are the records.
    problems : callable
        Function of the findings that returns a sentence for each demand that they miss: the target
        fails with them, after everything is written.
    folder : str
        In ``results``; empty for that of the name.
    shown_by : mapping
        Plain data beside the records that tables and figures read, such as words for people: they
        are made again when it changes, and records are not.
    """

    name: str
    title: str
    parts: tuple[Part, ...]
    tables: Mapping[str, Callable]
    figures: Mapping[str, Callable]
    findings: Callable[[Mapping], Any] = lambda records: records
    problems: Callable[[Any], Sequence[str]] = lambda findings: ()
    folder: str = ""
    shown_by: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self):
        object.__setattr__(self, "folder", self.folder or self.name)

    @property
    def presenting_code(self) -> str:
        """Fingerprint of what makes tables and figures of the records."""
        shown = (*self.tables.values(), *self.figures.values(), self.findings)
        return _code(shown, PRESENTING).fingerprint()

    def part(self, name: str) -> Part:
        """The part of a name.

        Raises
        ------
        KeyError
            If there is none.
        """
        parts = {part.name: part for part in self.parts}
        if name not in parts:
            raise KeyError(f"{self.name} has no part {name!r} but {', '.join(parts)}")
        return parts[name]

    def needed(self, part: Part, case: str) -> list[str]:
        """JSON of the records that a case takes, in the folder of the study."""
        return [
            self.part(name).files(case_name(other))[0]
            for name, cases in part.needs.items()
            for other in cases(part.case(case))
        ]

    def records(self) -> list[str]:
        """JSON of all records, in the folder of the study."""
        return [part.files(case)[0] for part in self.parts for case in part.by_name]

    def outputs(self) -> list[str]:
        """Tables and figures, in the folder of the study."""
        figures = [f"{stem}.{kind}" for stem in self.figures for kind in ("png", "svg")]
        return [*self.tables, "costs.csv", *figures]
