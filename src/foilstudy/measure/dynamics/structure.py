"""The linear system that a reduction starts from: a sheet between two rigid rings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import SolveError, Updated
from foilstudy.measure.stiffness import InterfaceSystem, StaticCondensation, condense

INTERFACE = 12
"""Motions of the two rings; they are the first coordinates of every reduced model."""
RIGID_MODES = 6
_RESISTANCE = 1e-6
"""Of a rigid motion, relative to the terms of the condensed stiffness that cancel; that of sheets
is 1e-9 or less, but for the rounding below."""
_ROUNDING = 1e-14
"""The same relative to the terms of the whole sheet: membrane forces, that leave a thin foil's
bending as their difference, on motions that are large where hardly anything holds it. Rounding
makes 4e-17 of them, whether elements are 300 or 200 000 times as wide as the foil is thick."""
_LOST = 1e-2
"""Resistance over the terms of the condensed stiffness beyond which rounding has eaten that."""


@dataclass(frozen=True)
class Structure:
    """Stiffness and mass of a sheet with rings, and its static condensation.

    Attributes
    ----------
    stiffness, mass : InterfaceSystem
        N/m, kg and their like for rotations in rad.
    static : StaticCondensation
    rigid_motions : ndarray, shape (12, 6) or (12, 3)
        Motions of both rings that cost nothing: six, but only the translations under pre-stress,
        where the forces of the rings turn relative to the sheet.
    """

    stiffness: InterfaceSystem
    mass: InterfaceSystem
    static: StaticCondensation
    rigid_motions: np.ndarray

    def __repr__(self) -> str:
        size = self.stiffness.interior.shape[0] + INTERFACE
        return f"<Structure: {size} unknowns, {self.rigid_modes} rigid motions>"

    @classmethod
    def assembled(
        cls, stiffness: InterfaceSystem, mass: InterfaceSystem, rigid_motions: np.ndarray
    ) -> Structure:
        """With its static condensation.

        Raises
        ------
        SolveError
            If the interior stiffness, rings held, is singular, or if the foil is so thin that its
            stiffness is lost in rounding.
        ValueError
            If a rigid motion of both rings meets resistance.
        """
        static = condense(stiffness)
        _check_resistance(stiffness, static, rigid_motions)
        return cls(stiffness, mass, static, rigid_motions)

    @property
    def stress_free(self) -> bool:
        """Whether all rigid motions cost nothing."""
        return self.rigid_motions.shape[1] == RIGID_MODES

    @property
    def rigid_modes(self) -> int:
        """Number of motions without stiffness."""
        return self.rigid_motions.shape[1]


def _check_resistance(
    system: InterfaceSystem, static: StaticCondensation, motions: np.ndarray
) -> None:
    """See `Structure.assembled`."""
    condensed = static.stiffness
    resistance = np.abs(np.einsum("im,ij,jm->m", motions, condensed, motions))
    terms = _absolute(condensed, motions)
    share = np.max(resistance / terms)
    if share > _RESISTANCE:  # or else nothing is to be told
        inner = static.constraint_modes @ motions
        whole = terms_of_sheet(system, inner, motions)
        if (resistance > _RESISTANCE * terms + _ROUNDING * whole).any():
            raise ValueError(
                f"a rigid motion of both rings meets a resistance of {share:.1e} of its terms: the "
                "sheet is held by something else than its rings, or a ring's motion is not rigid."
            )
    if share > _LOST:
        raise SolveError(
            "the stiffness between the rings is lost in rounding: a rigid motion of both meets "
            f"{share:.1e} of its terms; use a finer mesh or a thicker foil."
        )


def terms_of_sheet(system: InterfaceSystem, inner: np.ndarray, motions: np.ndarray) -> np.ndarray:
    """Terms that cancel in the energy of each motion of rings and interior."""
    interior = system.interior
    coupled = 2 * np.sum(np.abs(inner) * (np.abs(system.coupling) @ np.abs(motions)), axis=0)
    terms = coupled + _absolute(system.interface, motions)
    if isinstance(interior, Updated):
        low_rank = np.abs(interior.factors.T) @ np.abs(inner)
        terms += np.abs(interior.weights) @ low_rank**2
        interior = interior.sparse
    return terms + _absolute(interior, inner)


def _absolute(matrix: np.ndarray | sparse.csr_matrix, motions: np.ndarray) -> np.ndarray:
    """Quadratic form of each column, all of its terms with the same sign."""
    moved = np.abs(motions)
    return np.sum(moved * (abs(matrix) @ moved), axis=0)


def bordered(system: InterfaceSystem) -> sparse.csr_matrix | Updated:
    """One sparse matrix with the ring motions as last unknowns."""
    inner = system.interior
    if isinstance(inner, Updated):  # coupling and interface hold all of their part of the term
        whole = bordered(InterfaceSystem(inner.sparse, system.coupling, system.interface))
        factors = np.vstack([inner.factors, np.zeros((INTERFACE, inner.weights.size))])
        return Updated(whole, factors, inner.weights)
    border = sparse.csr_matrix(system.coupling)
    return sparse.block_array([[inner, border], [border.T, system.interface]], format="csr")
