"""Hintz-Herting reduction: constraint modes, inertia relief, residualised free-free modes.

R. M. Hintz, Analytical methods in component modal synthesis, AIAA J. 13 (1975) 1007-1016;
D. N. Herting, A general purpose, multi-stage, component modal synthesis method, Finite Elements in
Analysis and Design 1 (1985) 153-164.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse

from foilstudy.dynamics.reduction import INTERFACE, ReducedModel, Structure, project
from foilstudy.linalg import modes_below

_RIGID_MODES = 6


@dataclass(frozen=True)
class HintzHerting:
    """Keep every free-free mode below a cut-off frequency.

    Attributes
    ----------
    cutoff_hz : float
    """

    cutoff_hz: float

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure.

        Raises
        ------
        SolveError
            If a factorisation or the mode search fails.
        """
        k, m, static = structure.stiffness, structure.mass, structure.static
        modes = modes_below(
            _bordered(k.interior, k.coupling, k.interface),
            _bordered(m.interior, m.coupling, m.interface),
            limit=(2 * np.pi * self.cutoff_hz) ** 2,
        )
        elastic = modes.shapes[:, _RIGID_MODES:]
        constraint = static.constraint_modes
        residualised = elastic[:-INTERFACE] - constraint @ elastic[-INTERFACE:]
        rigid = modes.shapes[-INTERFACE:, :_RIGID_MODES]
        inertia = m.interior @ (constraint @ rigid) + m.coupling @ rigid
        relief = static.factor.solve(inertia)
        basis = _orthonormal(np.hstack([relief, residualised]))
        return project(structure, basis, elastic.shape[1])


def _bordered(interior, coupling, interface) -> sparse.csr_matrix:
    """One sparse matrix with the ring motions as last unknowns."""
    border = sparse.csr_matrix(coupling)
    return sparse.bmat([[interior, border], [border.T, interface]], format="csr")


def _orthonormal(vectors: np.ndarray) -> np.ndarray:
    """Orthonormal basis of the columns, without the directions they do not span."""
    q, r = np.linalg.qr(vectors / np.linalg.norm(vectors, axis=0))
    return q[:, np.abs(np.diag(r)) > 1e-9]
