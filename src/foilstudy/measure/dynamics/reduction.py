"""What every reduction returns, and the projection they share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from scipy.linalg import eigh

from foilstudy.measure.dynamics.structure import INTERFACE, Structure


@dataclass(frozen=True)
class ReducedModel:
    """Reduced stiffness and mass; coordinates: 12 ring motions, then generalised ones.

    The generalised coordinates move only the interior, and the ring coordinates carry it along
    by the constraint modes, so that the stiffness has no coupling between the two.

    Attributes
    ----------
    stiffness, mass : ndarray, shape (12 + m, 12 + m)
        Symmetric; the first 12 coordinates are the ring motions themselves (`INTERFACE`), in the
        order of `foilstudy.measure.stiffness.DOF_NAMES`.
    basis : ndarray, shape (interior, m)
        Displacement of the interior per generalised coordinate.
    rigid_modes : int
        Motions without stiffness: six, three under pre-stress.
    method : str
        For example ``rational_krylov``.
    error_estimate : float
        Largest estimated relative error of the dynamic stiffness in the band that the reduction
        was asked for; NaN where it was asked for none.
    valid_to_hz : float
        Up to where that estimate meets the tolerance; NaN likewise.
    """

    stiffness: np.ndarray
    mass: np.ndarray
    basis: np.ndarray
    rigid_modes: int
    method: str
    error_estimate: float = np.nan
    valid_to_hz: float = np.nan

    def __repr__(self) -> str:
        return (
            f"<ReducedModel: {self.method}, {self.size} coordinates, valid to "
            f"{self.valid_to_hz:g} Hz, estimated error {self.error_estimate:.1e}>"
        )

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return self.mass.shape[0]

    @property
    def interface_map(self) -> np.ndarray:
        """Ring motions from the coordinates, shape (12, 12 + m)."""
        return np.eye(INTERFACE, self.size)

    @property
    def static_stiffness(self) -> np.ndarray:
        """Interface stiffness at zero frequency, shape (12, 12)."""
        return self.stiffness[:INTERFACE, :INTERFACE]

    def fastest_ring_motion(self) -> float:
        """Largest eigenvalue of the rings with the interior following statically, rad2/s2."""
        rings = slice(0, INTERFACE)
        stiffness, mass = self.stiffness[rings, rings], self.mass[rings, rings]
        return float(eigh(stiffness, mass, eigvals_only=True)[-1])

    def clamped_eigenfrequencies(self) -> np.ndarray:
        """All eigenfrequencies with both rings held, ascending, Hz."""
        return self._clamped[0].copy()

    def clamped_modes(self, count: int) -> tuple[np.ndarray, np.ndarray]:
        """First modes with both rings held.

        Returns
        -------
        frequencies : ndarray, shape (at most count,)
            Hz.
        shapes : ndarray, shape (interior, at most count)
            Mass-normalised displacements, m/sqrt(kg m2).
        """
        frequencies, vectors = self._clamped
        return frequencies[:count].copy(), self.basis @ vectors[:, :count]

    @cached_property
    def _clamped(self) -> tuple[np.ndarray, np.ndarray]:
        """All frequencies with both rings held, Hz, and their generalised coordinates."""
        inner = slice(INTERFACE, None)
        if self.size == INTERFACE:
            return np.empty(0), np.empty((0, 0))
        values, vectors = eigh(self.stiffness[inner, inner], self.mass[inner, inner])
        return np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi), vectors

    def free_modes(self) -> tuple[np.ndarray, np.ndarray]:
        """All modes of the free structure; the eigenvalues of rigid motions are exactly zero.

        Returns
        -------
        eigenvalues : ndarray, shape (12 + m,)
            Squared angular eigenfrequencies, rad2/s2; some may be negative under pre-stress.
        vectors : ndarray, shape (12 + m, 12 + m)
            Mass-normalised, in the coordinates of the model.
        """
        values, vectors = eigh(self.stiffness, self.mass)
        values[np.argsort(np.abs(values))[: self.rigid_modes]] = 0.0
        return values, vectors


class Reduction(Protocol):
    """A way to reduce a structure onto few coordinates that include the ring motions.

    Its class has a method ``for_band(wanted, cutoff_hz=None)``, which makes one for a tolerance and
    a band; the cut-off belongs to reductions that keep the modes below one.
    """

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure."""
        ...


def project(structure: Structure, basis: np.ndarray, method: str) -> ReducedModel:
    """Galerkin projection onto the constraint modes and an interior basis.

    Parameters
    ----------
    structure : Structure
    basis : ndarray, shape (interior, m)
        Linearly independent interior displacements with the rings at rest.
    method : str

    Returns
    -------
    ReducedModel
    """
    k, m, static = structure.stiffness, structure.mass, structure.static
    constraint = static.constraint_modes
    carried = m.interior @ constraint + m.coupling
    size = INTERFACE + basis.shape[1]
    stiffness = np.zeros((size, size))
    mass = np.zeros((size, size))
    stiffness[:INTERFACE, :INTERFACE] = static.stiffness
    stiffness[INTERFACE:, INTERFACE:] = basis.T @ (k.interior @ basis)
    mass[:INTERFACE, :INTERFACE] = m.interface + constraint.T @ carried + m.coupling.T @ constraint
    mass[INTERFACE:, :INTERFACE] = basis.T @ carried
    mass[:INTERFACE, INTERFACE:] = mass[INTERFACE:, :INTERFACE].T
    mass[INTERFACE:, INTERFACE:] = basis.T @ (m.interior @ basis)
    return ReducedModel(
        0.5 * (stiffness + stiffness.T), 0.5 * (mass + mass.T), basis,
        structure.rigid_modes, method,
    )  # fmt: skip
