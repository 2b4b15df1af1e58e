"""Blocks of the stiffness: means beside each other and the published fits, bounds, scatter."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pandas as pd

from foilstudy.base.reference import published
from foilstudy.present.statistics.cells import good
from foilstudy.present.statistics.summary import best_mean
from page_blocks.study import DIRECTIONS, Study, listed, rows, short


def beside(first: Study, second: Study) -> Iterator[str]:
    """Means of the first study over those of the second, with the interval of the ratio."""
    keys = ["direction", "thickness_um", "reference_height_mm"]
    shared = _means(first).merge(_means(second), on=keys, suffixes=("_a", "_b"))
    heights = shared["reference_height_mm"].unique()
    names = shared.drop_duplicates("reference_height_mm")["overlength_percent_a"]
    body = []
    for (direction, thickness), some in shared.groupby(["direction", "thickness_um"]):
        cells = some.set_index("reference_height_mm").reindex(heights)
        ratios = (_ratio(cell) for _, cell in cells.iterrows())
        body.append([f"{direction} {thickness:.0f} µm", *ratios])
    yield from rows(["", *(f"{value:.2g} %" for value in names)], body)


def _means(study: Study) -> pd.DataFrame:
    summary = study.table("stiffness_summary")
    names = ["direction", "thickness_um", "reference_height_mm", "overlength_percent"]
    return summary[[*names, "best_low", "best_high"]].assign(mean=best_mean(summary))


def _ratio(cell: pd.Series) -> str:
    """A ratio of means; its interval recovers the variances of their logarithms from theirs."""
    mean, low, high = (
        np.log([cell[f"{name}_{side}"] for side in "ab"])
        for name in ("mean", "best_low", "best_high")
    )
    below, above = mean - low, high - mean
    middle = mean[0] - mean[1]
    ends = middle - np.hypot(below[0], above[1]), middle + np.hypot(above[0], below[1])
    return f"{short(np.exp(middle))} [{', '.join(short(np.exp(end)) for end in ends)}]"


def simulation(study: Study) -> Iterator[str]:
    """Our means, on the crumpled mesh and in the mesh limit, over the published simulation."""
    plain = good(study.cube, "static_stiffness").mean("seed")
    limit = good(study.cube, "static_stiffness_converged").mean("seed")
    yield from _over_published(study, "simulation", (plain, limit))


def experiment(study: Study) -> Iterator[str]:
    """Our mesh limit (mean) and pre-stressed values (median) over the published experiment."""
    limit = good(study.cube, "static_stiffness_converged").mean("seed")
    stressed = study.cube["prestressed_stiffness"].median("seed")
    yield from _over_published(study, "experiment", (limit, stressed))


def _over_published(study: Study, source: str, ours: tuple) -> Iterator[str]:
    """Values of ours, side by side, over a published fit."""

    def cells(direction: str, thickness: int) -> list[str]:
        fit = published().power_laws[direction][source].law
        theirs = fit.stiffness(study.overlengths, thickness)
        ratios = [_row(values, direction, thickness) / theirs for values in ours]
        return [", ".join(map(short, each)) for each in zip(*ratios, strict=True)]

    yield from _by_overlength(study, cells)


def _row(values, direction: str, thickness: int) -> np.ndarray:
    return values.sel(direction=direction, thickness=thickness).values


def _by_overlength(study: Study, cells) -> Iterator[str]:
    heads = ["", *(f"{value:.2g} %" for value in study.overlengths)]
    body = [
        [f"{direction} {thickness} µm", *cells(direction, thickness)]
        for direction in DIRECTIONS
        for thickness in study.thicknesses
    ]
    yield from rows(heads, body)


def prestress(study: Study) -> Iterator[str]:
    """Medians of pre-stressed over stress-free stiffness."""
    stressed = study.cube["prestressed_stiffness"]
    for name, words in (
        ("static_stiffness", "of the stress-free value on the same mesh"),
        ("static_stiffness_converged", "of its mesh limit"),
    ):
        ratio = (stressed / good(study.cube, name)).median(("overlength", "seed"))
        for direction in DIRECTIONS:
            shares = ", ".join(f"{value:.2f}" for value in ratio.sel(direction=direction).values)
            yield f"- {direction}, {words}: {shares} ({listed(study.thicknesses)} µm)"
    negative = int((stressed <= 0).sum())
    yield f"- {negative} of {int(np.isfinite(stressed).sum())} values are negative"


def bound(study: Study) -> Iterator[str]:
    """The largest share of the uncrumpled cylinder's stiffness."""
    cylinder = study.cube["cylinder_stiffness"]
    share = good(study.cube, "static_stiffness_converged") / cylinder
    words = (f"{100 * float(share.sel(direction=d).max()):.0f} % ({d})" for d in DIRECTIONS)
    yield (
        f"No crumple ({study.mesh}) exceeds {' or '.join(words)} of the stiffness of the "
        "uncrumpled cylinder of the same foil and height."
    )


def variability(study: Study) -> Iterator[str]:
    """Coefficients of variation and their law."""
    table, fitted = study.table("variability"), study.table("variability_law")
    table = table[table["quantity"] == "static_stiffness"]
    fitted = fitted.set_index("direction")
    body = {
        "range, median": [],
        "slope per 10 % overlength, percentage points": [],
        "rank correlation with thickness": [],
    }
    for direction in DIRECTIONS:
        cv, one = 100 * table.loc[table["direction"] == direction, "cv"], fitted.loc[direction]
        slope = [1e3 * one[name] for name in ("slope", "slope_low", "slope_high")]
        first, second, third = body.values()
        first.append(f"{cv.min():.2g} to {cv.max():.2g} %, {cv.median():.2g} %")
        second.append(f"{slope[0]:.1f} [{slope[1]:.1f}, {slope[2]:.1f}]")
        rank = one["thickness_rank_correlation"], one["thickness_rank_correlation_p"]
        third.append(f"{rank[0]:.2f}, p = {rank[1]:.2g}")
    yield from rows(["", *DIRECTIONS], [[name, *cells] for name, cells in body.items()])
