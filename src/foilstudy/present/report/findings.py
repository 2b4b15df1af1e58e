"""What the tables say, in sentences: every number here is read from them, none is assumed."""

import math

import numpy as np
import pandas as pd
import xarray as xr

from foilstudy.base.numerals import (
    fixed,
    nominal,
    number,
    number_range,
    percent,
    percent_range,
    plural,
    signed,
    stiffness,
)
from foilstudy.base.outcome import STATUSES
from foilstudy.base.reference import Published
from foilstudy.present.report.health import Health
from foilstudy.present.report.laws import Exponent
from foilstudy.present.report.spread import Spread
from foilstudy.present.statistics.regression import SIGNIFICANT
from foilstudy.present.statistics.summary import best_mean
from foilstudy.present.statistics.variability import fit_variability, plain_scatter


def stiffness_findings(summary: pd.DataFrame) -> list[str]:
    """Say what the static stiffness table shows, one paragraph per direction.

    Of configurations that are not trusted it says no more than how large the stiffness comes out,
    and that only where there are no others.

    Parameters
    ----------
    summary
        Table ``stiffness_summary.csv``.
    """
    summary = summary.assign(best=best_mean(summary))
    mesh = mesh_words(summary)
    paragraphs = []
    for direction, cells in _measured(summary, "best"):
        trusted = cells[cells["trusted"].astype(bool)]
        shown = trusted if len(trusted) else cells
        low, high = shown.loc[shown["best"].idxmin()], shown.loc[shown["best"].idxmax()]
        text = (
            f"The {direction} stiffness {mesh}, mean of the realisations{_share(trusted, cells)}, "
            f"runs from {stiffness(low['best'])} ({_case(low)}) to {stiffness(high['best'])} "
            f"({_case(high)})"
        )
        bound = Spread.of(trusted["best"] / trusted["cylinder_bound"])
        if bound:
            text += f", {percent_range(bound.lowest, bound.highest)} of the uncrumpled cylinder's"
        clauses = [clause for clause in (_beside_published(trusted), _monotone(trusted)) if clause]
        if clauses:
            text += f"; it {'; it '.join(clauses)}"
        paragraphs.append(f"{text}.")
    return paragraphs + _axial_below_radial(summary)


def _share(trusted: pd.DataFrame, cells: pd.DataFrame) -> str:
    """Name the configurations that a finding is of, where these are not all."""
    if len(trusted) == len(cells):
        return ""
    if not len(trusted):
        return f" in {plural(len(cells), 'configuration')}, none of them trusted"
    return f" in the {len(trusted)} of {len(cells)} configurations that are trusted"


def mesh_words(summary: pd.DataFrame) -> str:
    """Say on which mesh the best stiffness is known."""
    stated = summary["mesh_error_mean"].notna()
    if stated.all():
        return "in the mesh limit"
    return "in the mesh limit where it is known" if stated.any() else "on the crumpled mesh"


def _beside_published(cells: pd.DataFrame) -> str:
    ratios = [
        f"{number_range(spread.lowest, spread.highest)} times the published {name}"
        for name in ("simulation", "experiment")
        if f"published_{name}" in cells
        and (spread := Spread.of(cells["best"] / cells[f"published_{name}"]))
    ]
    return f"is {' and '.join(ratios)}" if ratios else ""


def _monotone(cells: pd.DataFrame) -> str:
    """Count the steps between neighbouring configurations that follow the trend."""
    grid = cells.pivot(index="thickness_um", columns="overlength_percent", values="best")
    along_overlength = grid.diff(axis=1).to_numpy()
    along_thickness = grid.diff(axis=0).to_numpy()
    parts = [
        f"{verb} in {follows.sum()} of {plural(int(steps), 'step')} of the {name}"
        for name, verb, follows, steps in (
            ("overlength", "falls", along_overlength < 0, np.isfinite(along_overlength).sum()),
            ("thickness", "grows", along_thickness > 0, np.isfinite(along_thickness).sum()),
        )
        if steps
    ]
    return " and ".join(parts)


def _axial_below_radial(summary: pd.DataFrame) -> list[str]:
    keys = ["thickness_um", "overlength_percent"]
    trusted = summary[summary["trusted"].astype(bool)]
    grid = trusted.pivot(index=keys, columns="direction", values="best").dropna()
    if not {"axial", "radial"} <= set(grid.columns) or grid.empty:
        return []
    below = int((grid["axial"] < grid["radial"]).sum())
    return [
        f"The axial stiffness is below the radial one in {below} of "
        f"{plural(len(grid), 'trusted configuration')}."
    ]


def variability_findings(variability: pd.DataFrame) -> list[str]:
    """Say how much the stiffness scatters over the realisations, and whether it has a trend.

    Parameters
    ----------
    variability
        Table ``variability.csv``.
    """
    sentences, medians = [], {}
    for direction, cells in _measured(plain_scatter(variability), "cv"):
        spread = Spread.of(cells["cv"])
        medians[direction] = spread.median
        fit = fit_variability(variability, direction)
        slope, low, high = (1000 * part["overlength"] for part in (fit.value, fit.low, fit.high))
        text = (
            f"The {direction} coefficient of variation on the crumpled mesh is "
            f"{percent_range(spread.lowest, spread.highest)}, median {percent(spread.median)}"
        )
        if math.isfinite(low):
            trend = "it rises" if slope > 0 else "it falls"
            if low <= 0 <= high:
                trend = "it shows no clear trend"
            text += (
                f"; with overlength {trend}, {signed(slope, 1)} percentage points per 10 % "
                f"(95 %: {signed(low, 1)} to {signed(high, 1)})"
            )
        sentences.append(f"{text}.")
    if {"axial", "radial"} <= set(medians):
        more = "more" if medians["axial"] > medians["radial"] else "less"
        sentences.append(f"In the median the axial stiffness scatters {more} than the radial one.")
    if not sentences:
        sentences = ["Scatter needs at least two usable realisations of one configuration."]
    return sentences


def dynamic_findings(cube: xr.Dataset) -> list[str]:
    """Say how the dynamic stiffness starts, and how the overlengths compare at high frequency.

    Parameters
    ----------
    cube
        The study's result cube; its ``relative`` dynamic stiffness is used, the published
        definition.
    """
    relative = np.abs(cube["dynamic_stiffness"].sel(definition="relative"))
    frequency = cube["frequency"].values
    sentences = []
    start = Spread.of(np.abs(relative.isel(frequency=0) / cube["static_stiffness"] - 1))
    if start:
        sentences.append(
            f"At {nominal(frequency[0])} Hz the magnitude of the relative stiffness differs from "
            f"the static stiffness by {percent(start.highest)} at most "
            f"(median {percent(start.median)})."
        )
    top = frequency >= frequency[-1] / 2
    thickest = relative.isel(thickness=-1)
    for direction in map(str, cube["direction"].values):
        curves = thickest.sel(direction=direction)
        before = _ratio_of_extremes(curves.isel(frequency=0))
        after = _ratio_of_extremes(
            np.exp(np.log(curves.isel(frequency=top)).mean("frequency", skipna=False))
        )
        if before and after and cube.sizes["overlength"] > 1:
            sentences.append(
                f"At {nominal(float(cube['thickness'][-1]))} µm the stiffest and the softest "
                f"overlength differ by a factor {number(before, 2)} at {nominal(frequency[0])} Hz "
                f"and {number(after, 2)} between {nominal(frequency[top][0])} and "
                f"{nominal(frequency[-1])} Hz ({direction}, geometric means)."
            )
    return sentences


def _ratio_of_extremes(values: xr.DataArray) -> float | None:
    spread = Spread.of(np.exp(np.log(values).mean("seed")))
    return spread.highest / spread.lowest if spread and spread.lowest > 0 else None


def eigenfrequency_findings(law: pd.DataFrame, cube: xr.Dataset) -> list[str]:
    """Say where the first eigenfrequencies lie and how they follow the reference height.

    Parameters
    ----------
    law
        Table ``eigenfrequency_law.csv``.
    cube
        The study's result cube.
    """
    sentences = []
    spread = Spread.of(cube["first_eigenfrequency"])
    if spread:
        low, high = number(spread.lowest), number(spread.highest)
        lies = f"is {low} Hz" if low == high else f"lies between {low} and {high} Hz"
        sentences.append(f"With both rings clamped the first eigenfrequency {lies}.")
    exponents = []
    for row in law[law["exponent"].notna()].itertuples():
        exponent = Exponent(row.exponent, row.exponent_low, row.exponent_high)
        text = f"{fixed(exponent.value)}{exponent.margin} at {nominal(row.thickness_um)} µm"
        published = getattr(row, "published_exponent", math.nan)
        if math.isfinite(published):
            text += f" (published {fixed(published)}{_side(exponent, published)})"
        exponents.append(text)
    if exponents:
        sentences.append(
            f"It goes with the reference height to the power of {', '.join(exponents)}"
            f"{'; ± is the 95 % interval' if law['exponent_low'].notna().any() else ''}."
        )
        bent = law.loc[law["lack_of_fit_p"] < SIGNIFICANT, "thickness_um"]
        if len(bent):
            sentences.append(
                f"At {', '.join(map(nominal, bent))} µm the heights depart from a power law by "
                "more than seeds explain, which the interval allows for (clustered by height)."
            )
    elif spread:
        sentences.append("One reference height alone determines no exponent.")
    return sentences


def _side(exponent: Exponent, published: float) -> str:
    """Whether a published exponent lies in the interval of ours; empty without an interval."""
    if not math.isfinite(exponent.low):
        return ""
    inside = exponent.low <= published <= exponent.high
    return ", inside the interval" if inside else ", outside it"


def shape_findings(cube: xr.Dataset, reference: Published | None) -> list[str]:
    """Say how far the crumpled sheets leave the cylinder.

    Parameters
    ----------
    cube
        The study's result cube.
    reference
        The published results, where the study is of their case.
    """
    lowest = Spread.of(cube["radial_displacement_min"])
    highest = Spread.of(cube["radial_displacement_max"])
    if not (lowest and highest):
        return ["No realisation left a shape."]
    text = (
        f"Over all realisations the radial displacement runs from {signed(lowest.lowest, 0)} mm "
        f"(inward) to {signed(highest.highest, 0)} mm (outward)"
    )
    if reference:
        low, high = reference.radial_displacement_range_mm
        text += f"; published: {signed(low, 0)} to {signed(high, 0)} mm"
    return [f"{text}."]


def health_sentence(health: Health) -> str:
    """Say in one line how many realisations converged, and what became of the others."""
    converged = health.counts["converged"]
    text = f"{converged} of {plural(health.total, 'realisation')} converged"
    others = [
        f"{health.counts[status]} {status.replace('_', ' ')}"
        for status in STATUSES[1:]
        if health.counts[status]
    ]
    return f"{text}; {', '.join(others)}." if others else f"{text}."


def _measured(table: pd.DataFrame, column: str):
    """Go through the directions, with the rows that hold a number."""
    for direction in table["direction"].unique():
        cells = table[(table["direction"] == direction) & table[column].notna()]
        if len(cells):
            yield direction, cells


def _case(row: pd.Series) -> str:
    return f"{nominal(row['thickness_um'])} µm, {nominal(row['overlength_percent'])} %"
