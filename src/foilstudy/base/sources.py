"""What a source file of the package says: its significant text, what it imports, its registries.

Comments, docstrings and blank lines decide nothing. An entry of a registry decides only where it is
chosen, and so stands apart from the text around it.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

__all__ = ["PACKAGE", "Entry", "Source", "significant", "source_of"]

PACKAGE = Path(__file__).parents[1]
_NAME = PACKAGE.name
_PLACE = re.compile(r"([a-z_0-9]+(?:\.[a-z_0-9]+)*):\w+(?:\.\w+)*")
"""``module:attribute``, as registries name what they load on use."""
_NAMING = ("choice", "kind", "words")
"""Attributes of a registry that give none of its entries but one asked for by name."""
_DECLARING = ("choice_field", "choice_of", "registry_field")
"""Functions that say of a field that its value is an entry of a registry."""
_SPACE = (tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)


@dataclass(frozen=True)
class Entry:
    """One entry of a registry.

    Attributes
    ----------
    variable : str
        That holds the registry.
    kind, name : str
        Of the registry; of the entry.
    text : str
        Its tokens, whatever lines they stand on.
    places : frozenset of str
        Modules of the package that it names.
    """

    variable: str
    kind: str
    name: str
    text: str
    places: frozenset[str]

    @property
    def imports(self) -> frozenset[str]:
        """These, and the packages that hold them."""
        return _with_parents(self.places)


@dataclass(frozen=True)
class Source:
    """What one module says.

    Attributes
    ----------
    text : str
        All that is significant, but for the entries of registries.
    imports : frozenset of str
        Modules of the package that it names anywhere else, also within functions.
    entries : tuple of Entry
    words : frozenset of str
        Its strings, but for those that something is only compared with.
    used_whole : frozenset of str
        Identifiers that, were they registries, might give any of their entries.
    """

    text: str
    imports: frozenset[str]
    entries: tuple[Entry, ...]
    words: frozenset[str]
    used_whole: frozenset[str]


@cache
def source_of(module: str) -> Source:
    """A module named within the package, as it is when first asked for."""
    path = _path(module)
    return _read(module, path.name == "__init__.py", path.read_text("utf-8"))


def significant(source: str) -> str:
    """The source without comments, free-standing strings, and blank lines.

    Cut from the text rather than put together again, so that it is the same in every release of
    Python.
    """
    return _cut(source, _tokens(source), ())


def _read(module: str, is_package: bool, text: str) -> Source:
    tree, tokens = ast.parse(text), _tokens(text)
    registries = list(_registries(tree, text, tokens))
    nodes = list(_run_time_nodes(tree, {registry.call for registry in registries}))
    shared = [node for registry in registries for node in registry.shared()]
    nodes += shared
    entries = tuple(
        Entry(
            registry.variable,
            registry.kind,
            name,
            _joined(item.tokens),
            _modules(_named(item.nodes(), module, is_package)),
        )
        for registry in registries
        for name, item in registry.entries.items()
    )
    rest = [registry.rest() for registry in registries]
    return Source(
        "\n".join([_cut(text, tokens, [registry.span for registry in registries]), *rest]),
        _with_parents(_modules(_named(nodes, module, is_package))),
        entries,
        frozenset(_words(nodes)),
        frozenset(_used_whole(nodes)),
    )


# --- text ----------------------------------------------------------------------------------------

_Span = tuple[tuple[int, int], tuple[int, int]]


def _tokens(source: str) -> list[tokenize.TokenInfo]:
    return list(tokenize.generate_tokens(io.StringIO(source).readline))


def _cut(source: str, tokens: list[tokenize.TokenInfo], spans: Iterable[_Span]) -> str:
    lines = source.splitlines()
    begins_statement = True
    for token, after in zip(tokens, [*tokens[1:], tokens[-1]], strict=True):
        free = token.type == tokenize.STRING and begins_statement and _ends_statement(after)
        if free or token.type == tokenize.COMMENT:
            _blank(lines, token.start, token.end)
        if token.type not in (tokenize.COMMENT, tokenize.NL):
            begins_statement = token.type in (tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT)
    for start, end in spans:
        _blank(lines, start, end)
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


def _joined(tokens: Iterable[tokenize.TokenInfo]) -> str:
    """Tokens on one line, the same however a formatter has laid them out."""
    text = " ".join(token.string for token in tokens if token.type not in _SPACE)
    return re.sub(r" ,(?= [)\]}]|$)", "", text)


# --- registries ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Item:
    """An item of the mapping of a registry: its nodes, and the tokens of it."""

    key: ast.expr | None
    value: ast.expr
    tokens: list[tokenize.TokenInfo]

    @property
    def name(self) -> str | None:
        """None of an item that is no single entry, as ``**OTHERS``."""
        told = isinstance(self.key, ast.Constant) and isinstance(self.key.value, str)
        return self.key.value if told else None

    def nodes(self) -> Iterator[ast.AST]:
        for node in filter(None, (self.key, self.value)):
            yield node
            yield from _run_time_nodes(node)


@dataclass(frozen=True)
class _Registry:
    variable: str
    kind: str
    call: ast.Call
    span: _Span
    items: list[_Item]

    @property
    def entries(self) -> dict[str, _Item]:
        return {item.name: item for item in self.items if item.name is not None}

    def shared(self) -> Iterator[ast.AST]:
        for item in self.items:
            if item.name is None:
                yield from item.nodes()

    def rest(self) -> str:
        shared = [_joined(item.tokens) for item in self.items if item.name is None]
        return " ".join([f"{self.variable} {self.kind}:", *shared])


def _registries(
    tree: ast.Module, text: str, tokens: list[tokenize.TokenInfo]
) -> Iterator[_Registry]:
    """Those whose entries can be told apart; any other is text like any text."""
    for statement in tree.body:
        match statement:
            case ast.Assign(
                targets=[ast.Name(id=variable)],
                value=ast.Call(
                    func=ast.Name(id="Registry"),
                    args=[ast.Constant(value=str(kind)), ast.Dict() as mapping],
                    keywords=[],
                ) as call,
            ):
                span = _span(call, text)
                items = _items(mapping, _span(mapping, text), tokens)
                names = [item.name for item in items if item.name is not None]
                if items and len(set(names)) == len(names):
                    yield _Registry(variable, kind, call, span, items)


def _span(node: ast.expr, text: str) -> _Span:
    """Of a node in characters: the parser counts bytes."""
    lines = text.splitlines()

    def place(line: int, offset: int) -> tuple[int, int]:
        return line, len(lines[line - 1].encode()[:offset].decode())

    return place(node.lineno, node.col_offset), place(node.end_lineno, node.end_col_offset)


def _items(mapping: ast.Dict, span: _Span, tokens: list[tokenize.TokenInfo]) -> list[_Item]:
    """Cut at the commas between the items; nothing where these do not match the parsed ones."""
    start, end = span
    parts: list[list[tokenize.TokenInfo]] = [[]]
    depth = 0
    for token in tokens:
        if token.start <= start or token.end >= end or token.type in _SPACE:
            continue
        depth += (token.string in ("(", "[", "{")) - (token.string in (")", "]", "}"))
        if token.string == "," and depth == 0:
            parts.append([])
        else:
            parts[-1].append(token)
    parts = parts if parts[-1] else parts[:-1]
    if len(parts) != len(mapping.keys):
        return []
    return [_Item(*item) for item in zip(mapping.keys, mapping.values, parts, strict=True)]


# --- imports and uses ----------------------------------------------------------------------------


def _run_time_nodes(tree: ast.AST, without: Iterable[ast.AST] = ()) -> Iterator[ast.AST]:
    """All nodes but those that only a type checker looks at, and some others."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING":
            continue
        if node in without:
            continue
        yield node
        yield from _run_time_nodes(node, without)


def _path(module: str) -> Path | None:
    """Source of a module named within the package; None if there is none."""
    path = PACKAGE.joinpath(*module.split("."))
    candidates = path / "__init__.py", path.with_suffix(".py")
    return next((candidate for candidate in candidates if candidate.is_file()), None)


def _modules(names: Iterable[str]) -> frozenset[str]:
    """Those of the names that are modules of the package."""
    return frozenset(filter(_path, names))


def _with_parents(modules: frozenset[str]) -> frozenset[str]:
    """Importing a.b.c runs a and a.b first."""
    return modules | {
        name.rsplit(".", count)[0] for name in modules for count in range(1, name.count(".") + 1)
    }


def _named(nodes: Iterable[ast.AST], module: str, is_package: bool) -> Iterator[str]:
    for node in nodes:
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


def _words(nodes: list[ast.AST]) -> Iterator[str]:
    compared = {
        id(part)
        for node in nodes
        if isinstance(node, ast.Compare)
        for side in (node.left, *node.comparators)
        for part in (side, *getattr(side, "elts", ()))
    }
    for node in nodes:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            if id(node) not in compared:
                yield node.value


def _used_whole(nodes: list[ast.AST]) -> Iterator[str]:
    by_name = {id(operand) for node in nodes for operand in _used_by_name(node)}
    for node in nodes:
        if isinstance(node, ast.alias) and node.asname:
            yield node.name
        elif isinstance(node, ast.Name | ast.Attribute) and id(node) not in by_name:
            if isinstance(node.ctx, ast.Load):
                yield node.id if isinstance(node, ast.Name) else node.attr


def _used_by_name(node: ast.AST) -> tuple[ast.AST, ...]:
    """Operands of which a registry gives the one entry that is asked for, or none."""
    match node:
        case ast.Subscript(value=value):
            return (value,)
        case ast.Attribute(value=value, attr=attribute) if attribute in _NAMING:
            return (value,)
        case ast.Compare(ops=[ast.In() | ast.NotIn()], comparators=[container]):
            return (container,)
        case ast.Call(func=ast.Name(id=function), args=arguments) if function in _DECLARING:
            return tuple(arguments)
    return ()
