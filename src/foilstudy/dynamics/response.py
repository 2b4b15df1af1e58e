"""Interface dynamic stiffness of a reduced model with modal damping."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from foilstudy.dynamics.reduction import INTERFACE, ReducedModel
from foilstudy.stiffness.directional import DIRECTIONS, MOTIONS

DEFINITIONS = ("transfer", "driving", "relative")
"""``transfer``: force on the held top ring per motion of the bottom ring (a test rig against a
heavy frame). ``driving``: force on the moved bottom ring. ``relative``: inverse of the receptance
of a self-balanced pair of forces on the two rings, per relative motion. All other motions of both
rings are held in all three."""

_RIGID_MODES = 6


def frequency_grid(lowest: float, highest: float, count: int) -> np.ndarray:
    """Logarithmic grid with exact ends, Hz."""
    grid = np.geomspace(lowest, highest, count)
    grid[[0, -1]] = lowest, highest
    return grid


def interface_dynamic_stiffness(
    model: ReducedModel, frequencies: np.ndarray, damping_ratio: float
) -> np.ndarray:
    """D(omega) on the twelve ring motions, the inverse of the interface receptance.

    H(omega) = sum_j phi_j phi_j^T / (omega_j^2 - omega^2 + 2 i zeta omega_j omega) over all free
    modes of the reduced model; the six rigid modes have omega_j = 0 exactly.

    Parameters
    ----------
    model : ReducedModel
    frequencies : ndarray
        Hz, positive.
    damping_ratio : float
        zeta, the same for every elastic mode.

    Returns
    -------
    ndarray of complex, shape (frequencies, 12, 12)
    """
    values, shapes = eigh(model.stiffness, model.mass)
    values[:_RIGID_MODES] = 0.0
    interface = shapes[:INTERFACE]
    omega = 2 * np.pi * np.asarray(frequencies)[:, None]
    natural = np.sqrt(values)[None]
    denominator = natural**2 - omega**2 + 2j * damping_ratio * natural * omega
    receptance = np.einsum("im,fm,jm->fij", interface, 1 / denominator, interface, optimize=True)
    return np.linalg.inv(receptance)


def dynamic_stiffness(
    model: ReducedModel, frequencies: np.ndarray, damping_ratio: float
) -> np.ndarray:
    """Axial and radial dynamic stiffness in the three definitions.

    Returns
    -------
    ndarray of complex, shape (3 definitions, 2 directions, frequencies), N/m
        In the order of `DEFINITIONS` and `DIRECTIONS`; the radial one is the mean over x and y.
    """
    full = interface_dynamic_stiffness(model, frequencies, damping_ratio)
    out = np.empty((len(DEFINITIONS), len(DIRECTIONS), len(full)), dtype=complex)
    for d, direction in enumerate(DIRECTIONS):
        pairs = np.array([(motion, motion + 6) for motion in MOTIONS[direction]])
        blocks = full[:, pairs[:, :, None], pairs[:, None, :]]  # frequency, motion, ring, ring
        bottom, top, between = blocks[..., 0, 0], blocks[..., 1, 1], blocks[..., 0, 1]
        # inverse of (1, -1) B^-1 (1, -1)^T for the 2 x 2 block B of one motion
        relative = (bottom * top - between**2) / (bottom + top + 2 * between)
        out[0, d] = -between.mean(axis=1)
        out[1, d] = bottom.mean(axis=1)
        out[2, d] = relative.mean(axis=1)
    return out
