"""The linear system that a reduction starts from: a sheet between two rigid rings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.measure.stiffness import InterfaceSystem, StaticCondensation, condense

INTERFACE = 12
"""Motions of the two rings; they are the first coordinates of every reduced model."""
RIGID_MODES = 6
_RESISTANCE = 1e-6
"""Of a rigid motion, relative to the terms that cancel; that of sheets is 1e-9 or less."""


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
            If the interior stiffness, rings held, is singular.
        ValueError
            If a rigid motion of both rings meets resistance.
        """
        static = condense(stiffness)
        moved = np.abs(rigid_motions)
        resistance = np.einsum("im,ij,jm->m", rigid_motions, static.stiffness, rigid_motions)
        terms = np.einsum("im,ij,jm->m", moved, np.abs(static.stiffness), moved)
        if (np.abs(resistance) > _RESISTANCE * terms).any():
            raise ValueError(
                "a rigid motion of both rings meets a resistance of "
                f"{np.max(np.abs(resistance) / terms):.1e} of its terms: the sheet is held by "
                "something else than its rings, or a ring's motion is not rigid."
            )
        return cls(stiffness, mass, static, rigid_motions)

    @property
    def stress_free(self) -> bool:
        """Whether all rigid motions cost nothing."""
        return self.rigid_motions.shape[1] == RIGID_MODES

    @property
    def rigid_modes(self) -> int:
        """Number of motions without stiffness."""
        return self.rigid_motions.shape[1]


def bordered(system: InterfaceSystem) -> sparse.csr_matrix:
    """One sparse matrix with the ring motions as last unknowns."""
    border = sparse.csr_matrix(system.coupling)
    return sparse.block_array(
        [[system.interior, border], [border.T, system.interface]], format="csr"
    )
