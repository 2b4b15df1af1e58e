"""Results of others that the study is compared with: published ones, and those of another code."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import NamedTuple

import numpy as np


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


@dataclass(frozen=True)
class Published:
    """Everything the study quotes from the published work.

    Attributes
    ----------
    citation
        Source of all values.
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
    power_laws: Mapping[str, Mapping[str, PublishedLaw]]
    first_eigenfrequency_exponents: Mapping[float, float]
    colour_scale_mm: float
    radial_displacement_range_mm: tuple[float, float]
    run_time_exponents: Mapping[float, float]


EXPLICIT_CODE_ENERGIES: Mapping[float, tuple[float, ...]] = {5.0: (5.04, 4.74, 4.83), 2.5: (4.31,)}
"""Strain energies (J) of crumples by element size (mm), a seed each; not published.

Computed for this project, for the published case (500 um, h_ref 170 mm), by an open-source explicit
code with the published kind of element, a 4-node shell with reduced integration (QEPH), weakly
mass-scaled.
"""


@lru_cache(maxsize=1)
def published() -> Published:
    """Return the published results that ship with the package."""
    import yaml

    text = resources.files("foilstudy.base").joinpath("data/published.yaml").read_text("utf-8")
    raw = yaml.safe_load(text)
    return Published(
        citation=raw["citation"],
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


def _law(entry: Mapping) -> PublishedLaw:
    return PublishedLaw(
        alpha=Estimate(*entry["alpha"]),
        beta=Estimate(*entry["beta"]),
        gamma=Estimate(*entry["gamma"]),
        r2=entry["r2"],
    )
