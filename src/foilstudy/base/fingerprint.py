"""Fingerprints of code: what decides a result besides its task.

A release number says nothing of what was edited since. A fingerprint is that of the sources
themselves: of the modules that a computation imports, without comments, docstrings and blank lines,
which decide nothing. Versions of Python and of libraries are recorded with a result, not compared.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from hashlib import sha256
from pathlib import Path

__all__ = ["Code", "fingerprint_of_files"]

_PACKAGE = Path(__file__).parents[1]
_NAME = _PACKAGE.name
_PLACE = re.compile(r"([a-z_0-9]+(?:\.[a-z_0-9]+)*):\w+(?:\.\w+)*")
"""``module:attribute``, as registries name what they load on use."""
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
    """

    entries: tuple[str, ...]
    rooms: tuple[str, ...]
    without: tuple[str, ...] = ()

    def modules(self) -> tuple[str, ...]:
        """All that the entries import within the rooms, themselves included; sorted."""
        found: set[str] = set()
        waiting = list(self.entries)
        while waiting:
            module = waiting.pop()
            if module not in found:
                found.add(module)
                waiting += (other for other in _imports(module) if self._followed(other))
        return tuple(sorted(found))

    def fingerprint(self) -> str:
        """Hexadecimal digits that change with the code, as it is when first asked for."""
        return _fingerprint(self)

    def _followed(self, module: str) -> bool:
        return _within_any(module, self.rooms) and not _within_any(module, self.without)


def _within_any(module: str, rooms: tuple[str, ...]) -> bool:
    return any(module == room or module.startswith(f"{room}.") for room in rooms)


@cache
def _fingerprint(code: Code) -> str:
    summary = sha256()
    for module in code.modules():
        summary.update(f"{module}\n{_significant_of(module)}\0".encode())
    return summary.hexdigest()[:LENGTH]


@cache
def fingerprint_of_files(*folders: str) -> str:
    """The same of every file in folders of the package: sources, templates, data.

    Of sources only what is significant counts, of other files every byte.
    """
    summary = sha256()
    for path in _files(folders):
        python = path.suffix == ".py"
        content = _significant(path.read_text("utf-8")).encode() if python else path.read_bytes()
        summary.update(path.relative_to(_PACKAGE).as_posix().encode() + b"\n" + content + b"\0")
    return summary.hexdigest()[:LENGTH]


def _files(folders: Iterable[str]) -> list[Path]:
    paths = (path for folder in folders for path in (_PACKAGE / folder).rglob("*"))
    return sorted(p for p in paths if p.is_file() and "__pycache__" not in p.parts)


def _path(module: str) -> Path | None:
    """Source of a module named within the package; None if there is none."""
    path = _PACKAGE.joinpath(*module.split("."))
    candidates = path / "__init__.py", path.with_suffix(".py")
    return next((candidate for candidate in candidates if candidate.is_file()), None)


@cache
def _source(module: str) -> str:
    return _path(module).read_text("utf-8")


@cache
def _imports(module: str) -> frozenset[str]:
    """Modules of the package that one names anywhere, also within functions and registries."""
    names = {name for name in _named(module) if _path(name)}
    # importing a.b.c runs a and a.b first
    parents = {
        name.rsplit(".", count)[0] for name in names for count in range(1, name.count(".") + 1)
    }
    return frozenset(names | parents)


def _named(module: str) -> Iterator[str]:
    is_package = _path(module).name == "__init__.py"
    for node in _run_time_nodes(ast.parse(_source(module))):
        if isinstance(node, ast.Import):
            yield from (_within(alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            # one dot is the package of the module, each further one the package above
            above = module.split(".")
            above = above[: len(above) + is_package - node.level]
            here = node.module or ""
            base = ".".join(filter(None, (*above, here))) if node.level else _within(here)
            yield base
            yield from (f"{base}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            if place := _PLACE.fullmatch(node.value):
                yield place[1]


def _within(name: str) -> str:
    """Name within the package; of another package, one that no module here has."""
    head, _, rest = name.partition(".")
    return rest if head == _NAME else f"/{name}"


def _run_time_nodes(tree: ast.AST) -> Iterator[ast.AST]:
    """All nodes but those that only a type checker looks at."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING":
            continue
        yield node
        yield from _run_time_nodes(node)


@cache
def _significant_of(module: str) -> str:
    return _significant(_source(module))


def _significant(source: str) -> str:
    """The source without comments, free-standing strings, and blank lines.

    Cut from the text rather than put together again, so that it is the same in every release of
    Python.
    """
    lines = source.splitlines()
    begins_statement = True
    tokens = list(tokenize.generate_tokens(io.StringIO(source).readline))
    for token, after in zip(tokens, [*tokens[1:], tokens[-1]], strict=True):
        free = token.type == tokenize.STRING and begins_statement and _ends_statement(after)
        if free or token.type == tokenize.COMMENT:
            _blank(lines, token.start, token.end)
        if token.type not in (tokenize.COMMENT, tokenize.NL):
            begins_statement = token.type in (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)
    return "\n".join(filter(None, (line.rstrip() for line in lines)))


def _ends_statement(token: tokenize.TokenInfo) -> bool:
    return token.type in (tokenize.NEWLINE, tokenize.COMMENT, tokenize.ENDMARKER)


def _blank(lines: list[str], start: tuple[int, int], end: tuple[int, int]) -> None:
    (first, left), (last, right) = start, end
    for number in range(first, last + 1):
        line = lines[number - 1]
        begin = left if number == first else 0
        stop = right if number == last else len(line)
        lines[number - 1] = line[:begin] + " " * (stop - begin) + line[stop:]
