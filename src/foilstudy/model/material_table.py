"""Materials known by name: data-sheet constants, each with its source.

Room-temperature values; a foil differs from its data sheet by ten per cent and more (grade,
rolling direction, rate), so measured constants are always the better choice. A material is listed
only where every constant has a source.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["MATERIALS", "MaterialConstants"]


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
