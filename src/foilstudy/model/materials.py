"""Isotropic foil materials, and those known by name.

Room-temperature data-sheet values; a foil differs from its data sheet by ten per cent and more
(grade, rolling direction, rate), so measured constants are always the better choice. A material
is listed only where every constant has a source. The yield stress bounds the linear-elastic
model (the share of the surface beyond yield); it never enters the equilibrium.
"""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number
from foilstudy.base.registry import did_you_mean

__all__ = ["MATERIALS", "Material", "MaterialConstants", "material"]


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
        Pa; only used to report which share of the surface a linear elastic model overloads.
    name : str
        For people; it decides nothing.
    law : str
        A name of `foilstudy.model.shell.material.LAWS`.
    """

    youngs_modulus: float
    poisson_ratio: float
    density: float
    yield_stress: float
    name: str = ""
    law: str = "elastic"

    def __post_init__(self):
        require_number("Young's modulus of a material", self.youngs_modulus, "Pa", above=0)
        require_number("Poisson's ratio of a material", self.poisson_ratio, above=-1, most=0.5)
        require_number("density of a material", self.density, "kg/m3", above=0)
        require_number("yield stress of a material", self.yield_stress, "Pa", above=0)

    def __repr__(self) -> str:
        return (
            f"<Material: {self.name or 'without a name'}, {1e-6 * self.youngs_modulus:g} MPa, "
            f"Poisson {self.poisson_ratio:g}, {self.density:g} kg/m³, yield "
            f"{1e-6 * self.yield_stress:g} MPa, {self.law}>"
        )


@dataclass(frozen=True)
class MaterialConstants:
    """Constants of an isotropic, linear elastic foil and where they come from.

    Attributes
    ----------
    youngs_modulus_mpa : float
        Young's modulus in MPa.
    poisson_ratio : float
        Poisson's ratio.
    density_kg_m3 : float
        Density in kg/m3.
    yield_stress_mpa : float
        Uniaxial yield stress in MPa.
    description : str
        What the material is, in words.
    source : str
        Origin of the constants.
    """

    youngs_modulus_mpa: float
    poisson_ratio: float
    density_kg_m3: float
    yield_stress_mpa: float
    description: str
    source: str

    def material(self, name: str) -> Material:
        """The same in SI units."""
        return Material(
            youngs_modulus=self.youngs_modulus_mpa * 1e6,
            poisson_ratio=self.poisson_ratio,
            density=self.density_kg_m3,
            yield_stress=self.yield_stress_mpa * 1e6,
            name=name,
        )


MATERIALS: dict[str, MaterialConstants] = {
    # Modulus, Poisson's ratio and density are those of the published case. The table of
    # fluoroplastics (DIN 53455, 53457, 53479) lists a limit of elasticity of 12 N/mm2 for FEP,
    # beside a tensile modulus of 350 to 700 N/mm2 and a density of 2.12 to 2.17 g/cm3.
    "FEP": MaterialConstants(
        650.0,
        0.4,
        2150.0,
        12.0,
        "fluorinated ethylene propylene (Teflon FEP), the published case",
        "M. Bader, Structural Dynamics of Crumpled Thin Sheets, TU Delft, 2026; yield stress: "
        "finemech.com/ft005.html, mechanical properties of fluoroplastic materials",
    ),
    # Modulus 490 (machine direction) and 510 (transverse) kg/mm2, taken as isotropic at
    # 500 kg/mm2; Poisson's ratio 0.38 before yield; strength at 5 % elongation 10 kg/mm2.
    "PET": MaterialConstants(
        4903.0,
        0.38,
        1390.0,
        98.0,
        "biaxially oriented polyester film (Mylar 92A)",
        "DuPont Teijin Films, Mylar Physical-Thermal Properties, H-37232-3, table 1 and the text "
        "on tensile properties; yield stress: strength at 5 % elongation",
    ),
    # Tensile modulus 2.5 GPa, 'yield point at 3 %' 69 MPa, density 1.42 g/cm3 at 23 C;
    # Poisson's ratio 0.34 is the average of three samples elongated by 5, 7 and 10 %.
    "polyimide": MaterialConstants(
        2500.0,
        0.34,
        1420.0,
        69.0,
        "polyimide film (Kapton HN)",
        "DuPont, Kapton HN technical data sheet, table 1; Poisson's ratio: "
        "Kapton properties table, mu2e.phy.duke.edu",
    ),
    # Annealed temper, Aluminum Association typical values; hard tempers (H18) yield far later.
    "aluminium": MaterialConstants(
        68900.0,
        0.33,
        2710.0,
        34.0,
        "aluminium 1100, annealed (temper O)",
        "Aluminum 1100 material data sheet, alloysintl.com; density and temper: MatWeb, "
        "Aluminum 1100-O",
    ),
    # Data sheet range of the modulus: 193 to 200 GPa; yield stress at 0.2 % offset.
    "stainless steel": MaterialConstants(
        193000.0,
        0.29,
        8000.0,
        215.0,
        "stainless steel AISI 304, annealed",
        "AISI Type 304 Stainless Steel data sheet, scribd.com/document/416534641",
    ),
}


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
    return MATERIALS[name].material(name)
