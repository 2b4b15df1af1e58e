"""In what a study's foil and its fitting are more than the published model, in words."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from foilstudy.base.numerals import plural

from .specimen import Specimen

__all__ = ["departures"]


def departures(content: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """What there is besides an elastic foil, pushed straight, that passes through itself.

    Parameters
    ----------
    content : mapping
        A validated configuration as plain data, such as a cube carries; one of an earlier release
        lacks the sections that did not exist.

    Yields
    ------
    tuple of str
        A word for the list of `foilstudy check`, and what is so.
    """
    material = content.get("material", {})
    if material.get("law", "elastic") != "elastic":
        modulus = material.get("hardening_mpa")
        hardens = "" if modulus is None else f", hardening by {modulus:g} MPa"
        yield "yielding", f"{material['law']} from {material['yield_stress_mpa']:g} MPa on{hardens}"
    ideal = Specimen().model_dump(mode="json")
    specimen = content.get("specimen", {})
    if other := [f"{key} {specimen[key]}" for key in specimen if specimen[key] != ideal.get(key)]:
        yield "specimen", ", ".join(other)
    fitted = content.get("installation", {})
    if moves := fitted.get("moves"):
        yield "fitted", f"with {plural(len(moves), 'move')} of the ring before it stays"
    if hours := fitted.get("waiting_hours"):
        yield "waiting", f"{hours:g} hours before it is measured"
    contact = content.get("contact", {})
    if contact.get("kind", "none") != "none":
        reach = contact.get("reach_mm")
        planes = ", and the planes of the rings" if contact.get("ring_planes") else ""
        words = "up to 1 mm" if reach is None else f"{reach:g} mm"
        friction = contact.get("friction", 0.0)
        rubs = f", friction of {friction:g}" if friction else ""
        yield "contact", f"{contact['kind']} of {words} between parts of the foil{planes}{rubs}"
