"""Potential flow about a cylinder whose wall moves in waves: the air that moves with it.

Of a wall that moves normally with exp(i n theta + i k z), p = rho d w''/dt'' with a thickness d of
air that seems to move with it: H. Lamb, Hydrodynamics, 6th ed., Cambridge (1932), for the plane
1/k; by the Bessel functions I_n inside and K_n outside for the cylinder.
"""

from __future__ import annotations

import numpy as np
from scipy.special import ive, kve


def inside(n: np.ndarray, k: np.ndarray, radius: float) -> np.ndarray:
    """Thickness of the air inside that moves with waves on a cylinder, m.

    Parameters
    ----------
    n : ndarray of int
        Waves around.
    k : ndarray
        Wave number along, 1/m; not zero where n is.
    radius : float
        m.
    """
    n, k = np.broadcast_arrays(n, k)
    x = np.where(k > 0, k * radius, 1.0)
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        slope = 0.5 * x * (ive(np.abs(n - 1), x) + ive(n + 1, x))  # x I_n'
        ratio = ive(n, x) / slope
    return radius * _of_all(n, k, x, ratio)


def outside(n: np.ndarray, k: np.ndarray, radius: float) -> np.ndarray:
    """The same of the air outside."""
    n, k = np.broadcast_arrays(n, k)
    x = np.where(k > 0, k * radius, 1.0)
    with np.errstate(over="ignore", under="ignore", invalid="ignore", divide="ignore"):
        slope = 0.5 * x * (kve(np.abs(n - 1), x) + kve(n + 1, x))  # -x K_n'
        ratio = kve(n, x) / slope
    return radius * _of_all(n, k, x, ratio)


def _of_all(n: np.ndarray, k: np.ndarray, x: np.ndarray, ratio: np.ndarray) -> np.ndarray:
    """The ratio where it is finite; its limits for no wave along, and for so many around that the
    Bessel functions leave the range of numbers, where the wall is as good as plane."""
    plane = 1 / np.sqrt(n**2 + x**2)
    ratio = np.where(np.isfinite(ratio) & (ratio > 0), ratio, plane)
    return np.where(k > 0, ratio, 1 / np.maximum(n, 1))
