"""Isotropic foil materials; those known by name stand in `material_table`.

The yield stress bounds the linear-elastic model (the share of the surface beyond yield); it enters
the equilibrium of the plastic law alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number
from foilstudy.base.registry import did_you_mean
from foilstudy.model.material_table import MATERIALS, MaterialConstants

__all__ = ["MATERIALS", "RELAXATION_ONSET", "Material", "MaterialConstants", "material"]

RELAXATION_ONSET = 60.0
"""s; about what fitting a foil takes, from where on its relaxation counts."""


@dataclass(frozen=True)
class Material:
    """Isotropic material.

    Attributes
    ----------
    youngs_modulus : float
        Pa.
    poisson_ratio : float
    density : float
        kg/m3.
    yield_stress : float
        Pa; for the plastic law, and for the share of the surface that the elastic one overloads.
    name : str
        For people; it decides nothing.
    law : str
        A name of `foilstudy.model.shell.material.LAWS`.
    hardening : float or None
        Slope of stress over plastic strain, Pa, for the plastic law; None: what that takes for it.
    relaxation_per_decade : float
        Share of its stress that a held foil loses in each tenfold of time.
    """

    youngs_modulus: float
    poisson_ratio: float
    density: float
    yield_stress: float
    name: str = ""
    law: str = "elastic"
    hardening: float | None = None
    relaxation_per_decade: float = 0.0

    def __post_init__(self):
        require_number("Young's modulus of a material", self.youngs_modulus, "Pa", above=0)
        require_number("Poisson's ratio of a material", self.poisson_ratio, above=-1, most=0.5)
        require_number("density of a material", self.density, "kg/m3", above=0)
        require_number("yield stress of a material", self.yield_stress, "Pa", above=0)
        if self.hardening is not None:
            require_number("hardening of a material", self.hardening, "Pa", least=0)
        slope = self.relaxation_per_decade
        require_number("relaxation of a material per decade", slope, least=0, most=1)

    def stress_kept(self, seconds: float) -> float:
        """Share of its stress that a held foil still has after a while: 1 - slope log10(1 + t/t0).

        t0 is `RELAXATION_ONSET`. Zero is the least.
        """
        decades = math.log10(1 + seconds / RELAXATION_ONSET)
        return max(0.0, 1 - self.relaxation_per_decade * decades)

    def __repr__(self) -> str:
        return (
            f"<Material: {self.name or 'without a name'}, {1e-6 * self.youngs_modulus:g} MPa, "
            f"Poisson {self.poisson_ratio:g}, {self.density:g} kg/m³, yield "
            f"{1e-6 * self.yield_stress:g} MPa, {self.law}>"
        )


def material(name: str | Material) -> Material:
    """A known material in SI units; a material is returned as it is.

    Raises
    ------
    Refusal
        Naming the known ones.
    """
    if isinstance(name, Material):
        return name
    if name not in MATERIALS:
        raise Refusal(
            f"{name!r} is not a known material; {did_you_mean(name, MATERIALS)}use one of "
            f"{', '.join(MATERIALS)}, or a Material with constants of your own."
        )
    constants = MATERIALS[name]
    return Material(
        youngs_modulus=constants.youngs_modulus_mpa * 1e6,
        poisson_ratio=constants.poisson_ratio,
        density=constants.density_kg_m3,
        yield_stress=constants.yield_stress_mpa * 1e6,
        name=name,
    )
