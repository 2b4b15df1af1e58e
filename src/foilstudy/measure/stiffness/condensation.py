"""Static condensation of a sheet onto its rings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import (
    Factorisation,
    SolveError,
    SymmetricBlocks,
    Updated,
    factorise,
    updated,
)
from foilstudy.measure.stiffness.rings import Rings


@dataclass(frozen=True)
class InterfaceSystem:
    """A matrix of the sheet split into its interior and the twelve interface motions."""

    interior: sparse.csr_matrix | Updated
    coupling: np.ndarray
    interface: np.ndarray

    def __repr__(self) -> str:
        return f"<InterfaceSystem: {self.interior.shape[0]} interior unknowns>"

    def __add__(self, other: InterfaceSystem) -> InterfaceSystem:
        """Of two without a term of low rank."""
        return InterfaceSystem(
            (self.interior + other.interior).tocsr(),
            self.coupling + other.coupling,
            self.interface + other.interface,
        )

    @classmethod
    def split(cls, matrix: sparse.csr_matrix, rings: Rings) -> InterfaceSystem:
        """Split a matrix on all control points by the rings."""
        interior_rows = matrix[rings.interior[0] : rings.interior[-1] + 1]
        boundary_rows = matrix[rings.boundary]
        return cls(
            interior_rows[:, rings.interior[0] : rings.interior[-1] + 1].tocsr(),
            interior_rows[:, rings.boundary] @ rings.motion,
            rings.motion.T @ (boundary_rows[:, rings.boundary] @ rings.motion),
        )

    def updated(
        self, interior: np.ndarray, rings: np.ndarray, weights: np.ndarray
    ) -> InterfaceSystem:
        """With a term of low rank U diag(w) U^T more.

        Parameters
        ----------
        interior, rings : ndarray, shape (interior unknowns, r) and (12, r)
            U.
        weights : ndarray, shape (r,)
        """
        weighted = rings * weights
        return InterfaceSystem(
            updated(self.interior, interior, weights),
            self.coupling + interior @ weighted.T,
            self.interface + weighted @ rings.T,
        )


@dataclass(frozen=True)
class StaticCondensation:
    """The interface stiffness and what led to it.

    Attributes
    ----------
    stiffness : ndarray, shape (12, 12)
        Forces and moments on the rings per interface motion, symmetric.
    constraint_modes : ndarray, shape (interior, 12)
        Interior displacement per unit interface motion.
    factor : Factorisation
        Of the interior stiffness (rings clamped).
    """

    stiffness: np.ndarray
    constraint_modes: np.ndarray
    factor: Factorisation

    def __repr__(self) -> str:
        return f"<StaticCondensation: {len(self.constraint_modes)} interior unknowns>"


def factorise_held(
    interior: sparse.csr_matrix | SymmetricBlocks | Updated,
) -> Factorisation:
    """Factor the stiffness with held rings.

    Raises
    ------
    SolveError
        If it is singular to working precision.
    """
    try:
        return factorise(interior)
    except SolveError as error:
        raise SolveError(
            "the stiffness with held rings is singular to working precision, as that of a foil too "
            f"thin for its mesh; use a finer mesh or a thicker foil ({error})"
        ) from error


def condense(system: InterfaceSystem) -> StaticCondensation:
    """S = K_bb - K_bi K_ii^-1 K_ib.

    Raises
    ------
    SolveError
        If the interior stiffness is singular to working precision.
    """
    factor = factorise_held(system.interior)
    modes = -factor.solve(system.coupling)
    stiffness = system.interface + system.coupling.T @ modes
    return StaticCondensation(0.5 * (stiffness + stiffness.T), modes, factor)
