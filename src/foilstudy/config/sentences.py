"""What Pydantic found wrong with a configuration, in sentences that name key path and remedy."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from difflib import get_close_matches
from functools import partial
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from foilstudy.base.registry import did_you_mean

from .model import StudyConfig
from .sections import TEXT_MAX

__all__ = ["MINIMAL", "describe", "sentences", "shown"]

MINIMAL = "a section sweep with thickness_um and reference_height_mm or overlength_percent"
SHOWN_MAX = 64
"""Characters of a name or value in a sentence."""


def sentences(error: ValidationError) -> list[Callable[[], str]]:
    """For each problem what makes its sentence; of thousands, only the first are wanted."""
    made: list[Callable[[], str]] = []
    details = error.errors(include_url=False)
    with_bad_items = {detail["loc"][:-1] for detail in details}
    for detail in details:
        kind, loc = detail["type"], detail["loc"]
        # Pydantic counts only the valid items; the invalid ones have their own sentence.
        if kind == "too_short" and loc in with_bad_items:
            continue
        if kind == "value_error":
            made += (partial(str, line) for line in str(detail["ctx"]["error"]).split("\n"))
        else:
            made.append(partial(_sentence, kind, loc, detail["input"], detail.get("ctx", {})))
    return made


def _sentence(kind: str, loc: tuple[str | int, ...], value: Any, ctx: dict[str, Any]) -> str:
    path = _path(loc)
    if kind == "extra_forbidden":
        return _unknown_key(loc)
    if kind == "invalid_key":
        return f"{describe(value)} is not a known key; keys are names such as 'sweep'."
    field = _field(loc)
    unit = _unit(field, loc)
    if kind == "missing":
        remedy = f"give at least {MINIMAL}" if loc == ("sweep",) else f"add it ({_meaning(field)})"
        return f"{path} is missing; {remedy}."
    if kind == "bool_type":
        return f"{path} is {describe(value)}, not a truth value; write true or false."
    if kind == "model_type":
        keys = ", ".join(_keys(loc))
        if value is None:
            return f"{path} has no keys; write some under it, indented: {keys}."
        return f"{path} is {describe(value)}, not a section; write keys under it: {keys}."
    if kind == "tuple_type":
        return f"{path} is {describe(value)}, not a list; write [{_example(value, unit, loc)}]."
    if kind == "too_short":
        return f"{path} is empty; give at least one value{_in(unit)}."
    if kind == "finite_number":
        return f"{path} is {value}, not a finite number; give a number{_in(unit)}."
    if kind == "float_type" and isinstance(value, int) and not isinstance(value, bool):
        return f"{path} is {describe(value)}, out of range; give a smaller one."
    if kind == "float_type":
        return f"{path} is {describe(value)}, not a number; {_number_remedy(value, unit)}."
    if kind == "int_type":
        whole = isinstance(value, float) and value.is_integer() and abs(value) < 1e15
        remedy = f"write {int(value)}" if whole else "give a whole number, without quotes"
        return f"{path} is {describe(value)}, not a whole number; {remedy}."
    if kind in _BOUNDS:
        phrase, key = _BOUNDS[kind]
        bound = f"{phrase} {ctx[key]:g}{_suffix(unit)}"
        return f"{path} is {describe(value)}, out of range; use a value {bound}."
    if kind == "too_long" and isinstance(value, list | tuple):
        return f"{path} has {len(value)} values; give at most {ctx['max_length']}."
    if kind == "literal_error":
        names = re.findall("'([^']*)'", ctx["expected"])
        hint = did_you_mean(value, names) if isinstance(value, str) else ""
        expected = f"{hint}use one of {ctx['expected']}"
        return f"{path} is {describe(value)}, which is no choice; {expected}."
    if kind == "string_type":
        return f"{path} is {describe(value)}, not text; put it in quotes."
    if kind.startswith("string_") and _extra(field).get("unit") == "text":
        return (
            f"{path} is {describe(value)}, which cannot be used; write 1 to {TEXT_MAX} characters "
            "that can be printed."
        )
    if kind in ("string_pattern_mismatch", "string_too_short", "string_too_long"):
        return f"{path} is {describe(value)}, which cannot be used; give: {_meaning(field)}."
    return f"{path} is {describe(value)}, which is invalid ({kind}); give: {_meaning(field)}."


_BOUNDS = {
    "greater_than": ("greater than", "gt"),
    "greater_than_equal": ("of at least", "ge"),
    "less_than": ("less than", "lt"),
    "less_than_equal": ("of at most", "le"),
}


def _path(loc: tuple[str | int, ...]) -> str:
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{shown(part)}" for part in loc)
    return text.removeprefix(".")


def _keys(loc: tuple[str | int, ...]) -> list[str]:
    if not loc:
        return list(StudyConfig.model_fields)
    model = StudyConfig.sections()[str(loc[0])]
    return list((_item(model, loc) or model).model_fields)


def _item(model: type[BaseModel], loc: tuple[str | int, ...]) -> type[BaseModel] | None:
    """Model of the mappings in the list that a path leads into, as of `installation.moves[0]`."""
    field = model.model_fields.get(str(loc[1])) if len(loc) > 2 else None
    of = get_args(field.annotation)[:1] if field else ()
    inside = bool(of) and isinstance(of[0], type) and issubclass(of[0], BaseModel)
    return of[0] if inside else None


def _unknown_key(loc: tuple[str | int, ...]) -> str:
    *parents, key = loc
    path, key = _path(loc), str(key)[:SHOWN_MAX]
    siblings = _keys(tuple(parents))
    close = get_close_matches(key, siblings, n=1) or [s for s in siblings if s.startswith(key)]
    if close:
        return f"{path} is not a known key; did you mean {_path((*parents, close[0]))}?"
    everywhere = [
        f"{name}.{k}" for name, model in StudyConfig.sections().items() for k in model.model_fields
    ]
    elsewhere = [known for known in everywhere if known.endswith(f".{key}")]
    if elsewhere:
        return f"{path} is not a known key; it belongs to another section: {elsewhere[0]}."
    close = get_close_matches(path, everywhere, n=1, cutoff=0)
    where = f"{_path(tuple(parents))} has" if parents else "the top level has"
    return (
        f"{path} is not a known key; the closest one is {close[0]}, and {where} "
        f"{', '.join(siblings)}."
    )


def _field(loc: tuple[str | int, ...]) -> FieldInfo | None:
    model = StudyConfig.sections().get(str(loc[0]))
    if len(loc) == 1 or model is None:
        return StudyConfig.model_fields.get(str(loc[0]))
    if (item := _item(model, loc)) and len(loc) > 3:
        return item.model_fields.get(str(loc[3]))
    return model.model_fields.get(str(loc[1]))


def _extra(field: FieldInfo | None) -> dict[str, Any]:
    extra = field.json_schema_extra if field else None
    return extra if isinstance(extra, dict) else {}


def _unit(field: FieldInfo | None, loc: tuple[str | int, ...]) -> str:
    unit = str(_extra(field).get("unit", "")).removeprefix("list of ")
    return "" if unit in ("1", "id", "text", "choice") else unit


def _in(unit: str) -> str:
    return f" in {unit}" if unit else ""


def _suffix(unit: str) -> str:
    return f" {unit}" if unit else ""


def _meaning(field: FieldInfo | None) -> str:
    return (field.description or "").rstrip(".") if field else "a valid value"


def _number_remedy(value: Any, unit: str) -> str:
    if isinstance(value, str):
        try:
            number = float(value)
        except ValueError:
            return f"write the number alone{_in(unit)}, without its unit"
        # A reader of YAML 1.1 takes 1e-6 for text, but not 1.0e-06.
        return f"write it as {number:.1e}" if "e" in value.lower() else "write it without quotes"
    return f"give a number{_in(unit)}"


def _example(value: Any, unit: str, loc: tuple[str | int, ...]) -> str:
    """What a list might hold; of numbers, unless it is one of mappings or of choices."""
    model = StudyConfig.sections().get(str(loc[0]))
    if item := model and _item(model, (*loc, 0)):
        return f"{{{next(iter(item.model_fields))}: ...}}"
    if isinstance(value, int | float | str):
        return f"{value}"
    return "" if "choice" in unit else "50, 130"


def describe(value: Any) -> str:
    """A value as a sentence names it."""
    if value is None:
        return "empty"
    if isinstance(value, bool):
        return f"the truth value {str(value).lower()}"
    if isinstance(value, Mapping):
        return "a mapping"
    if isinstance(value, list | tuple):
        return "a list"
    if isinstance(value, int) and abs(value) > 10**15:
        return "a number of more than 15 digits"
    text = _short(repr(value))
    return f"the text {text}" if isinstance(value, str) else text


def shown(name: str) -> str:
    """A name as a sentence shows it: in one line, and not too long."""
    return _short(name if name.isprintable() else repr(name))


def _short(text: str) -> str:
    return text if len(text) <= SHOWN_MAX else f"{text[: SHOWN_MAX - 4]} ..."
