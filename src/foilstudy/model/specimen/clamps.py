"""The shape of a cylinder that stands between rings out of true."""

from __future__ import annotations

import numpy as np

from foilstudy.model.patch import RING_ROWS
from foilstudy.model.specimen import Clamps


def clamped_shape(clamps: Clamps, cylinder: np.ndarray) -> np.ndarray:
    """Control points of a cylinder once its rings are in their clamps, as yet not in equilibrium.

    The two rows of a ring keep what they have to each other. In between the cylinder follows:
    it becomes an ellipse without stretching, and shears linearly over the height.

    Parameters
    ----------
    clamps : Clamps
    cylinder : ndarray, shape (3, rows, columns)
        Stress-free control points about the axis z, m.
    """
    if clamps.true:
        return cylinder
    x, y, z = cylinder
    angle = np.arctan2(y, x)
    out = clamps.ellipticity * np.cos(2 * angle)
    on = -0.5 * clamps.ellipticity * np.sin(2 * angle)  # by which no arc changes its length
    oval = cylinder.copy()
    oval[0] += out * np.cos(angle) - on * np.sin(angle)
    oval[1] += out * np.sin(angle) + on * np.cos(angle)
    return oval + _tilting(clamps.tilt, oval)


def _tilting(tilt: float, points: np.ndarray) -> np.ndarray:
    """Displacement that turns the top ring about y, in proportion to the height below it."""
    height = points[2].mean(axis=1)
    low, high = height[RING_ROWS - 1], height[-RING_ROWS]
    share = np.clip((height - low) / (high - low), 0, 1)
    ring = points[2, -RING_ROWS:].mean()
    arms = points.copy()
    arms[2, :-RING_ROWS] = 0.0
    arms[2, -RING_ROWS:] -= ring
    turned = np.stack(
        [
            np.cos(tilt) * arms[0] + np.sin(tilt) * arms[2],
            arms[1],
            np.cos(tilt) * arms[2] - np.sin(tilt) * arms[0],
        ]
    )
    return share[:, None] * (turned - arms)
