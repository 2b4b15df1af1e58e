"""Hintz-Herting reduction: constraint modes, inertia relief, residualised free-free modes.

R. M. Hintz, Analytical methods in component modal synthesis, AIAA J. 13 (1975) 1007-1016;
D. N. Herting, A general purpose, multi-stage, component modal synthesis method, Finite Elements in
Analysis and Design 1 (1985) 153-164.
"""

from __future__ import annotations

import numpy as np

from foilstudy.linalg import modes_below
from foilstudy.measure.dynamics.accuracy import judged
from foilstudy.measure.dynamics.reduction import ReducedModel, project
from foilstudy.measure.dynamics.reductions.by_need import Modal
from foilstudy.measure.dynamics.structure import INTERFACE, Structure, bordered

_APART = 1e-4
"""Lowest cut-off over the first elastic mode of rings and a foil in tow, both squared: nearer
to zero, rounding does not tell the rigid modes from the cut-off."""


class HintzHerting(Modal):
    """Keep every free-free mode below a cut-off frequency.

    A cut-off below a hundredth of the first elastic frequency is raised to that.
    """

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure.

        Raises
        ------
        SolveError
            If a factorisation or the mode search fails.
        """
        m, static = structure.mass, structure.static
        limit = max((2 * np.pi * self.cutoff_hz) ** 2, _APART * _first_elastic(structure))
        modes = modes_below(bordered(structure.stiffness), bordered(m), limit, self.modes_max)
        constraint = static.constraint_modes
        by_size = np.argsort(np.abs(modes.eigenvalues))
        elastic = modes.shapes[:, np.sort(by_size[structure.rigid_modes :])]
        residualised = elastic[:-INTERFACE] - constraint @ elastic[-INTERFACE:]
        relief = static.factor.solve(m.interior @ constraint + m.coupling)
        if structure.stress_free:  # rigid motions only: inertia relief in the proper sense
            relief = relief @ structure.rigid_motions
        basis = _orthonormal(np.hstack([relief, residualised]))
        return judged(structure, project(structure, basis, "hintz_herting"), self.wanted)


def _first_elastic(structure: Structure) -> float:
    """Lowest eigenvalue of a static reduction that is not of a rigid motion, rad2/s2."""
    nothing = np.empty((structure.mass.interior.shape[0], 0))
    values, _ = project(structure, nothing, "guyan").free_modes()
    return float(np.sort(np.abs(values))[structure.rigid_modes])


def _orthonormal(vectors: np.ndarray) -> np.ndarray:
    """Orthonormal basis of the columns, without the directions they do not span."""
    q, r = np.linalg.qr(vectors / np.linalg.norm(vectors, axis=0))
    return q[:, np.abs(np.diag(r)) > 1e-9]
