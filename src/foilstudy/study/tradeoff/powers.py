"""Run time as a power of the element size."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.reference import published
from foilstudy.study.convergence.analysis import slope
from foilstudy.study.tradeoff.points import Gathered

_CHANGE = "mesh.element_size_mm"
EXPONENTS = {
    f"published, {thickness:g} µm": exponent
    for thickness, exponent in published().run_time_exponents.items()
} | {"theory": -3.0}
"""What others have found of a whole crumple. In theory the elements grow with the second power of
their number along a line, and an explicit method needs steps with the first."""


@dataclass(frozen=True, eq=False)
class Power:
    """Times, and the power law through them.

    Attributes
    ----------
    name : str
    sizes_mm, seconds : ndarray
        Sizes rising.
    exponent, error : float
        Least squares, and its standard error (NaN for two points).
    """

    name: str
    sizes_mm: np.ndarray
    seconds: np.ndarray
    exponent: float
    error: float

    @property
    def words(self) -> str:
        """Name and exponent."""
        margin = f" ± {self.error:.2f}" if np.isfinite(self.error) else ""
        return f"{self.name}: exponent {self.exponent:.2f}{margin}"


def step_powers(study: Gathered) -> list[Power]:
    """Of a pseudo-time step, by thickness."""
    thicknesses = dict.fromkeys(row["thickness_um"] for row in study.steps)
    return [
        _power(
            f"{thickness} µm",
            [
                (row["size_mm"], row["seconds_per_step"])
                for row in study.steps
                if row["thickness_um"] == thickness
            ],
        )
        for thickness in thicknesses
    ]


def crumple_powers(study: Gathered) -> list[Power]:
    """Of a whole crumple, for each ensemble on several meshes."""
    found: dict[str, dict[float, float]] = {}
    for row in study.rows:
        if row.change == _CHANGE and np.isfinite(row.seconds):
            found.setdefault(row.ladder, {})[float(row.value)] = row.seconds
    return [
        _power(ladder.split(", ")[-1].replace("um", "µm"), times.items())
        for ladder, times in found.items()
    ]


def _power(name: str, times) -> Power:
    sizes, seconds = np.array(sorted(times)).T
    return Power(name, sizes, seconds, *slope(sizes, seconds))
