"""Specifications as plain data: what is recorded with a result, and read back from it.

A specification is a frozen dataclass of numbers, texts and further specifications. One that is an
entry of a registry has a class attribute ``kind``, its name there, and the field that holds it
names the registry by `choice_field`.
"""

from __future__ import annotations

import json
from dataclasses import MISSING, Field, field, fields, is_dataclass
from functools import partial
from typing import Any, TypeVar, get_args, get_type_hints

from foilstudy.base.errors import Refusal
from foilstudy.base.registry import Registry

__all__ = ["choice_field", "dumped", "loaded", "plain", "registry_of", "restored"]

T = TypeVar("T")
_REGISTRY = "registry"


def choice_field(registry: Registry, default_factory: Any = MISSING) -> Any:
    """Dataclass field whose value is an entry of a registry."""
    return field(default_factory=default_factory, metadata={_REGISTRY: registry})


def registry_of(item: Field) -> Registry | None:
    """The registry that a field of a specification names by `choice_field`, if any."""
    return item.metadata.get(_REGISTRY)


def plain(spec: Any) -> Any:
    """Numbers, texts, lists and dicts that say the same as a specification."""
    if is_dataclass(spec):
        content = {item.name: plain(getattr(spec, item.name)) for item in fields(spec)}
        kind = getattr(type(spec), "kind", None)
        return {"kind": kind} | content if isinstance(kind, str) else content
    if isinstance(spec, tuple | list):
        return [plain(item) for item in spec]
    return spec


def restored(kind: type[T], content: dict[str, Any]) -> T:
    """The specification of a class that `plain` has taken apart.

    Raises
    ------
    Refusal
        If the content has other fields, as from another release of the package.
    """
    hints = get_type_hints(kind)
    known = {item.name: item for item in fields(kind)}
    content = {name: value for name, value in content.items() if name != "kind" or "kind" in known}
    refusal = Refusal(
        f"the record is from another release: its {kind.__name__} has {', '.join(content)}, not "
        f"{', '.join(known)}; compute it again."
    )
    if content.keys() != known.keys():
        raise refusal
    values = {}
    for name, value in content.items():
        registry = registry_of(known[name])
        if registry is not None:
            if not isinstance(value, dict) or value.get("kind") not in registry:
                raise refusal
            value = restored(registry[value["kind"]], value)
        elif is_dataclass(hints[name]):
            value = restored(hints[name], value)
        elif isinstance(value, list):
            of = get_args(hints[name])[:1]  # of tuple[X, ...]
            each = partial(restored, of[0]) if of and is_dataclass(of[0]) else lambda item: item
            value = tuple(map(each, value))
        values[name] = value
    return kind(**values)


def dumped(spec: Any) -> str:
    """A specification as a line of JSON."""
    return json.dumps(plain(spec))


def loaded(kind: type[T], text: str) -> T:
    """What `dumped` has written."""
    return restored(kind, json.loads(text))
