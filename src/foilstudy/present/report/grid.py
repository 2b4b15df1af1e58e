"""The stiffness of every configuration in a small table of each direction."""

from __future__ import annotations

import math
from dataclasses import dataclass

import pandas as pd

from foilstudy.base.numerals import nominal, number, percent, plural
from foilstudy.present.report.findings import mesh_words
from foilstudy.present.report.spread import Spread
from foilstudy.present.statistics.summary import best_mean

CASES_SHOWN = 3
"""Configurations that a sentence names."""


@dataclass(frozen=True)
class Cell:
    """One configuration in one direction.

    Attributes
    ----------
    mean : float
        N/m: in the mesh limit, or on the crumpled mesh where no mesh error is stated.
    scatter : float
        Coefficient of variation over the realisations; NaN of a single one.
    mesh_error : float
        Largest stated error of a realisation over its value; NaN where none is stated.
    n : int
        Realisations.
    trusted : bool
    low, high : float
        95 % interval of `mean`, N/m; NaN of a single value.
    half_width : float
        Half of it over the mean; infinite of a single value.
    takes : float
        Realisations that the scatter takes for the half width that the study wished for; NaN where
        it did not.
    """

    overlength_percent: float
    mean: float
    scatter: float
    mesh_error: float
    n: int
    trusted: bool
    low: float
    high: float
    half_width: float
    takes: float


@dataclass(frozen=True)
class Row:
    """One thickness."""

    thickness_um: float
    cells: tuple[Cell, ...]


@dataclass(frozen=True)
class Grid:
    """One direction."""

    direction: str
    rows: tuple[Row, ...]

    @property
    def counts_differ(self) -> bool:
        """Whether the configurations have different numbers of realisations."""
        return len({cell.n for row in self.rows for cell in row.cells}) > 1

    @property
    def wished(self) -> bool:
        """Whether the study wished for a half width of the intervals."""
        return any(not math.isnan(cell.takes) for row in self.rows for cell in row.cells)

    @property
    def overlengths_percent(self) -> list[float]:
        """Of the columns."""
        return [cell.overlength_percent for cell in self.rows[0].cells]


def stiffness_grids(summary: pd.DataFrame) -> tuple[Grid, ...]:
    """Read the tables from ``stiffness_summary.csv``, a grid for each direction."""
    table = summary.assign(best=best_mean(summary))
    stated = table["mesh_error_mean"].notna()
    table["best_std"] = table["mesh_limit_std"].where(stated, table["std"])
    grids = []
    for direction, cells in table.groupby("direction", sort=False):
        rows = tuple(
            Row(float(thickness), tuple(map(_cell, foils.itertuples())))
            for thickness, foils in cells.groupby("thickness_um")
        )
        grids.append(Grid(str(direction), rows))
    return tuple(grids)


def _cell(row) -> Cell:
    return Cell(
        float(row.overlength_percent),
        float(row.best),
        float(row.best_std / row.best),
        float(row.mesh_error_share_max),
        int(row.n),
        bool(row.trusted),
        float(row.best_low),
        float(row.best_high),
        float(row.best_half_width),
        float(row.wish_takes),
    )


def grid_caption(summary: pd.DataFrame) -> str:
    """Say what the numbers of a cell are, and how many realisations stand behind them."""
    counts = sorted(set(summary["n"]))
    n = " to ".join(dict.fromkeys(str(int(count)) for count in (counts[0], counts[-1])))
    return (
        f"Mean stiffness of n = {n} realisations {mesh_words(summary)}; scatter: standard "
        "deviation over mean; mesh: largest stated mesh error of a realisation over its value."
    )


def wish_findings(summary: pd.DataFrame, most: int | None) -> list[str]:
    """Say whether the means are known as well as the study wished; nothing where it did not.

    Parameters
    ----------
    summary : pandas.DataFrame
        ``stiffness_summary.csv``.
    most : int or None
        Realisations that a configuration could have, where their number grew with their scatter.
    """
    wish = summary["wished_half_width"].iloc[0]
    if not math.isfinite(wish):
        return []
    worst = summary.loc[
        summary.groupby(["thickness_um", "overlength_percent"])["best_half_width"].idxmax()
    ]
    unmet = worst[~(worst["best_half_width"] <= wish)]
    text = (
        f"The 95 % interval of the mean is at most ±{nominal(100 * wish)} % wide, as wished, in "
        f"both directions of {len(worst) - len(unmet)} of {plural(len(worst), 'configuration')}"
    )
    if unmet.empty:
        return [f"{text}."]
    ordered = unmet.sort_values("best_half_width", ascending=False)
    cases = [_missed(row) for row in ordered.itertuples()]
    left = len(cases) - CASES_SHOWN
    named = "; ".join(cases[:CASES_SHOWN]) + (
        f"; and {left} more, see the list" if left > 0 else ""
    )
    limit = f" with at most {most} realisations each" if most else ""
    return [f"{text}{limit}. Not: {named}."]


def _missed(row) -> str:
    """A configuration that is not known as well as wished, and how many realisations that takes."""
    case = f"{nominal(row.thickness_um)} µm at {nominal(row.overlength_percent)} %"
    if not math.isfinite(row.best_half_width):
        return f"{case} (n = {row.best_n})"
    return (
        f"{case} (n = {row.best_n}, ±{percent(row.best_half_width)} {row.direction}ly; the wish "
        f"takes about {number(row.wish_takes, 2)})"
    )


def sureness(summary: pd.DataFrame) -> list[str]:
    """Say how sure the trusted values are, and what few realisations leave open."""
    rows = summary[summary["trusted"] & (summary["n"] > 0)]
    sentences = []
    if len(rows):
        parts = []
        for direction, cells in rows.groupby("direction", sort=False):
            scatter = Spread.of(cells["mesh_limit_std"] / cells["mesh_limit_mean"])
            error = percent(cells["mesh_error_share_max"].max())
            text = f"{direction} mesh error of the given shapes at most {error}"
            if scatter:
                text += f", scatter {percent(scatter.median)} in the median"
            parts.append(text)
        sentences.append(f"Trusted values: {'; '.join(parts)}.")
    n = summary["n"].max()
    if n == 1:
        sentences.append("One realisation of each configuration: its scatter is not known.")
    elif n == 2:
        sentences.append(
            "Two realisations of each configuration: their scatter is little more than a guess."
        )
    return sentences
