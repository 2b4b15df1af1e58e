"""What a reduction starts from and what it returns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.linalg import eigh

from foilstudy.stiffness.condensation import InterfaceSystem, StaticCondensation

INTERFACE = 12
"""Motions of the two rings; they are the first coordinates of every reduced model."""


@dataclass(frozen=True)
class Structure:
    """Stiffness and mass of a sheet with rings, and its static condensation."""

    stiffness: InterfaceSystem
    mass: InterfaceSystem
    static: StaticCondensation


@dataclass(frozen=True)
class ReducedModel:
    """Reduced stiffness and mass; coordinates: 12 ring motions, then generalised ones.

    The generalised coordinates move only the interior, and the ring coordinates carry it along
    by the constraint modes, so that the stiffness has no coupling between the two.

    Attributes
    ----------
    stiffness, mass : ndarray, shape (12 + m, 12 + m)
    retained_modes : int
        Free-free elastic modes in the basis.
    """

    stiffness: np.ndarray
    mass: np.ndarray
    retained_modes: int

    @property
    def static_stiffness(self) -> np.ndarray:
        """Interface stiffness at zero frequency, shape (12, 12)."""
        return self.stiffness[:INTERFACE, :INTERFACE]

    def clamped_eigenfrequencies(self, count: int) -> np.ndarray:
        """First eigenfrequencies with both rings clamped, Hz; NaN where there are fewer."""
        interior = slice(INTERFACE, None)
        values = eigh(
            self.stiffness[interior, interior], self.mass[interior, interior], eigvals_only=True
        )
        out = np.full(count, np.nan)
        found = min(count, values.size)
        out[:found] = np.sqrt(np.maximum(values[:found], 0.0)) / (2 * np.pi)
        return out


class Reduction(Protocol):
    """A way to reduce a structure onto few coordinates that include the ring motions."""

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure."""
        ...


def project(structure: Structure, basis: np.ndarray, retained_modes: int) -> ReducedModel:
    """Galerkin projection onto the constraint modes and an interior basis.

    Parameters
    ----------
    structure : Structure
    basis : ndarray, shape (interior, m)
        Linearly independent interior displacements with the rings at rest.
    retained_modes : int

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
    return ReducedModel(0.5 * (stiffness + stiffness.T), 0.5 * (mass + mass.T), retained_modes)
