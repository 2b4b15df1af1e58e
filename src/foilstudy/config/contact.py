"""Contact of a study: its section, and whether mesh and method can keep it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from pydantic import model_validator

from foilstudy.base.errors import Refusal
from foilstudy.model.contact import CONTACTS
from foilstudy.model.contact.sizes import FRICTION_MAX, reach_on
from foilstudy.model.patch import Patch

from .choices import choice_of
from .sections import Method, Section, registry_field, unit_field

__all__ = ["Contact", "ContactUse", "contact_problems"]

_PATHS = ("relaxation", "ring_alone", "installation")
"""Along which no step crosses."""


class Contact(Section):
    """What parts of the foil do that come near each other."""

    kind: choice_of(CONTACTS) = registry_field(CONTACTS, "none")
    reach_mm: float | None = unit_field(
        "mm",
        "Gap between the faces of the foil at which the barrier begins, at most 0.4 of an element; "
        "only with `kind: barrier`. Left out, it is 1 mm, and a quarter of an element at most.",
        None,
        gt=0,
        le=100,
    )
    stiffness: float | None = unit_field(
        "1",
        "Energy of the barrier over membrane stiffness times squared reach; only with `kind: "
        "barrier`, 0.003 if left out. A softer one is entered more deeply, and is stiffer there.",
        None,
        ge=1e-5,
        le=1,
    )

    ring_planes: bool = unit_field(
        "",
        "Whether the planes of the rings are barriers, too, as plates at the ends would be; only "
        "with `kind: barrier`.",
        False,
    )
    friction: float = unit_field(
        "1",
        "Coefficient of Coulomb's friction where parts of the foil touch, and where it touches the "
        "planes of the rings; only with `kind: barrier`.",
        0.0,
        ge=0,
        le=FRICTION_MAX,
    )

    @model_validator(mode="after")
    def _numbers_only_where_they_count(self) -> Contact:
        given = [key for key in ("reach_mm", "stiffness") if getattr(self, key) is not None]
        given += [key for key in ("ring_planes", "friction") if getattr(self, key)]
        if given and self.kind == "none":
            raise ValueError(
                f"contact.{given[0]} is given, but contact.kind is none; remove it, or set "
                "contact.kind: barrier."
            )
        return self


@dataclass(frozen=True)
class ContactUse:
    """What contact has to go with.

    Attributes
    ----------
    diameter_mm : float
    heights_mm : tuple of float
    sizes_mm : mapping of float to float
        Element size by thickness in um.
    ramp_coarsenings, relaxed_refinements : int
    method : Method
    """

    diameter_mm: float
    heights_mm: tuple[float, ...]
    sizes_mm: Mapping[float, float]
    ramp_coarsenings: int
    relaxed_refinements: int
    method: Method


def contact_problems(contact: Contact, use: ContactUse) -> Iterator[str]:
    """One sentence for each thing that contact cannot go with, with its remedy."""
    if contact.kind == "none":
        return
    chosen = f"contact.kind is {contact.kind}, but"
    if use.method.path not in _PATHS:
        yield (
            f"{chosen} method.path: {use.method.path} does not keep parts of the foil from "
            "crossing; use relaxation."
        )
    if use.method.damping.startswith("kinetic"):
        yield (
            f"{chosen} method.damping: {use.method.damping} steps back without regard to it; use "
            "adaptive_viscous."
        )
    if use.ramp_coarsenings:
        yield (
            f"{chosen} mesh.ramp_coarsenings is {use.ramp_coarsenings}, and a refined shape may "
            "cross itself; set it to 0."
        )
    if use.relaxed_refinements:
        yield (
            f"{chosen} stiffness.relaxed_refinements is {use.relaxed_refinements}, and a refined "
            "shape may cross itself; set it to 0."
        )
    yield from _reach_problems(contact, use)


def _reach_problems(contact: Contact, use: ContactUse) -> Iterator[str]:
    """Of the first thickness whose mesh cannot carry its barrier."""
    reach = None if contact.reach_mm is None else contact.reach_mm * 1e-3
    for thickness, size in use.sizes_mm.items():
        for height in use.heights_mm:
            patch = Patch.for_cylinder(use.diameter_mm * 1e-3, height * 1e-3, size * 1e-3)
            try:
                reach_on(patch, thickness * 1e-6, reach)
            except Refusal as refusal:
                yield f"contact.kind is {contact.kind}, but {refusal}"
                return
