"""Axial and radial stiffness from a 12 x 12 interface stiffness."""

from __future__ import annotations

import numpy as np

DIRECTIONS = ("axial", "radial")
MOTIONS = {"axial": (2,), "radial": (0, 1)}
"""Translations that make up a direction; the radial one is the mean of two orthogonal ones."""


def fixed_stiffness(interface_stiffness: np.ndarray) -> np.ndarray:
    """Force on the top ring per motion of the bottom ring, all other motions held.

    Returns
    -------
    ndarray, shape (2,)
        Axial and radial, N/m; positive when the force resists.
    """
    return by_direction(-np.diag(interface_stiffness[6:, :6]))


def by_direction(translations: np.ndarray) -> np.ndarray:
    """Axial and radial, from numbers of the translations along x, y and z."""
    return np.array([translations[list(MOTIONS[d])].mean() for d in DIRECTIONS])


def free_stiffness(interface_stiffness: np.ndarray) -> np.ndarray:
    """Force per motion of the top ring in its direction, its other motions free, bottom held.

    Returns
    -------
    ndarray, shape (2,)
        Axial and radial (inverse of the mean of two compliances), N/m.
    """
    compliance = np.diag(np.linalg.inv(interface_stiffness[6:, 6:]))
    return np.array([1 / compliance[list(MOTIONS[d])].mean() for d in DIRECTIONS])
