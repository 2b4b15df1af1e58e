"""Results that are there but do not count: what the workflow makes again, and what it says of it.

Files alone decide, so that the answer is the same whatever became of the workflow's own notes.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Self

from foilstudy.base.errors import Refusal
from foilstudy.base.record import AGAIN

__all__ = ["Stale", "sentences"]

SHOWN = 6
"""Sentences at most."""


@dataclass(frozen=True)
class Stale:
    """A result that is made again.

    Attributes
    ----------
    path : Path
    reason : str
        Why, in words that follow the name of the file.
    """

    path: Path
    reason: str

    @classmethod
    def refused(cls, path: Path, problem: Refusal) -> Self:
        """One that cannot be read, or is not what is wanted."""
        return cls(path, str(problem).removeprefix(f"{path}: ").partition(f"; {AGAIN}")[0])


def sentences(folder: str, found: Iterable[Stale]) -> list[str]:
    """What a user is told before the first job: a line for each reason, and few lines."""
    by_reason: dict[str, list[str]] = {}
    for each in found:
        by_reason.setdefault(each.reason, []).append(each.path.name)
    lines = [
        f"{folder}: {_what(names)} {reason}; made again where it is needed."
        for reason, names in by_reason.items()
    ]
    more = len(lines) - SHOWN
    return lines if more <= 0 else [*lines[:SHOWN], f"{folder}: and for {more} reasons more."]


def _what(names: list[str]) -> str:
    if len(names) == 1:
        return names[0]
    kinds = set(names)
    what = f"{len(names)} files {names[0]}" if len(kinds) == 1 else f"{len(names)} files"
    return f"{what}, each"
