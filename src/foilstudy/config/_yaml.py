"""YAML reader without the traps of YAML 1.1, which PyYAML implements, and with bounded work.

Plain scalars follow the core schema of YAML 1.2: ``1e-6`` is a number, ``010`` is ten, ``on`` and
``1:30`` are text. A key given twice is an error instead of a silent overwrite. PyYAML makes the
nodes; values are made of them here, as its own constructors know tags that build objects, and share
or copy what aliases name without end.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any, NoReturn

import yaml

from foilstudy.base.errors import ConfigError

__all__ = ["read_yaml", "written"]

NESTING_MAX = 16
VALUES_MAX = 50_000
"""Values in all, each counted as often as aliases repeat it."""
DIGITS_MAX = 320
"""More than any float has before its point."""

_TAG = "tag:yaml.org,2002:"
_STR, _MERGE = f"{_TAG}str", f"{_TAG}merge"
_SCALARS = {
    "bool": (r"true|True|TRUE|false|False|FALSE", "tTfF", lambda text: text.lower() == "true"),
    "null": (r"~|null|Null|NULL|", ["~", "n", "N", ""], lambda text: None),
    "int": (r"[-+]?[0-9]+", "-+0123456789", int),
    "float": (
        r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?"
        r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)",
        "-+.0123456789",
        lambda text: float(re.sub(r"\.(?=[in])", "", text.lower())),
    ),
}
"""Kind of a plain scalar: its pattern, the characters it may begin with, its value."""


class _Nodes(yaml.SafeLoader):
    """The nodes of a text, with the scalars of YAML 1.2 and not nested without end."""

    yaml_implicit_resolvers: dict[str, list[Any]] = {}
    depth = 0

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node:
        if self.depth > NESTING_MAX:
            _refuse(self.peek_event(), "brackets or indents are nested too deep; remove some.")
        self.depth += 1
        node = super().compose_node(parent, index)
        self.depth -= 1
        return node


for _kind, (_pattern, _firsts, _) in _SCALARS.items():
    _Nodes.add_implicit_resolver(
        f"{_TAG}{_kind}", re.compile(f"(?:{_pattern})$", re.ASCII), list(_firsts)
    )
_Nodes.add_implicit_resolver(_MERGE, re.compile(r"<<$"), ["<"])


def read_yaml(text: str) -> Any:
    """Content of a YAML text.

    Raises
    ------
    ConfigError
        If the text is not valid YAML, gives a key twice, or holds more than a configuration can.
    """
    text = _without_tabs(text)
    try:
        node = _only_document(_Nodes(text))
    except yaml.reader.ReaderError as error:
        line = text.count("\n", 0, error.position) + 1
        raise ConfigError(
            f"line {line}: the character U+{ord(text[error.position]):04X} cannot stand in a YAML "
            "file; remove it."
        ) from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        problem = " ".join((getattr(error, "problem", None) or str(error)).split())[:200]
        raise ConfigError(
            f"{where}this is not valid YAML ({problem}); check indentation (spaces, no tabs), "
            "colons and brackets there."
        ) from None
    return None if node is None else _Values().of(node)


def _without_tabs(text: str) -> str:
    """JSON may be indented with tabs, YAML not; within a string, JSON has none."""
    if "\t" not in text or not text.lstrip().startswith("{"):
        return text
    try:
        json.loads(text)
    except (ValueError, RecursionError):
        return text
    return text.replace("\t", " ")


def _only_document(nodes: _Nodes) -> yaml.Node | None:
    nodes.get_event()  # the beginning of the stream
    node = None if nodes.check_event(yaml.StreamEndEvent) else nodes.compose_document()
    if not nodes.check_event(yaml.StreamEndEvent):
        _refuse(nodes.peek_event(), "a second document begins here; keep one of them.")
    return node


class _Values:
    """Makes the values of nodes, and counts them."""

    def __init__(self) -> None:
        self._count = 0
        self._around: list[yaml.Node] = []
        self._older = yaml.FullLoader("")

    def of(self, node: yaml.Node) -> Any:
        self._count += 1
        if self._count > VALUES_MAX:
            _refuse(
                node,
                f"this makes more than {VALUES_MAX} values, with those that aliases (*) repeat; "
                "write fewer.",
            )
        if node in self._around:
            _refuse(node, "an alias (*) stands within what it names; write the values out.")
        if len(self._around) > NESTING_MAX:
            _refuse(
                node,
                f"aliases (*) nest this more than {NESTING_MAX} deep; write the values out.",
            )
        self._around.append(node)
        value = self._made(node)
        self._around.pop()
        return value

    def _made(self, node: yaml.Node) -> Any:
        if isinstance(node, yaml.ScalarNode):
            return self._scalar(node)
        if isinstance(node, yaml.SequenceNode) and node.tag == f"{_TAG}seq":
            return [self.of(item) for item in node.value]
        if isinstance(node, yaml.MappingNode) and node.tag == f"{_TAG}map":
            return self._mapping(node)
        _refuse_tag(node)

    def _scalar(self, node: yaml.ScalarNode) -> Any:
        text, kind = node.value, node.tag.removeprefix(_TAG)
        if node.tag in (_STR, _MERGE):
            if node.style is None:
                self._check_legible(node)
            return _whole_characters(node)
        if kind not in _SCALARS or not node.tag.startswith(_TAG):
            _refuse_tag(node)
        pattern, _, value_of = _SCALARS[kind]
        if not re.fullmatch(pattern, text, re.ASCII):
            _refuse(node, f"the value under the tag !!{kind} is none; remove the tag.")
        if kind == "int" and len(text) > DIGITS_MAX:
            _refuse(node, f"this number has {len(text)} digits; write a smaller one.")
        return value_of(text)

    def _check_legible(self, node: yaml.ScalarNode) -> None:
        """Refuse what YAML 1.1 takes for a number or date, but an impossible one.

        Snakemake reads a file by YAML 1.1 beside this reader, and ends there.
        """
        tag = self._older.resolve(yaml.ScalarNode, node.value, (True, False))
        if tag == _STR:
            return
        try:
            self._older.construct_object(yaml.ScalarNode(tag, node.value))
        except (ValueError, yaml.YAMLError):
            _refuse(node, f"the text {node.value[:40]} can be misread; put it in quotes.")

    def _mapping(self, node: yaml.MappingNode) -> dict[str, Any]:
        own: dict[str, Any] = {}
        merged: dict[str, Any] = {}
        lines: dict[str, int] = {}
        for key_node, value_node in node.value:
            key, line = self._key(key_node), key_node.start_mark.line + 1
            if key in lines:
                _refuse(
                    key_node,
                    f"key {_short(key)} is given twice, first in line {lines[key]}; "
                    "remove one of them.",
                )
            lines[key] = line
            if key_node.tag != _MERGE:
                own[key] = self.of(value_node)
                continue
            for source in self._merge_sources(value_node):
                for name, value in source.items():
                    if name in merged:
                        _refuse(
                            key_node,
                            f"key {_short(name)} comes from two of the merged mappings; "
                            "write it out.",
                        )
                    merged[name] = value
        return merged | own

    def _key(self, node: yaml.Node) -> str:
        if node.tag == _MERGE:
            return node.value
        key = self.of(node) if isinstance(node, yaml.ScalarNode) else None
        if not isinstance(key, str):
            shown = node.value[:40] if isinstance(node, yaml.ScalarNode) else "that begins here"
            _refuse(node, f"the key {shown} is not text; keys are names such as sweep.")
        return key

    def _merge_sources(self, node: yaml.Node) -> Iterator[dict[str, Any]]:
        content = self.of(node)
        for source in content if isinstance(content, list) else [content]:
            if not isinstance(source, dict):
                _refuse(node, "<< merges mappings, and this is none; write the keys out.")
            yield source


def _whole_characters(node: yaml.ScalarNode) -> str:
    r"""The text, with what JSON writes as two halves (``\ud83d\ude00``) made one character."""
    try:
        return node.value.encode("utf-16", "surrogatepass").decode("utf-16")
    except UnicodeDecodeError:
        _refuse(node, "this text has half a character (\\ud800 to \\udfff); remove it.")


def _short(text: str) -> str:
    return text if re.fullmatch(r"[\w-]{1,60}|<<", text) else repr(text)[:60]


def _refuse_tag(node: yaml.Node) -> NoReturn:
    tag = node.tag.replace(_TAG, "!!", 1)
    _refuse(
        node,
        f"the tag {_short(tag)} is not known here; remove it, as values are text, numbers, lists "
        "and mappings.",
    )


def _refuse(place: yaml.Node | yaml.Event, problem: str) -> NoReturn:
    raise ConfigError(f"line {place.start_mark.line + 1}: {problem}")


# numbers of YAML 1.2 that PyYAML, which follows 1.1, would write without quotes as a text
_NUMBER = re.compile(r"[-+]?(\.\d+|\d+(\.\d*)?)([eE][-+]?\d+)?|0o[0-7]+|0x[\dA-Fa-f]+")


class _Writer(yaml.SafeDumper):
    """Writes what is read back as it is."""


def _text(writer: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    style = "'" if _NUMBER.fullmatch(text) else None
    return writer.represent_scalar("tag:yaml.org,2002:str", text, style=style)


_Writer.add_representer(str, _text)


def written(content: Mapping[str, Any]) -> str:
    """YAML of plain data, in the order in which it comes."""
    return yaml.dump(content, Dumper=_Writer, sort_keys=False, allow_unicode=True)
