"""Interface dynamic stiffness of a reduced model, damped, and what is read from it."""

from __future__ import annotations

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_count
from foilstudy.measure.dynamics.damping import Damping
from foilstudy.measure.dynamics.reduction import ReducedModel
from foilstudy.measure.dynamics.structure import INTERFACE
from foilstudy.measure.stiffness.directional import DIRECTIONS, MOTIONS

DEFINITIONS = ("transfer", "driving", "relative")
"""``transfer``: force on the held top ring per motion of the bottom ring (a test rig against a
heavy frame). ``driving``: force on the moved bottom ring. ``relative``: inverse of the receptance
of a self-balanced pair of forces on the two rings, per relative motion. All other motions of both
rings are held in all three."""


def frequency_grid(lowest: float, highest: float, count: int) -> np.ndarray:
    """Logarithmic grid with exact ends, Hz, of two frequencies or more.

    Raises
    ------
    Refusal
        If the ends are not positive and rising.
    """
    require_band(lowest, highest)
    require_count("number of frequencies", count, 2)
    grid = np.geomspace(lowest, highest, count)
    grid[[0, -1]] = lowest, highest
    return grid


def interface_receptance(
    model: ReducedModel, frequencies: np.ndarray, damping: Damping
) -> np.ndarray:
    """H(omega) of the twelve ring motions, both rings free.

    H(omega) = sum_j phi_j phi_j^T / (omega_j^2 - omega^2 + d_j) over all free modes of the reduced
    model, with the damping term d_j; rigid modes have omega_j = 0 exactly.

    Parameters
    ----------
    model : ReducedModel
    frequencies : ndarray
        Hz, positive and rising, up to where the model is valid.
    damping : Damping

    Returns
    -------
    ndarray of complex, shape (frequencies, 12, 12)

    Raises
    ------
    ValueError
        If the frequencies are not positive and rising, or go beyond the validity of the model.
    """
    frequencies = checked(frequencies)
    if frequencies.max() > model.valid_to_hz * (1 + 1e-12):
        raise ValueError(
            f"{frequencies.max():g} Hz is beyond {model.valid_to_hz:g} Hz, up to where this "
            f"{model.method} model is valid; reduce the structure again for a wider band."
        )
    values, shapes = model.free_modes()
    interface = shapes[:INTERFACE]
    omega = 2 * np.pi * frequencies[:, None]
    denominator = values - omega**2 + damping.modal(values, omega)
    return np.einsum("im,fm,jm->fij", interface, 1 / denominator, interface, optimize=True)


def interface_dynamic_stiffness(
    model: ReducedModel, frequencies: np.ndarray, damping: Damping
) -> np.ndarray:
    """D(omega) on the twelve ring motions, the inverse of `interface_receptance`."""
    return np.linalg.inv(interface_receptance(model, frequencies, damping))


def checked(frequencies: np.ndarray) -> np.ndarray:
    """Frequencies as an array.

    Raises
    ------
    ValueError
        If there is none, one that is not a positive number, or one that is not above the one
        before.
    """
    frequencies = np.atleast_1d(np.asarray(frequencies, dtype=float))
    good = frequencies.ndim == 1 and frequencies.size > 0
    if not good or not (np.isfinite(frequencies) & (frequencies > 0)).all():
        raise Refusal("give one or several positive frequencies in Hz.")
    if (np.diff(frequencies) <= 0).any():
        at = int(np.argmax(np.diff(frequencies) <= 0))
        raise Refusal(
            f"frequencies are to rise, but {frequencies[at + 1]:g} Hz follows "
            f"{frequencies[at]:g} Hz; sort them and leave repeated ones out."
        )
    return frequencies


def require_band(lowest_hz: float, highest_hz: float) -> None:
    """Refuse two frequencies that are no band.

    Raises
    ------
    Refusal
    """
    if not 0 < lowest_hz < highest_hz < np.inf:
        raise Refusal(
            f"a band from {lowest_hz:g} to {highest_hz:g} Hz is none; give two positive, rising "
            "frequencies."
        )


def directional_stiffness(interface_stiffness: np.ndarray) -> np.ndarray:
    """Axial and radial dynamic stiffness in the three definitions.

    Parameters
    ----------
    interface_stiffness : ndarray of complex, shape (frequencies, 12, 12)

    Returns
    -------
    ndarray of complex, shape (3 definitions, 2 directions, frequencies), N/m
        In the order of `DEFINITIONS` and `DIRECTIONS`; the radial one is the mean over x and y.
    """
    full = interface_stiffness
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


def dynamic_stiffness(model: ReducedModel, frequencies: np.ndarray, damping: Damping) -> np.ndarray:
    """Axial and radial dynamic stiffness of a reduced model, see `directional_stiffness`."""
    return directional_stiffness(interface_dynamic_stiffness(model, frequencies, damping))


def relative_error(ours: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """|D - D_truth| / |D_truth| of dynamic stiffnesses, frequency by frequency."""
    return np.abs(ours - truth) / np.abs(truth)
