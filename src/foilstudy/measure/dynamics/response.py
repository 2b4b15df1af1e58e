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


_SLOW = 1e-8
"""Square of a frequency over that of the fastest motion of the rings on a foil that follows them
statically: below it half of the digits of a receptance are those of rigid motions."""


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
    frequencies, values, interface = _modes(model, frequencies)
    return _receptance(interface, _denominator(frequencies, values, damping))


def interface_dynamic_stiffness(
    model: ReducedModel, frequencies: np.ndarray, damping: Damping
) -> np.ndarray:
    """D(omega) on the twelve ring motions, the inverse of `interface_receptance`."""
    frequencies, values, interface = _modes(model, frequencies)
    denominator = _denominator(frequencies, values, damping)
    slow = (2 * np.pi * frequencies) ** 2 < _SLOW * model.fastest_ring_motion()
    if not slow.any():
        return np.linalg.inv(_receptance(interface, denominator))
    out = np.empty((frequencies.size, INTERFACE, INTERFACE), dtype=complex)
    if not slow.all():
        out[~slow] = np.linalg.inv(_receptance(interface, denominator[~slow]))
    rigid = values == 0.0
    elastic = _receptance(interface[:, ~rigid], denominator[slow][:, ~rigid])
    out[slow] = _slow_stiffness(elastic, interface[:, rigid], denominator[slow][:, rigid])
    return out


def _modes(
    model: ReducedModel, frequencies: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Checked frequencies, omega_j^2, and the free modes on the ring motions."""
    frequencies = checked(frequencies)
    if frequencies.max() > model.valid_to_hz * (1 + 1e-12):
        raise ValueError(
            f"{frequencies.max():g} Hz is beyond {model.valid_to_hz:g} Hz, up to where this "
            f"{model.method} model is valid; reduce the structure again for a wider band."
        )
    values, shapes = model.free_modes()
    return frequencies, values, shapes[:INTERFACE]


def _denominator(frequencies: np.ndarray, values: np.ndarray, damping: Damping) -> np.ndarray:
    """omega_j^2 - omega^2 + d_j, shape (frequencies, modes)."""
    omega = 2 * np.pi * frequencies[:, None]
    return values - omega**2 + damping.modal(values, omega)


def _receptance(interface: np.ndarray, denominator: np.ndarray) -> np.ndarray:
    """Of the ring motions, by the modes given, shape (frequencies, 12, 12)."""
    return np.einsum("im,fm,jm->fij", interface, 1 / denominator, interface, optimize=True)


def _slow_stiffness(elastic: np.ndarray, rigid: np.ndarray, denominator: np.ndarray) -> np.ndarray:
    """Inverse of the receptance H = E + R d^-1 R^T where the rigid part outgrows the elastic one.

    The sum would lose E. With q = d^-1 R^T f as further unknowns the two stand side by side, and
    D is the corner of the inverse of [[E, R], [R^T, -d]].

    Parameters
    ----------
    elastic : ndarray, shape (frequencies, 12, 12)
        E.
    rigid : ndarray, shape (12, rigid modes)
        R.
    denominator : ndarray, shape (frequencies, rigid modes)
        d.
    """
    count, modes = denominator.shape
    motions = np.sqrt(np.abs(np.diagonal(elastic, axis1=1, axis2=2)).max(axis=0))  # m beside rad
    rigid = rigid / motions[:, None]
    lengths = np.linalg.norm(rigid, axis=0)
    whole = np.zeros((count, INTERFACE + modes, INTERFACE + modes), dtype=complex)
    whole[:, :INTERFACE, :INTERFACE] = elastic / np.multiply.outer(motions, motions)
    whole[:, :INTERFACE, INTERFACE:] = rigid / lengths
    whole[:, INTERFACE:, :INTERFACE] = (rigid / lengths).T
    k = np.arange(INTERFACE, INTERFACE + modes)
    whole[:, k, k] = -denominator / lengths**2
    corner = np.linalg.inv(whole)[:, :INTERFACE, :INTERFACE]
    return corner / np.multiply.outer(motions, motions)


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
        out[0, d] = -between.mean(axis=1)
        out[1, d] = bottom.mean(axis=1)
        out[2, d] = _relative(bottom, top, between).mean(axis=1)
    return out


def _relative(bottom: np.ndarray, top: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Inverse of (1, -1) B^-1 (1, -1)^T for the 2 x 2 blocks B of one motion."""
    inertia = bottom + top + 2 * between
    slow = np.abs(inertia) < _SLOW * np.abs(between)
    inertia[slow] = 1.0
    relative = (bottom * top - between**2) / inertia
    # the same without what the difference of two products would lose; the rest is of the fourth
    # order in the frequency
    relative[slow] = 0.25 * (bottom + top - 2 * between)[slow]
    return relative


def dynamic_stiffness(model: ReducedModel, frequencies: np.ndarray, damping: Damping) -> np.ndarray:
    """Axial and radial dynamic stiffness of a reduced model, see `directional_stiffness`."""
    return directional_stiffness(interface_dynamic_stiffness(model, frequencies, damping))


def relative_error(ours: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """|D - D_truth| / |D_truth| of dynamic stiffnesses, frequency by frequency."""
    return np.abs(ours - truth) / np.abs(truth)
