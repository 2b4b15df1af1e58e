"""Results that the study is compared with, where they hold, and the form of a power law."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import NamedTuple

import numpy as np

from foilstudy.base.numerals import nominal


class Estimate(NamedTuple):
    """A published value and its standard deviation."""

    value: float
    std: float


@dataclass(frozen=True)
class PowerLaw:
    """``ln k = alpha + beta ln(overlength/%) + gamma ln(thickness/um)``, `k` in N/m.

    Attributes
    ----------
    alpha : float
        Logarithm of the stiffness (N/m) at 1 % and 1 um.
    beta, gamma : float
        Exponents of overlength and thickness; NaN, which counts as zero, where a sweep does not
        determine one.
    """

    alpha: float
    beta: float
    gamma: float

    def stiffness(self, overlength_percent, thickness_um):
        """Stiffness in N/m; the arguments broadcast against each other."""
        return np.exp(
            self.alpha
            + np.nan_to_num(self.beta) * np.log(overlength_percent)
            + np.nan_to_num(self.gamma) * np.log(thickness_um)
        )

    def dimensionless(self, radius_mm: float, youngs_modulus_mpa: float) -> DimensionlessLaw:
        """The same law without units, for the foil that it was found with.

        Its exponent of the thickness counts as zero where it is not known, as everywhere.
        """
        beta, gamma = np.nan_to_num([self.beta, self.gamma])
        # k / (E t) with overlength = 100 o / % and t = 1e3 (R / mm) (t/R) um, E t in MPa um = N/m
        thickness_of_radius = 1e3 * radius_mm
        logarithm = self.alpha + beta * np.log(100) + (gamma - 1) * np.log(thickness_of_radius)
        constant = float(np.exp(logarithm) / youngs_modulus_mpa)
        return DimensionlessLaw(constant, float(beta), float(gamma - 1))


@dataclass(frozen=True)
class DimensionlessLaw:
    """``k / (E t) = constant * (overlength / gap)^beta * (t / R)^gamma``.

    It says nothing of the height of the gap over the diameter, which is that of the study.

    Attributes
    ----------
    constant, beta, gamma : float
        `gamma` is that of `PowerLaw` minus one.
    """

    constant: float
    beta: float
    gamma: float

    def stiffness(self, overlength_share, thickness_share):
        """Stiffness over Young's modulus times thickness.

        Parameters
        ----------
        overlength_share
            Overlength over the height of the gap, a share of one.
        thickness_share
            Thickness over radius.
        """
        return self.constant * overlength_share**self.beta * thickness_share**self.gamma


@dataclass(frozen=True)
class PublishedLaw:
    """Published power law of the stiffness.

    Attributes
    ----------
    alpha, beta, gamma
        Least-squares estimates, see `PowerLaw`.
    r2
        Coefficient of determination.
    """

    alpha: Estimate
    beta: Estimate
    gamma: Estimate
    r2: float

    @property
    def law(self) -> PowerLaw:
        """The law with the estimated values."""
        return PowerLaw(self.alpha.value, self.beta.value, self.gamma.value)


GEOMETRY_TOLERANCE = 0.02
"""By what share a length of a comparable case may differ; a stiffness follows by as much."""
MATERIAL_TOLERANCE = 0.05
"""The same of a material constant: what a handbook leaves open."""


@dataclass(frozen=True)
class Case:
    """A foil, its gap, and the range of a sweep.

    Attributes
    ----------
    diameter_mm, gap_height_mm, youngs_modulus_mpa, poisson_ratio, density_kg_m3 : float
    thickness_um, overlength_percent : tuple of float
        Smallest and largest.
    """

    diameter_mm: float
    gap_height_mm: float
    youngs_modulus_mpa: float
    poisson_ratio: float
    density_kg_m3: float
    thickness_um: tuple[float, float]
    overlength_percent: tuple[float, float]

    def departures(self, studied: Case) -> tuple[str, ...]:
        """In what another case is not this one, in words; empty where the two compare.

        Lengths may differ by `GEOMETRY_TOLERANCE`, constants of the material by
        `MATERIAL_TOLERANCE`; the sweep of the other lies within that of this one.
        """
        scalars = (
            ("diameter", "diameter_mm", " mm", GEOMETRY_TOLERANCE),
            ("gap", "gap_height_mm", " mm", GEOMETRY_TOLERANCE),
            ("E", "youngs_modulus_mpa", " MPa", MATERIAL_TOLERANCE),
            ("ν", "poisson_ratio", "", MATERIAL_TOLERANCE),
            ("density", "density_kg_m3", " kg/m³", MATERIAL_TOLERANCE),
        )
        found = []
        for words, name, unit, tolerance in scalars:
            mine, other = getattr(self, name), getattr(studied, name)
            if not abs(other - mine) <= tolerance * mine:
                found.append(f"{words} {other:g}{unit} instead of {mine:g}")
        for words, name, unit in (
            ("thickness", "thickness_um", " µm"),
            ("overlength", "overlength_percent", " %"),
        ):
            (low, high), (lowest, highest) = getattr(self, name), getattr(studied, name)
            slack = 1 + GEOMETRY_TOLERANCE
            if not (low / slack <= lowest and highest <= high * slack):
                ends = " to ".join(dict.fromkeys(map(nominal, (lowest, highest))))
                found.append(f"{words} {ends}{unit} outside {nominal(low)} to {nominal(high)}")
        return tuple(found)


@dataclass(frozen=True)
class Published:
    """Everything the study quotes from the published work.

    Attributes
    ----------
    citation
        Source of all values.
    case
        The foil and the sweep that they hold for.
    power_laws
        Power law by direction (axial, radial) and source (simulation, experiment).
    first_eigenfrequency_exponents
        Exponent of the first eigenfrequency in the reference height, by thickness in um.
    colour_scale_mm
        Half width of the published radial-displacement colour scale.
    radial_displacement_range_mm
        Smallest and largest published radial displacement.
    run_time_exponents
        Exponent of the run time in the element size, by thickness in um.
    """

    citation: str
    case: Case
    power_laws: Mapping[str, Mapping[str, PublishedLaw]]
    first_eigenfrequency_exponents: Mapping[float, float]
    colour_scale_mm: float
    radial_displacement_range_mm: tuple[float, float]
    run_time_exponents: Mapping[float, float]


EXPLICIT_CODE_ENERGIES: Mapping[float, tuple[float, ...]] = {5.0: (5.04, 4.74, 4.83), 2.5: (4.31,)}
"""Strain energies (J) of crumples by element size (mm), a seed each.

QEPH, computed for this project with an open-source explicit code: they are not in the thesis. The
case is the published one (500 um, h_ref 170 mm), the element of the published kind, a 4-node shell
with reduced integration; weakly mass-scaled.
"""
EXPLICIT_CODE = "QEPH, computed for this project with an open-source explicit code"
"""What these energies, and all else of that code, are called wherever they are shown."""


@lru_cache(maxsize=1)
def published() -> Published:
    """Return the published results that ship with the package."""
    import yaml

    text = resources.files("foilstudy.base").joinpath("data/published.yaml").read_text("utf-8")
    raw = yaml.safe_load(text)
    return Published(
        citation=raw["citation"],
        case=Case(
            **{
                name: tuple(value) if isinstance(value, list) else value
                for name, value in raw["case"].items()
            }
        ),
        power_laws={
            direction: {source: _law(entry) for source, entry in laws.items()}
            for direction, laws in raw["power_law"].items()
        },
        first_eigenfrequency_exponents={
            float(thickness): exponent
            for thickness, exponent in raw["first_eigenfrequency_exponent"].items()
        },
        colour_scale_mm=raw["radial_displacement_colour_scale_mm"],
        radial_displacement_range_mm=tuple(raw["radial_displacement_range_mm"]),
        run_time_exponents={
            float(thickness): exponent for thickness, exponent in raw["run_time_exponent"].items()
        },
    )


def colour_scale_mm(radius_mm: float) -> float:
    """Half width of the colour scale of radial displacement: the published share of the radius."""
    case = published().case
    return published().colour_scale_mm * radius_mm / (case.diameter_mm / 2)


def _law(entry: Mapping) -> PublishedLaw:
    return PublishedLaw(
        alpha=Estimate(*entry["alpha"]),
        beta=Estimate(*entry["beta"]),
        gamma=Estimate(*entry["gamma"]),
        r2=entry["r2"],
    )
