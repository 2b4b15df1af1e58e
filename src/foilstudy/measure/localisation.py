"""Where along the height a crumple has taken its shortening, and how long its meridians are."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.verdicts.shape import wave_share
from foilstudy.model.patch import Patch, knot_points
from foilstudy.model.supports.interpolation import along_weights, gauss_line

BANDS = 10
"""Of the developed height in which the shortening is counted: the same on every mesh."""


def localisation(patch: Patch, points: np.ndarray) -> dict[str, float]:
    """The measures of a shape by the names of a study's quantities.

    ``shortening_spread`` is the participation ratio of the bands, (sum s)^2 / (n sum s^2): one
    where each has taken as much, 1/n where one band has taken all. ``shortening_gini`` is zero and
    1 - 1/n there.

    Parameters
    ----------
    patch : Patch
    points : ndarray, shape (3, rows, columns)
        Control points of a shape about the axis z, m.
    """
    taken = np.clip(shortening_profile(patch, points), 0.0, None)
    return {
        "developed_height": developed_height(patch, points),
        "shortening_spread": float(taken.sum() ** 2 / (taken.size * np.sum(taken**2))),
        "shortening_gini": gini(taken),
        "axisymmetric_share": wave_share(knot_points(points), 0),
    }


def developed_height(patch: Patch, points: np.ndarray) -> float:
    """Length of the meridians, ring to ring, mean around, m.

    What a tape along the foil would read; over the gap it gives the overlength in the crumpled
    state.
    """
    at, lengths = gauss_line(patch.elements_along, patch.size_along)
    around = 0.5 * (points + np.roll(points, -1, axis=2)) if patch.periodic else points
    slopes = np.einsum("vj,cji->cvi", along_weights(patch, at, 1), around, optimize=True)
    return float(lengths @ np.linalg.norm(slopes, axis=0).mean(axis=1))


def shortening_profile(patch: Patch, points: np.ndarray, bands: int = BANDS) -> np.ndarray:
    """By how much bands of the developed height are lower than when straight, mean around, m.

    They add up to the shortening of the whole.

    Returns
    -------
    ndarray, shape (bands,)
        From the bottom ring to the top one.
    """
    heights = knot_points(points, patch.periodic)[2].mean(axis=1)
    straight = patch.size_along * np.arange(patch.elements_along + 1)
    lost = straight - (heights - heights[0])
    edges = np.linspace(0, straight[-1], bands + 1)
    return np.diff(np.interp(edges, straight, lost))


def gini(values: np.ndarray) -> float:
    """Gini coefficient of values that are not negative; NaN if all are zero."""
    ordered, count = np.sort(values), values.size
    total = ordered.sum()
    if not total > 0:
        return np.nan
    ranks = np.arange(1, count + 1)
    return float(2 * np.sum(ranks * ordered) / (count * total) - (count + 1) / count)
