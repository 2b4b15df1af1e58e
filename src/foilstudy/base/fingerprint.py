"""Fingerprints of code: what decides a result besides its task.

A release number says nothing of what was edited since. A fingerprint is that of the sources
themselves: of the modules that a computation imports, without comments, docstrings and blank lines,
which decide nothing. Of a registry only those entries count that the task chooses or the code names
itself; the others decide nothing either. Versions of Python and of libraries are recorded with a
result, not compared.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Self

from foilstudy.base.sources import PACKAGE, Entry, Source, significant, source_of

__all__ = ["Code", "fingerprint_of_files"]

LENGTH = 16
"""Hexadecimal digits."""


@dataclass(frozen=True)
class Code:
    """The modules that decide a kind of result.

    Attributes
    ----------
    entries : tuple of str
        Modules that make it, named within the package: ``study.sweep.crumple``.
    rooms : tuple of str
        Packages and modules whose imports are followed from there; others decide nothing.
    without : tuple of str
        Those within the rooms that decide nothing either.
    chosen : tuple of (str, tuple of str)
        By kind of registry, the names that are chosen; of any other registry all are followed.
    """

    entries: tuple[str, ...]
    rooms: tuple[str, ...]
    without: tuple[str, ...] = ()
    chosen: tuple[tuple[str, tuple[str, ...]], ...] = ()

    def choosing(self, chosen: Mapping[str, Iterable[str]]) -> Self:
        """The same for a task that chooses these names, by kind of registry."""
        content = tuple((kind, tuple(sorted(names))) for kind, names in sorted(chosen.items()))
        return replace(self, chosen=content)

    def modules(self) -> tuple[str, ...]:
        """All that the entries import within the rooms, themselves included; sorted."""
        return tuple(sorted(_reached(self).sources))

    def fingerprint(self) -> str:
        """Hexadecimal digits that change with the code, as it is when first asked for."""
        return _fingerprint(self)

    def follows(self, module: str) -> bool:
        """Whether a module may decide anything."""
        return _within_any(module, self.rooms) and not _within_any(module, self.without)


def _within_any(module: str, rooms: tuple[str, ...]) -> bool:
    return any(module == room or module.startswith(f"{room}.") for room in rooms)


class _Reached:
    """Modules of some code, and the entries of their registries that count."""

    def __init__(self, code: Code) -> None:
        self.sources: dict[str, Source] = {}
        self.counted: dict[str, list[Entry]] = {}
        self._code = code
        self._chosen = dict(code.chosen)
        self._words: set[str] = set()
        self._used_whole: set[str] = set()
        self._left: list[tuple[str, Entry]] = []
        self._go_on(code.entries)
        while counted := [each for each in self._left if self._counts(each[1])]:
            self._left = [each for each in self._left if each not in counted]
            for module, entry in counted:
                self.counted.setdefault(module, []).append(entry)
                self._go_on(filter(code.follows, entry.imports))

    def _go_on(self, modules: Iterable[str]) -> None:
        waiting = list(modules)
        while waiting:
            module = waiting.pop()
            if module in self.sources:
                continue
            source = self.sources[module] = source_of(module)
            self._words |= source.words
            self._used_whole |= source.used_whole
            self._left += ((module, entry) for entry in source.entries)
            waiting += filter(self._code.follows, source.imports)

    def _counts(self, entry: Entry) -> bool:
        """Whether it is chosen by the task, by a name in the code, or whatever is chosen."""
        if entry.places and not any(map(self._code.follows, entry.places)):
            return False
        chosen = self._chosen.get(entry.kind)
        return (
            chosen is None
            or entry.name in chosen
            or entry.name in self._words
            or entry.variable in self._used_whole
        )


@cache
def _reached(code: Code) -> _Reached:
    return _Reached(code)


@cache
def _fingerprint(code: Code) -> str:
    reached, summary = _reached(code), sha256()
    for module, source in sorted(reached.sources.items()):
        entries = sorted(entry.text for entry in reached.counted.get(module, ()))
        summary.update("\n".join([module, source.text, *entries, "\0"]).encode())
    return summary.hexdigest()[:LENGTH]


@cache
def fingerprint_of_files(*folders: str) -> str:
    """The same of every file in folders of the package: sources, templates, data.

    Of sources only what is significant counts, of other files every byte.
    """
    summary = sha256()
    for path in _files(folders):
        python = path.suffix == ".py"
        content = significant(path.read_text("utf-8")).encode() if python else path.read_bytes()
        summary.update(path.relative_to(PACKAGE).as_posix().encode() + b"\n" + content + b"\0")
    return summary.hexdigest()[:LENGTH]


def _files(folders: Iterable[str]) -> list[Path]:
    paths = (path for folder in folders for path in (PACKAGE / folder).rglob("*"))
    return sorted(p for p in paths if p.is_file() and "__pycache__" not in p.parts)
