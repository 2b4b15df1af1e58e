"""What the stress that crumpling leaves does to the stiffness, its law and its scatter."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr

from foilstudy.base.numerals import fixed, nominal, number, number_range, percent, plural
from foilstudy.present.comparison import comparable
from foilstudy.present.report.laws import DirectionLaws
from foilstudy.present.report.spread import Spread, by_direction, by_thickness
from foilstudy.present.statistics.cells import energy_left, measured, realised
from foilstudy.present.statistics.powerlaw import PRESTRESSED, SIMULATED

_FREE, _STRESSED = SIMULATED["simulation"], SIMULATED[PRESTRESSED]
_AGAIN = SIMULATED["simulation pre-stressed refined"]


@dataclass(frozen=True)
class PrestressRow:
    """Stiffness with the stress left in, one direction and thickness.

    Attributes
    ----------
    ratio : Spread
        Over the stress-free stiffness of the same shape on the same mesh.
    cv_free, cv : float
        Median over the overlengths of the coefficient of variation, stress-free and pre-stressed.
    n, not_positive : int
        Values, and those that are negative or zero.
    """

    direction: str
    thickness_um: float
    ratio: Spread
    cv_free: float
    cv: float
    n: int
    not_positive: int


@dataclass(frozen=True)
class RelaxedRow:
    """What relaxing again on refined meshes changes at one thickness, as ratios.

    Attributes
    ----------
    n : int
        Realisations that settled again.
    energy : Spread
        Strain energy over that on the crumpled mesh.
    stress_free : mapping of direction to Spread or None
        Stress-free stiffness of the new shape over the mesh limit of the crumpled one.
    prestressed : mapping of direction to Spread or None
        Over the pre-stressed stiffness on the crumpled mesh.
    """

    thickness_um: float
    n: int
    energy: Spread
    stress_free: dict[str, Spread | None]
    prestressed: dict[str, Spread | None]


def prestress_rows(cube: xr.Dataset, variability: pd.DataFrame) -> list[PrestressRow]:
    """Read the effect of the stress per direction and thickness; empty without pre-stress.

    Parameters
    ----------
    cube
        The study's result cube.
    variability
        Table ``variability.csv``.
    """
    if _STRESSED not in cube:
        return []
    ratios = by_direction(measured(cube, _STRESSED) / measured(cube, _FREE))
    rows = []
    for direction, spreads in ratios.items():
        for thickness, ratio in spreads.items():
            here = (variability["direction"] == direction) & np.isclose(
                variability["thickness_um"], thickness, rtol=1e-5
            )
            free, stressed = (
                variability[here & (variability["quantity"] == q)] for q in (_FREE, _STRESSED)
            )
            rows.append(
                PrestressRow(
                    direction,
                    thickness,
                    ratio,
                    free["cv"].median(),
                    stressed["cv"].median(),
                    int(stressed["n"].sum()),
                    int(stressed["n_not_positive"].sum()),
                )
            )
    return rows


def relaxed_rows(cube: xr.Dataset) -> list[RelaxedRow]:
    """Read what relaxing again on refined meshes changes; empty where the study did not."""
    if "refined_strain_energy" not in cube:
        return []
    energies = by_thickness(cube["refined_strain_energy"] / energy_left(cube))
    stress_free = cube["refined_static_stiffness"] / cube["static_stiffness_converged"]
    prestressed = cube[_AGAIN] / cube[_STRESSED]
    return [
        RelaxedRow(
            thickness,
            int(np.isfinite(cube["refined_strain_energy"].sel(thickness=thickness)).sum()),
            energy,
            *(
                {
                    str(d): Spread.of(ratio.sel(thickness=thickness, direction=d))
                    for d in cube["direction"].values
                }
                for ratio in (stress_free, prestressed)
            ),
        )
        for thickness, energy in energies.items()
    ]


def prestress_findings(
    cube: xr.Dataset, variability: pd.DataFrame, directions: Sequence[DirectionLaws]
) -> list[str]:
    """Say what the stress does to the stiffness, its law and its scatter, in paragraphs.

    Parameters
    ----------
    cube
        The study's result cube.
    variability
        Table ``variability.csv``.
    directions
        The laws, from `foilstudy.present.report.laws.read_laws`.
    """
    rows = prestress_rows(cube, variability)
    if not rows:
        return ["This cube holds no pre-stressed stiffness."]
    paragraphs = [_ratios(cube), _laws(directions), _scatter(cube, variability, directions)]
    return [text for text in paragraphs if text]


def relaxed_findings(cube: xr.Dataset) -> list[str]:
    """Say how relaxing again on refined meshes changes energy and stiffness, in sentences."""
    rows = relaxed_rows(cube)
    if not rows:
        return []
    size, n = cube["refined_element_size"].min(), sum(row.n for row in rows)
    sentences = [
        f"Relaxed again on a mesh of {nominal(float(size))} mm, {n} of "
        f"{plural(int(realised(cube).sum()), 'realisation')} settled "
        f"(largest residual {number(float(cube['refined_residual'].max()), 2)}, "
        f"{int((cube['refined_negative_eigenvalues'] > 0).sum())} with a negative eigenvalue)."
    ]
    for row in rows:
        stiffness = [
            f"the {direction} stiffness by {_factor(row.stress_free[direction])} stress-free and "
            f"{_factor(row.prestressed[direction])} pre-stressed"
            for direction in row.prestressed
        ]
        sentences.append(
            f"At {nominal(row.thickness_um)} µm this multiplies the strain energy by "
            f"{_factor(row.energy)}, {' and '.join(stiffness)} (medians)."
        )
    step = cube["prestressed_stiffness_mesh_error"] / np.abs(cube[_AGAIN])
    parts = [
        f"{percent(spread.median)} of the {direction} value"
        for direction in map(str, cube["direction"].values)
        if (spread := Spread.of(step.sel(direction=direction)))
    ]
    if parts:
        sentences.append(
            "The last step from mesh to mesh, the stated error of the pre-stressed stiffness, is "
            f"{' and '.join(parts)} (medians)."
        )
    return sentences


def _factor(spread: Spread | None) -> str:
    return number(spread.median, 2) if spread else "an unknown factor"


def _ratios(cube: xr.Dataset) -> str:
    parts, hidden = [], []
    ratio = measured(cube, _STRESSED) / measured(cube, _FREE)
    for direction in map(str, cube["direction"].values):
        spread = Spread.of(ratio.sel(direction=direction))
        if not spread:
            continue
        parts.append(
            f"{number_range(spread.lowest, spread.highest)} times in the {direction} direction "
            f"(median {number(spread.median, 2)})"
        )
        values = measured(cube, _STRESSED, direction=direction)
        count, n = int((values <= 0).sum()), int(np.isfinite(values).sum())
        if count:
            hidden.append(f"{count} of {n} {direction} values")
    text = (
        "All other stiffnesses here belong to the stress-free crumpled shape; with the stress left "
        f"in, the stiffness is {' and '.join(parts)} that value, same shape and mesh."
    )
    if not hidden:
        return f"{text} Every pre-stressed value is positive."
    return (
        f"{text} Not positive are {' and '.join(hidden)}: the shape is held by the rings alone. "
        "They enter the scatter, but not the power law, which needs a logarithm."
    )


def _laws(directions: Sequence[DirectionLaws]) -> str:
    parts = []
    for item in directions:
        law = item.law(PRESTRESSED)
        if item.answer and law and (law.beta.known or law.gamma.known):
            exponents = [
                f"{symbol} = {fixed(exponent.value)}{exponent.margin}"
                for symbol, exponent in (("β", law.beta), ("γ", law.gamma))
                if exponent.known
            ]
            fit = f" (R² = {fixed(law.r2, 3)}, n = {law.n:.0f})" if math.isfinite(law.r2) else ""
            parts.append(f"{item.direction} {', '.join(exponents)}{fit}")
    if not parts:
        return ""
    return (
        "Power law with the stress left in, of all configurations on the crumpled mesh: "
        f"{'; '.join(parts)}."
    )


def _scatter(
    cube: xr.Dataset, variability: pd.DataFrame, directions: Sequence[DirectionLaws]
) -> str:
    sentences = []
    for item in directions:
        rows = variability[variability["direction"] == item.direction]
        free, stressed = (
            rows.loc[rows["quantity"] == q, "cv"].median() for q in (_FREE, _STRESSED)
        )
        if not math.isfinite(stressed):
            continue
        text = (
            f"The {item.direction} coefficient of variation, median of the configurations, is "
            f"{percent(stressed)} pre-stressed and {percent(free)} stress-free"
        )
        law = item.law(PRESTRESSED)
        implied = _implied_scatter(cube, item.direction)
        if law and math.isfinite(law.residual_std):
            factors = [fixed(math.exp(s)) for s in (law.residual_std, item.plain.residual_std)]
            text += (
                f"; about their laws scatter the pre-stressed stiffness by a factor {factors[0]}, "
                f"the stress-free one by {factors[1]}"
            )
            if math.isfinite(implied):
                text += f", the published experiment by about {fixed(math.exp(implied))}"
        sentences.append(f"{text}.")
    if any("published experiment" in sentence for sentence in sentences):
        sentences.append(
            "No coefficient of variation of the experiment is at hand; its scatter is what its R² "
            "implies for the thicknesses and overlengths of this study."
        )
    return " ".join(sentences)


def _implied_scatter(cube: xr.Dataset, direction: str) -> float:
    """Standard deviation of ln k about the published experiment's law, from its R².

    With R² = explained / (explained + residual) variance, over the grid of this study. NaN where
    there is nothing published to compare with.
    """
    reference = comparable(cube)
    if reference is None:
        return math.nan
    experiment = reference.power_laws[direction]["experiment"]
    fitted = np.log(
        experiment.law.stiffness(cube["overlength"].values, cube["thickness"].values[:, None])
    )
    variance = np.var(fitted)
    return math.sqrt(variance * (1 - experiment.r2) / experiment.r2) if variance > 0 else math.nan
