"""Blocks of where along the height crumples have taken their shortening."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

import numpy as np
import pandas as pd
from scipy.stats import spearmanr

from foilstudy.study.real.settings import ladder
from page_blocks.study import Study, rows

_NO_SPREAD = 1e-9
_MEASURES = {"shortening_spread": "spread", "axisymmetric_share": "axisymmetric"}


def localisation(models: Study, *studies: Study) -> Iterator[str]:
    """Mean and extremes of the measures over all foils of a height, by model.

    Parameters
    ----------
    models : Study
        The side study of models of the foil.
    studies : Study
        Others beside it, of which the same overlengths are shown.
    """
    trials = models.table("trials")
    words = {step.name: step.words for step in ladder(models.folder.name).steps}
    heights = sorted(trials["height_mm"].unique())
    body = []
    for step, name in words.items():
        mine = trials[trials["step"] == step]
        body.append([name, f"{len(mine)}", *_cells(mine, heights)])
    for study in studies:
        table = study.cube[list(_MEASURES)].to_dataframe().dropna(subset=[*_MEASURES])
        table = table.assign(height_mm=table["reference_height"].astype(int))
        count = int(table["height_mm"].isin(heights).sum())
        body.append([f"`results/{study.folder.name}`", f"{count}", *_cells(table, heights)])
    heads = ["", "crumples"]
    heads += [f"{word}, {height} mm" for word in _MEASURES.values() for height in heights]
    yield from rows(heads, body)


def _cells(table: pd.DataFrame, heights: list[int]) -> Iterator[str]:
    for measure in _MEASURES:
        for height in heights:
            values = table.loc[table["height_mm"] == height, measure].to_numpy(float)
            values = values[np.isfinite(values)]
            if not values.size:
                yield ""
                continue
            yield f"{values.mean():.2f} ({values.min():.2f} to {values.max():.2f})"


def followed(models: Study, *studies: Study) -> Iterator[str]:
    """Rank correlation of the axial stiffness with the spread, of foils with others of their kind.

    Both less the mean of their kind: foils of one model, or study, thickness and height.
    """
    kinds = ["step", "thickness_um", "height_mm"]
    tables = [(f"the models of `results/{models.folder.name}`", models.table("trials"), kinds)]
    for study in studies:
        cube = study.cube
        table = cube[["shortening_spread"]].to_dataframe()
        stiffness = cube["static_stiffness"].sel(direction="axial", drop=True)
        table["static_stiffness_axial"] = stiffness.to_series()
        tables.append((f"`results/{study.folder.name}`", table, ["thickness", "overlength"]))
    body = []
    for name, table, kind in tables:
        known = table[table["static_stiffness_axial"] > 0].dropna(subset=["shortening_spread"])
        values = known.assign(stiffness=np.log(known["static_stiffness_axial"]))
        columns = ["stiffness", "shortening_spread"]
        apart = values[columns] - values.groupby(kind)[columns].transform("mean")
        if apart["shortening_spread"].abs().max() < _NO_SPREAD:
            body.append([name, f"{len(apart)}", "no scatter"])
            continue
        found = spearmanr(apart["stiffness"], apart["shortening_spread"])
        body.append([name, f"{len(apart)}", f"{found.statistic:+.2f} (p = {found.pvalue:.2g})"])
    yield from rows(["foils of", "number", "rank correlation with the spread, axial"], body)


def correlation(study: Study) -> Iterator[str]:
    """The table of rank correlations of the specimens, with its heading."""
    lines = study.file("specimen.md").read_text("utf-8").splitlines()
    parts = [list(part) for whole, part in groupby(lines, bool) if whole]
    heading = next(k for k, part in enumerate(parts) if part[0].startswith("Rank correlation"))
    yield from parts[heading]
    yield ""
    yield from parts[heading + 1]
