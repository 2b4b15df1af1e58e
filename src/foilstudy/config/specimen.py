"""The specimen of a study configuration: in what it departs from an ideal foil in ideal clamps."""

from __future__ import annotations

import math
from typing import Annotated

from pydantic import Field, model_validator

from foilstudy.model.specimen import DEVIATION_MAX, FACTOR_MAX, Clamps

from .sections import Section, unit_field

__all__ = ["Specimen", "clamps_of"]

_Modulus = Annotated[float, Field(ge=1e-3, le=2e6)]
_Factor = {"gt": 0, "le": FACTOR_MAX}


class Specimen(Section):
    """What a real specimen has and the ideal one has not; without it, nothing.

    A seam along the height, uneven thickness, rings out of true, clamps that let it slip, weight,
    and constants of the material that differ from one realisation to the next.
    """

    seam_width_mm: float = unit_field(
        "mm", "Width of a strip along the height, its middle on the x axis; 0 for none.", 0.0, ge=0,
        le=1000,
    )  # fmt: skip
    seam_thickness_factor: float = unit_field(
        "1", "Thickness of that strip over that of the foil.", 1.0, **_Factor
    )
    seam_modulus_factor: float = unit_field(
        "1",
        "Young's modulus of that strip over that of the foil; its yield stress and hardening are "
        "in the same proportion.",
        1.0,
        **_Factor,
    )
    thickness_deviation_percent: float = unit_field(
        "%",
        "Standard deviation of the thickness, a smooth random field that is drawn from the seed "
        "and cut off at twice that.",
        0.0,
        ge=0,
        le=100 * DEVIATION_MAX,
    )
    thickness_correlation_mm: float = unit_field(
        "mm", "Standard deviation of the kernel that smooths this field.", 30.0, ge=1, le=1000
    )
    ring_ellipticity_mm: float = unit_field(
        "mm",
        "By how much the radius of both rings is larger along x, and smaller along y.",
        0.0,
        ge=-100,
        le=100,
    )
    ring_tilt_deg: float = unit_field(
        "deg", "Tilt of the top ring about y, from the beginning.", 0.0, ge=-10, le=10
    )
    clamp_slip_mm: float = unit_field(
        "mm",
        "As far as the foil may slip along itself, out of the clamps or into them; 0 if it is "
        "held.",
        0.0,
        ge=0,
        le=100,
    )
    clamp_grip_n_per_m: float = unit_field(
        "N/m",
        "Line force along the foil up to which clamps that let it slip hold it: friction times the "
        "tension of the band over the radius.",
        Clamps.grip,
        ge=0,
        le=1e6,
    )
    gravity_m_s2: float = unit_field(
        "m/s2",
        "Acceleration by which the foil is heavy, from the top ring to the bottom one.",
        0.0,
        ge=-100,
        le=100,
    )
    youngs_modulus_range_mpa: tuple[_Modulus, _Modulus] | None = unit_field(
        "list of MPa",
        "Two moduli between which that of each realisation is drawn, from its seed, in place of "
        "`material.youngs_modulus_mpa`.",
        None,
        strict=False,
    )
    yield_stress_range_mpa: tuple[_Modulus, _Modulus] | None = unit_field(
        "list of MPa",
        "The same of the yield stress.",
        None,
        strict=False,
    )

    @model_validator(mode="after")
    def _fits_together(self) -> Specimen:
        problems = [
            f"specimen.{name} is {getattr(self, name):g}, but there is no seam; give "
            "specimen.seam_width_mm, or remove it."
            for name in ("seam_thickness_factor", "seam_modulus_factor")
            if getattr(self, name) != 1 and not self.seam_width_mm
        ]
        if self.clamp_grip_n_per_m != Clamps.grip and not self.clamp_slip_mm:
            problems.append(
                f"specimen.clamp_grip_n_per_m is {self.clamp_grip_n_per_m:g}, but nothing slips; "
                "give specimen.clamp_slip_mm, or remove it."
            )
        for name in ("youngs_modulus_range_mpa", "yield_stress_range_mpa"):
            drawn = getattr(self, name)
            if drawn is not None and not drawn[0] < drawn[1]:
                problems.append(f"specimen.{name} is {list(drawn)}; give two rising values.")
        if problems:
            raise ValueError("\n".join(problems))
        return self

    @property
    def even(self) -> bool:
        """Whether thickness and modulus are the same all over a foil."""
        return not (self.seam_width_mm or self.thickness_deviation_percent)

    @property
    def true(self) -> bool:
        """Whether both rings are round and level."""
        return not (self.ring_ellipticity_mm or self.ring_tilt_deg)

    @property
    def draws(self) -> bool:
        """Whether constants of the material are drawn."""
        return bool(self.youngs_modulus_range_mpa or self.yield_stress_range_mpa)


def clamps_of(section: Specimen) -> Clamps:
    """SI clamps."""
    return Clamps(
        section.ring_ellipticity_mm * 1e-3,
        math.radians(section.ring_tilt_deg),
        section.clamp_slip_mm * 1e-3,
        section.clamp_grip_n_per_m,
    )
