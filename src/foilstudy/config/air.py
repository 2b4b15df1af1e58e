"""The air about the foil of a study configuration."""

from __future__ import annotations

from pydantic import model_validator

from foilstudy.measure.choices import AIRS, ENCLOSURES

from .choices import choice_of
from .sections import Section, registry_field, unit_field

__all__ = ["Air"]


class Air(Section):
    """Air about the foil: in its dynamics, not in its static stiffness.

    What it does and how far it is right: `docs/air.md`.
    """

    kind: choice_of(AIRS) = registry_field(AIRS, "none")
    density_kg_m3: float = unit_field("kg/m3", "Density of the air.", 1.2, ge=0, le=2_000)
    enclosed: choice_of(ENCLOSURES) = registry_field(
        ENCLOSURES, "vented", "Air between foil, rings and rigid end plates. "
    )
    pressure_kpa: float = unit_field(
        "kPa", "Pressure of the air, inside and outside; of a sealed volume.", 101.325, ge=0, le=1e4
    )

    @model_validator(mode="after")
    def _enclosed_only_in_air(self) -> Air:
        if self.kind == "none" and self.enclosed != "vented":
            raise ValueError(
                f"air.enclosed is {self.enclosed}, but air.kind is none, so there is no air to "
                "enclose; set air.kind: added_mass, or remove air.enclosed."
            )
        if self.kind == "added_mass_true_surface" and self.enclosed != "vented":
            raise ValueError(
                f"air.enclosed is {self.enclosed}, but air.kind is added_mass_true_surface, whose "
                "ends are open; set air.kind: added_mass, or remove air.enclosed."
            )
        return self
