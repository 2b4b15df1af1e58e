"""YAML reader without the traps of YAML 1.1, which PyYAML implements.

Plain scalars follow the core schema of YAML 1.2: ``1e-6`` is a number, ``010`` is ten, ``on`` and
``1:30`` are text. A key given twice is an error instead of a silent overwrite.
"""

from __future__ import annotations

import re
from typing import Any

import yaml

from foilstudy.base.errors import ConfigError

__all__ = ["read_yaml"]


class _CoreLoader(yaml.SafeLoader):
    """Safe loader with the scalars of YAML 1.2 and without duplicate keys."""

    yaml_implicit_resolvers: dict[str, list[Any]] = {}

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Any, Any]:
        lines: dict[str, int] = {}
        for key_node, _ in node.value:
            if not isinstance(key_node, yaml.ScalarNode):
                continue
            key, line = key_node.value, key_node.start_mark.line + 1
            if key in lines:
                raise _DuplicateKeyError(key, lines[key], line)
            lines[key] = line
        return super().construct_mapping(node, deep=deep)

    def construct_decimal(self, node: yaml.ScalarNode) -> int:
        return int(self.construct_scalar(node))


class _DuplicateKeyError(Exception):
    pass


_CoreLoader.add_implicit_resolver(
    "tag:yaml.org,2002:bool", re.compile(r"^(?:true|True|TRUE|false|False|FALSE)$"), list("tTfF")
)
_CoreLoader.add_implicit_resolver(
    "tag:yaml.org,2002:null", re.compile(r"^(?:~|null|Null|NULL|)$"), ["~", "n", "N", ""]
)
_CoreLoader.add_implicit_resolver(
    "tag:yaml.org,2002:int", re.compile(r"^[-+]?[0-9]+$"), list("-+0123456789")
)
_CoreLoader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(
        r"^(?:[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?"
        r"|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))$"
    ),
    list("-+.0123456789"),
)
_CoreLoader.add_implicit_resolver("tag:yaml.org,2002:merge", re.compile(r"^<<$"), ["<"])
_CoreLoader.add_constructor("tag:yaml.org,2002:int", _CoreLoader.construct_decimal)


def read_yaml(text: str) -> Any:
    """Content of a YAML text.

    Raises
    ------
    ConfigError
        If the text is not valid YAML, or gives a key twice.
    """
    try:
        return yaml.load(text, Loader=_CoreLoader)
    except _DuplicateKeyError as error:
        key, first, line = error.args
        raise ConfigError(
            f"line {line}: key {key} is given twice, first in line {first}; remove one of them."
        ) from None
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        where = f"line {mark.line + 1}, column {mark.column + 1}: " if mark else ""
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigError(
            f"{where}this is not valid YAML ({problem}); check indentation (spaces, no tabs), "
            "colons and brackets there."
        ) from None
