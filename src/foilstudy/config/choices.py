"""Keys of a configuration that choose an entry of a registry, and what a task chooses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel

from foilstudy.base.registry import Registry

__all__ = ["cautions_of", "choice_of", "choices_of"]


@dataclass(frozen=True)
class _Of:
    """Beside the type of a value: which registry it is from."""

    kind: str
    names: tuple[str, ...]
    cautions: tuple[tuple[str, str], ...] = ()


def choice_of(registry: Registry) -> Any:
    """Type of a value that is a name of a registry."""
    names = tuple(registry)
    cautions = ((name, registry.choice(name).caution) for name in names)
    known = tuple((name, words) for name, words in cautions if words)
    return Annotated[Literal[names], _Of(registry.kind, names, known)]


def cautions_of(section: BaseModel, path: str = "") -> Iterator[str]:
    """A sentence for every choice in a section, and those in it, that is known to fail."""
    for name, field in type(section).model_fields.items():
        value, place = getattr(section, name), f"{path}{name}"
        for registry in (*field.metadata, *_annotations(field.annotation)):
            if isinstance(registry, _Of):
                for chosen, words in registry.cautions:
                    if chosen in _flat(value):
                        yield f"{place} is {chosen}: {words}."
        if isinstance(value, BaseModel):
            yield from cautions_of(value, f"{place}.")


def choices_of(*sections: BaseModel) -> dict[str, tuple[str, ...]]:
    """All names that sections and the sections in them choose, by the kind of registry.

    A registry of which a key does not say what is chosen (None, or a word that is no name of it) is
    left out, whatever other keys say.
    """
    found: dict[str, set[str]] = {}
    unsaid = set()
    for registry, names in chain.from_iterable(map(_chosen, sections)):
        found.setdefault(registry.kind, set()).update(names)
        if not names or not names <= set(registry.names):
            unsaid.add(registry.kind)
    return {kind: tuple(sorted(names)) for kind, names in found.items() if kind not in unsaid}


def _chosen(section: BaseModel) -> Iterator[tuple[_Of, set[str]]]:
    for name, field in type(section).model_fields.items():
        value = getattr(section, name)
        values = list(_flat(value))
        for registry in (*field.metadata, *_annotations(field.annotation)):
            if isinstance(registry, _Of):
                yield registry, {each for each in values if isinstance(each, str)}
        for each in values:
            if isinstance(each, BaseModel):
                yield from _chosen(each)


def _annotations(kind: Any) -> Iterator[Any]:
    """All that stands within a type."""
    for part in get_args(kind):
        yield part
        yield from _annotations(part)


def _flat(value: Any) -> Iterator[Any]:
    if isinstance(value, tuple | list | set | frozenset):
        for each in value:
            yield from _flat(each)
    elif isinstance(value, dict):
        yield from _flat([*value, *value.values()])
    else:
        yield value
