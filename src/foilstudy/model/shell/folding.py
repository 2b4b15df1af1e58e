"""How sharply a crumple folds from one element to the next: whether the mesh follows its folds."""

from __future__ import annotations

import numpy as np

__all__ = ["FOLD_ANGLE_MAX_DEG", "fold_angle"]

PERCENTILE = 99
"""The one of all pairs of neighbours that is reported: the sharpest folds, but no single one."""
FOLD_ANGLE_MAX_DEG = 60.0
"""Largest `fold_angle` of a crumple that its mesh follows: three elements then make a half turn. At
31 % overlength it is 26, 43, 53, 56 and 65 degrees with elements 0.35, 0.7, 1.0, 1.4 and 2.2 times
sqrt(R t) wide (500 um on 2.5 and 5 mm; 250, 130 and 50 um on 5 mm)."""


def fold_angle(surface: np.ndarray) -> float:
    """Angle between the normals of neighbouring elements that one pair in a hundred exceeds.

    A fold that the mesh resolves turns by a little from element to element; one that is as wide as
    an element turns at once.

    Parameters
    ----------
    surface : ndarray, shape (3, rows, columns)
        Points at the knots, periodic in the columns, m.

    Returns
    -------
    float
        rad; NaN where an element has no area.
    """
    closed = np.concatenate([surface, surface[:, :, :1]], axis=2)
    rising, falling = (
        closed[:, 1:, 1:] - closed[:, :-1, :-1],
        closed[:, 1:, :-1] - closed[:, :-1, 1:],
    )
    normals = np.cross(rising, falling, axis=0)
    with np.errstate(invalid="ignore"):
        normals /= np.linalg.norm(normals, axis=0)
    around = normals, np.roll(normals, -1, axis=2)
    along = normals[:, :-1], normals[:, 1:]
    angles = [_angle(*pair).ravel() for pair in (around, along)]
    return float(np.percentile(np.concatenate(angles), PERCENTILE))


def _angle(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Between unit vectors, exact for small ones, too."""
    half = np.linalg.norm(first - second, axis=0) / 2
    return 2 * np.arcsin(np.clip(half, 0.0, 1.0))
