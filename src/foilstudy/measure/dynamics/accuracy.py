"""What is wanted of a reduced model, and the error that it estimates for itself."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.linalg import mass_orthonormal
from foilstudy.measure.dynamics.damping import Damping, ModalDamping
from foilstudy.measure.dynamics.reduction import ReducedModel, project
from foilstudy.measure.dynamics.response import dynamic_stiffness, relative_error, require_band
from foilstudy.measure.dynamics.structure import INTERFACE, Structure


@dataclass(frozen=True)
class Wanted:
    """Accuracy and band of a reduced model.

    Attributes
    ----------
    tolerance : float
        Largest relative error of `transfer`, `driving` and `relative`, axial and radial.
    lowest_hz, highest_hz : float
        Band.
    damping : Damping
        With which the model will be used; it decides how sharp the resonances are.
    """

    tolerance: float = 1e-3
    lowest_hz: float = 1.0
    highest_hz: float = 800.0
    damping: Damping = ModalDamping(0.05)

    def __post_init__(self):
        require_number("tolerance of a reduction", self.tolerance, above=0, below=1)
        require_band(self.lowest_hz, self.highest_hz)

    def checked_at(self, count: int) -> np.ndarray:
        """Frequencies at which the error is estimated, Hz: closer where modes are closer."""
        lowest, highest = np.sqrt(self.lowest_hz), np.sqrt(self.highest_hz)
        return np.linspace(lowest, highest, count) ** 2


CHECKS = 48
"""Frequencies at which a band is checked."""
_CORRECTED_AT = (0.35, 0.7, 1.0)
"""Shares of the highest frequency at which a model is corrected to estimate its error."""


def judged(structure: Structure, model: ReducedModel, wanted: Wanted | None) -> ReducedModel:
    """The model with its error estimate, and up to where that meets the tolerance."""
    if wanted is None:
        return model
    frequencies = wanted.checked_at(CHECKS)
    own = np.sqrt(np.maximum(model.free_modes()[0], 0.0)) / (2 * np.pi)
    inside = own[(own > wanted.lowest_hz) & (own < wanted.highest_hz)]
    frequencies = np.union1d(frequencies, inside)  # where light damping makes errors largest
    errors = residual_estimate(structure, model, frequencies, wanted.damping)
    return with_estimate(model, wanted, frequencies, errors)


def with_estimate(
    model: ReducedModel, wanted: Wanted, frequencies: np.ndarray, errors: np.ndarray
) -> ReducedModel:
    """The model with the largest of its estimated errors, shape (..., frequencies)."""
    worst = errors.reshape(-1, len(frequencies)).max(axis=0)
    beyond = np.flatnonzero(~(worst <= wanted.tolerance))
    if not beyond.size:
        valid_to = wanted.highest_hz
    elif beyond[0] == 0:
        valid_to = 0.0
    else:
        valid_to = frequencies[beyond[0] - 1]
    return replace(model, error_estimate=float(worst.max()), valid_to_hz=float(valid_to))


def residual_estimate(
    structure: Structure, model: ReducedModel, frequencies: np.ndarray, damping: Damping
) -> np.ndarray:
    """Estimated relative error of the dynamic stiffness: the change by one correction.

    The rings moved at a frequency, the interior of the model is out of balance by R. The model is
    compared with one that has the static corrections K^-1 R of three frequencies in its basis
    too, which is good where what it misses are modes above the band.

    Parameters
    ----------
    structure : Structure
    model : ReducedModel
        Of that structure.
    frequencies : ndarray
        Hz.
    damping : Damping

    Returns
    -------
    ndarray, shape (3 definitions, 2 directions, frequencies)
    """
    better = _corrected(structure, model, np.multiply(_CORRECTED_AT, np.max(frequencies)), damping)
    return relative_error(
        dynamic_stiffness(model, frequencies, damping),
        dynamic_stiffness(better, frequencies, damping),
    )


def eigenfrequency_errors(
    structure: Structure, frequencies: np.ndarray, shapes: np.ndarray
) -> np.ndarray:
    """Estimated relative errors of clamped eigenfrequencies of a reduced model.

    r^T K^-1 r / (2 lambda) with the residual r of the mode in the whole structure: what it lacks
    of modes far above it; of near ones it sees too little, up to five times.

    Parameters
    ----------
    structure : Structure
    frequencies, shapes : ndarray, shape (modes,) and (interior, modes)
        From `ReducedModel.clamped_modes`.
    """
    if not frequencies.size:
        return np.empty(0)
    values = (2 * np.pi * frequencies) ** 2
    residual = structure.stiffness.interior @ shapes - structure.mass.interior @ (shapes * values)
    lacking = np.einsum("ij,ij->j", residual, structure.static.factor.solve(residual))
    return 0.5 * np.abs(lacking) / values


def _corrected(
    structure: Structure, model: ReducedModel, frequencies: np.ndarray, damping: Damping
) -> ReducedModel:
    """The model with static corrections at some frequencies as further coordinates."""
    k, m = structure.stiffness.interior, structure.mass.interior
    inertia = m @ structure.static.constraint_modes + structure.mass.coupling
    inner = slice(INTERFACE, None)
    kr, mr = model.stiffness[inner, inner], model.mass[inner, inner]
    carried = model.mass[inner, :INTERFACE]
    residuals = []
    for omega in 2 * np.pi * frequencies:
        # damping as a complex frequency, right for modes near it; off the poles of the model
        z = omega**2 - complex(damping.modal(omega**2, omega)) - 1e-3j * omega**2
        moved = np.linalg.solve(kr - z * mr, z * carried)
        residual = k @ (model.basis @ moved) - z * (m @ (model.basis @ moved) + inertia)
        residuals += [residual.real, residual.imag]
    corrections = structure.static.factor.solve(np.hstack(residuals))
    new = mass_orthonormal(corrections, m, model.basis)
    return project(structure, np.hstack([model.basis, new]), model.method)
