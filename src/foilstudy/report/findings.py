"""What the tables say, in sentences: every number here is read from them, none is assumed."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
import xarray as xr

from foilstudy.reference import Published
from foilstudy.report.health import STATUSES, Health, Spread
from foilstudy.report.numerals import (
    fixed,
    nominal,
    number,
    number_range,
    percent,
    percent_range,
    plural,
    signed,
    stiffness,
    times,
)
from foilstudy.statistics import fit_variability
from foilstudy.statistics.powerlaw import NORMAL_95

SOURCES = {
    "simulation": "This study",
    "simulation_refined": "This study, refined mesh",
    "published_simulation": "Published simulation",
    "published_experiment": "Published experiment",
}
"""Sources of a power law, in the order of the table, with their names."""

SIGNIFICANT = 0.05
"""Probability below which a departure is not left to chance."""


@dataclass(frozen=True)
class Exponent:
    """One coefficient of a power law, its standard error and its 95 % interval."""

    value: float
    std_error: float
    low: float
    high: float

    @property
    def known(self) -> bool:
        """Whether the sweep determines the coefficient."""
        return math.isfinite(self.value)

    @property
    def margin(self) -> str:
        """Half width of the 95 % interval; empty when the sample leaves none."""
        half = (self.high - self.low) / 2
        return f" ± {fixed(half)}" if math.isfinite(half) else ""

    @property
    def interval(self) -> str:
        """The 95 % interval in brackets; empty when the sample leaves none."""
        if not math.isfinite(self.low):
            return ""
        return f"[{fixed(self.low)}, {fixed(self.high)}]"

    @property
    def effect(self) -> str:
        """What the stiffness does as the regressor grows, up to the power of the regressor."""
        if math.isfinite(self.low) and self.low <= 0 <= self.high:
            return "shows no clear trend with"
        return "grows as" if self.value > 0 else "falls as"


@dataclass(frozen=True)
class Law:
    """``k = exp(alpha) (overlength/%)^beta (thickness/um)^gamma`` with `k` in N/m."""

    source: str
    name: str
    alpha: Exponent
    beta: Exponent
    gamma: Exponent
    r2: float
    n: float
    note: str
    differences: str = ""

    @property
    def known(self) -> bool:
        """Whether there was anything to fit."""
        return self.alpha.known

    @property
    def level(self) -> float:
        """Stiffness [N/m] of a law without any exponent: the mean of one configuration."""
        return math.exp(self.alpha.value)

    def stiffness(self, overlength_percent: float, thickness_um: float) -> float:
        """Stiffness [N/m]; an undetermined exponent counts as zero."""
        beta = self.beta.value if self.beta.known else 0.0
        gamma = self.gamma.value if self.gamma.known else 0.0
        return math.exp(
            self.alpha.value
            + beta * math.log(overlength_percent)
            + gamma * math.log(thickness_um)
        )


@dataclass(frozen=True)
class DirectionLaws:
    """The laws of one direction; ``simulation`` is the one that answers."""

    direction: str
    laws: tuple[Law, ...]

    @property
    def simulation(self) -> Law:
        """This study's law on the crumpled mesh."""
        return next(law for law in self.laws if law.source == "simulation")


def read_laws(powerlaw: pd.DataFrame, summary: pd.DataFrame) -> tuple[DirectionLaws, ...]:
    """Read the laws of each direction and put their differences into words.

    Parameters
    ----------
    powerlaw, summary
        Tables ``powerlaw.csv`` and ``stiffness_summary.csv``.
    """
    directions = []
    for direction in powerlaw["direction"].unique():
        rows = powerlaw[powerlaw["direction"] == direction].set_index("source")
        cells = summary[summary["direction"] == direction]
        present = [source for source in SOURCES if source in rows.index]
        laws = {source: _law(source, rows.loc[source]) for source in present}
        ours = laws["simulation"]
        named = [
            law if law is ours else _with_differences(ours, law, cells) for law in laws.values()
        ]
        directions.append(DirectionLaws(str(direction), tuple(named)))
    return tuple(directions)


def _law(source: str, row: pd.Series) -> Law:
    coefficients = {
        name: Exponent(*(float(row[f"{name}{part}"]) for part in ("", "_se", "_low", "_high")))
        for name in ("alpha", "beta", "gamma")
    }
    note = row["note"] if isinstance(row["note"], str) else ""
    return Law(source, SOURCES[source], **coefficients, r2=row["r2"], n=row["n"], note=note)


def _with_differences(ours: Law, other: Law, cells: pd.DataFrame) -> Law:
    """Say how the other law differs from ours, and by how much at the middle of the sweep."""
    if not (ours.known and other.known):
        return other
    words = [
        text
        for name in ("beta", "gamma")
        if (text := _difference(name, getattr(ours, name), getattr(other, name)))
    ]
    middle = _geometric_mean(cells["overlength_percent"]), _geometric_mean(cells["thickness_um"])
    ratio = other.stiffness(*middle) / ours.stiffness(*middle)
    words.append(f"{number(ratio, 2)} times as stiff mid-sweep")
    return replace(other, differences="; ".join(words))


def middle_of_sweep(summary: pd.DataFrame) -> str:
    """Name the point of the sweep at which the levels of two laws are compared."""
    overlength = _geometric_mean(summary["overlength_percent"])
    thickness = _geometric_mean(summary["thickness_um"])
    return f"{number(thickness)} µm and {number(overlength)} %"


def _difference(name: str, ours: Exponent, other: Exponent) -> str:
    symbol = {"beta": "β", "gamma": "γ"}[name]
    if not (ours.known and other.known):
        return ""
    change = other.value - ours.value
    margin = NORMAL_95 * math.hypot(ours.std_error, other.std_error)
    if not math.isfinite(margin):
        return f"{symbol} differs by {signed(change)}"
    if abs(change) <= margin:
        return f"{symbol} agrees ({signed(change)} ± {fixed(margin)})"
    word = "steeper" if abs(other.value) > abs(ours.value) else "flatter"
    return f"{symbol} {word} by {fixed(abs(change))} ± {fixed(margin)}"


def _geometric_mean(values: pd.Series) -> float:
    return float(np.exp(np.log(values.unique()).mean()))


def stiffness_findings(summary: pd.DataFrame) -> list[str]:
    """Say what the static stiffness table shows, one paragraph per direction.

    Parameters
    ----------
    summary
        Table ``stiffness_summary.csv``.
    """
    paragraphs = []
    for direction, cells in _measured(summary, "mean"):
        low, high = cells.loc[cells["mean"].idxmin()], cells.loc[cells["mean"].idxmax()]
        text = (
            f"The {direction} stiffness, mean of the realisations, runs from "
            f"{stiffness(low['mean'])} ({_case(low)}) to {stiffness(high['mean'])} ({_case(high)})"
        )
        bound = Spread.of(cells["mean"] / cells["cylinder_bound"])
        if bound:
            text += (
                f", {percent_range(bound.lowest, bound.highest)} of the uncrumpled cylinder's"
            )
        clauses = [clause for clause in (_beside_published(cells), _monotone(cells)) if clause]
        if clauses:
            text += f"; it {'; it '.join(clauses)}"
        paragraphs.append(f"{text}.")
    return paragraphs + _axial_below_radial(summary)


def _beside_published(cells: pd.DataFrame) -> str:
    ratios = [
        f"{number_range(spread.lowest, spread.highest)} times the published {name}"
        for name in ("simulation", "experiment")
        if (spread := Spread.of(cells[f"ratio_{name}"]))
    ]
    return f"is {' and '.join(ratios)}" if ratios else ""


def _monotone(cells: pd.DataFrame) -> str:
    """Count the steps between neighbouring configurations that follow the trend."""
    grid = cells.pivot(index="thickness_um", columns="overlength_percent", values="mean")
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
    grid = summary.pivot(index=keys, columns="direction", values="mean").dropna()
    if not {"axial", "radial"} <= set(grid.columns) or grid.empty:
        return []
    below = int((grid["axial"] < grid["radial"]).sum())
    return [
        f"The axial stiffness is below the radial one in {below} of "
        f"{plural(len(grid), 'configuration')}."
    ]


def prestress_findings(cube: xr.Dataset) -> list[str]:
    """Say what the stress that crumpling leaves does to the stiffness.

    Parameters
    ----------
    cube
        The study's result cube.
    """
    if "prestressed_stiffness" not in cube:
        return []
    ratio = cube["prestressed_stiffness"] / cube["static_stiffness"]
    spreads = {str(d): Spread.of(ratio.sel(direction=d)) for d in cube["direction"].values}
    parts = [
        f"{number_range(spread.lowest, spread.highest)} times in the {direction} "
        f"direction (median {number(spread.median, 2)})"
        for direction, spread in spreads.items()
        if spread
    ]
    if not parts:
        return []
    return [
        "All stiffnesses here belong to the stress-free crumpled shape, as in the published work; "
        f"with the stress left in, the stiffness is {' and '.join(parts)} that value."
    ]


def variability_findings(variability: pd.DataFrame) -> list[str]:
    """Say how much the stiffness scatters over the realisations, and whether it has a trend.

    Parameters
    ----------
    variability
        Table ``variability.csv``.
    """
    sentences, medians = [], {}
    for direction, cells in _measured(variability, "cv"):
        spread = Spread.of(cells["cv"])
        medians[direction] = spread.median
        fit = fit_variability(variability, direction)
        slope, low, high = (
            1000 * part["overlength"] for part in (fit.value, fit.low, fit.high)
        )
        text = (
            f"The {direction} coefficient of variation is "
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
        sentences.append(f"The axial stiffness scatters {more} than the radial one (medians).")
    if not sentences:
        sentences = ["Scatter needs at least two usable realisations of one configuration."]
    return sentences


def dynamic_findings(cube: xr.Dataset) -> list[str]:
    """Say how the dynamic stiffness starts, and how the overlengths compare at high frequency.

    Parameters
    ----------
    cube
        The study's result cube; its ``transfer`` dynamic stiffness is used.
    """
    if "dynamic_stiffness_re" not in cube:
        return []
    transfer = np.hypot(
        cube["dynamic_stiffness_re"].sel(definition="transfer"),
        cube["dynamic_stiffness_im"].sel(definition="transfer"),
    )
    frequency = cube["frequency"].values
    sentences = []
    start = Spread.of(np.abs(transfer.isel(frequency=0) / cube["static_stiffness"] - 1))
    if start:
        sentences.append(
            f"At {nominal(frequency[0])} Hz the magnitude of the transfer stiffness differs from "
            f"the static stiffness by {percent(start.highest)} at most "
            f"(median {percent(start.median)})."
        )
    top = frequency >= frequency[-1] / 2
    thickest = transfer.isel(thickness=-1)
    for direction in map(str, cube["direction"].values):
        curves = thickest.sel(direction=direction)
        before = _ratio_of_extremes(curves.isel(frequency=0))
        after = _ratio_of_extremes(np.exp(np.log(curves.isel(frequency=top)).mean("frequency")))
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
        sentences.append(
            f"With both rings clamped the first eigenfrequency lies between "
            f"{number(spread.lowest)} and {number(spread.highest)} Hz."
        )
    exponents = []
    for row in law[law["exponent"].notna()].itertuples():
        exponent = Exponent(row.exponent, row.exponent_se, row.exponent_low, row.exponent_high)
        text = f"{fixed(exponent.value)}{exponent.margin} at {nominal(row.thickness_um)} µm"
        if math.isfinite(row.published_exponent):
            text += f" (published {fixed(row.published_exponent)})"
        exponents.append(text)
    if exponents:
        sentences.append(
            f"It follows the reference height with the exponent {', '.join(exponents)}."
        )
    elif spread:
        sentences.append("One reference height alone determines no exponent.")
    return sentences


def bend_sentence(powerlaw: pd.DataFrame) -> str:
    """Warn when the configurations depart from the law; empty when none is known to.

    Parameters
    ----------
    powerlaw
        Table ``powerlaw.csv``.
    """
    bent = [
        f"{row.direction} p {_probability(row.lack_of_fit_p)}"
        for row in _ours(powerlaw).itertuples()
        if row.lack_of_fit_p < SIGNIFICANT
    ]
    if not bent:
        return ""
    return (
        "A single power law is an approximation: the configurations depart from it by more than "
        f"their own scatter explains (lack of fit, {', '.join(bent)}), so the intervals above are "
        "too narrow."
    )


def fit_findings(powerlaw: pd.DataFrame) -> list[str]:
    """Say how well the law describes the realisations, and what it leaves.

    Parameters
    ----------
    powerlaw
        Table ``powerlaw.csv``.
    """
    sentences = []
    for row in _ours(powerlaw).itertuples():
        if not math.isfinite(row.residual_std):
            continue
        text = (
            f"Realisations scatter about the {row.direction} law by a factor "
            f"{fixed(math.exp(row.residual_std))} (one standard deviation)"
        )
        if math.isfinite(row.lack_of_fit_p):
            text += f"; lack of fit p {_probability(row.lack_of_fit_p)}"
        if row.lack_of_fit_p < SIGNIFICANT:
            errors = [
                f"{fixed(error)} for {symbol}"
                for symbol, error in (
                    ("β", row.beta_se_clustered),
                    ("γ", row.gamma_se_clustered),
                )
                if math.isfinite(error)
            ]
            text += f"; standard errors that allow for it are {' and '.join(errors)}"
        sentences.append(f"{text}.")
    return sentences


def _ours(powerlaw: pd.DataFrame) -> pd.DataFrame:
    return powerlaw[powerlaw["source"] == "simulation"]


def _probability(p: float) -> str:
    return "below 0.001" if p < 1e-3 else f"= {number(p, 2)}"


def shape_findings(cube: xr.Dataset, reference: Published) -> list[str]:
    """Say how far the crumpled sheets leave the cylinder.

    Parameters
    ----------
    cube
        The study's result cube.
    reference
        The published results.
    """
    lowest = Spread.of(cube["radial_displacement_min"])
    highest = Spread.of(cube["radial_displacement_max"])
    if not (lowest and highest):
        return ["No realisation left a shape."]
    published_low, published_high = reference.radial_displacement_range_mm
    return [
        f"Over all realisations the radial displacement runs from {signed(lowest.lowest, 0)} mm "
        f"(inward) to {signed(highest.highest, 0)} mm (outward); published: "
        f"{signed(published_low, 0)} to {signed(published_high, 0)} mm."
    ]


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


def mesh_sentence(health: Health, refinements: int, directions: Sequence[str]) -> str:
    """Say by how much the refined mesh changes the stiffness of the same shapes."""
    parts = []
    for direction in directions:
        change = health.mesh_change_overall(direction)
        if change is None:
            continue
        if change.highest <= 0:
            extent = f"{percent_range(-change.highest, -change.lowest)} lower"
        elif change.lowest >= 0:
            extent = f"{percent_range(change.lowest, change.highest)} higher"
        else:
            extent = f"{percent(-change.lowest)} lower to {percent(change.highest)} higher"
        parts.append(f"the {direction} stiffness is {extent}")
    if not parts:
        return "The mesh error of the stiffness was not measured."
    text = f"On the {times(refinements)} refined mesh {' and '.join(parts)} for the same shapes"
    thickness = health.most_mesh_dependent_thickness_um
    return f"{text}, most at {nominal(thickness)} µm." if thickness else f"{text}."


def _measured(table: pd.DataFrame, column: str):
    """Go through the directions, with the rows that hold a number."""
    for direction in table["direction"].unique():
        cells = table[(table["direction"] == direction) & table[column].notna()]
        if len(cells):
            yield direction, cells


def _case(row: pd.Series) -> str:
    return f"{nominal(row['thickness_um'])} µm, {nominal(row['overlength_percent'])} %"
