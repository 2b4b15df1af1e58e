"""Values of a specification by their places: what side studies change, as data."""

from __future__ import annotations

from dataclasses import Field, fields, replace
from typing import Any, TypeVar

from foilstudy.base.errors import Refusal
from foilstudy.base.spec import registry_of

__all__ = ["Value", "changed", "value_at"]

Value = bool | int | float | str
_METRES = {"mm": 1e-3, "um": 1e-6}

Spec = TypeVar("Spec")


def changed(spec: Spec, place: str, value: Value) -> Spec:
    """A specification with one of its values replaced.

    A place names a field, or by points one of its own: ``path.scheme.mass.safety``. A length may
    end in its unit, ``element_size_mm``. A name in the place of a choice stands for that entry of
    its registry, with its own defaults.

    Raises
    ------
    Refusal
        If there is no such place or entry.
    """
    name, _, rest = place.partition(".")
    item, factor = _field(spec, name)
    if rest:
        return replace(spec, **{item.name: changed(getattr(spec, item.name), rest, value)})
    if registry := registry_of(item):
        value = registry[value]()
    return replace(spec, **{item.name: value if factor is None else factor * value})


def value_at(spec: Any, place: str) -> Value:
    """The value that `changed` would replace, in the unit of the place."""
    for name in place.split("."):
        item, factor = _field(spec, name)
        spec = getattr(spec, item.name)
    if registry_of(item):
        return spec.kind
    return spec if factor is None else round(spec / factor, 9)


def _field(spec: Any, name: str) -> tuple[Field, float | None]:
    """Field of a specification, and the unit in which a name gives its value."""
    known = {item.name: item for item in fields(spec)}
    stem, _, unit = name.rpartition("_")
    if name not in known and stem in known and unit in _METRES:
        return known[stem], _METRES[unit]
    if name not in known:
        raise Refusal(
            f"{type(spec).__name__} has no {name!r}; use one of {', '.join(sorted(known))}."
        )
    return known[name], None
