"""Craig-Bampton reduction: constraint modes and modes with the rings held.

R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA J. 6 (1968)
1313-1319.
"""

from __future__ import annotations

import numpy as np

from foilstudy.linalg import modes_below
from foilstudy.measure.dynamics.accuracy import judged
from foilstudy.measure.dynamics.reduction import ReducedModel, project
from foilstudy.measure.dynamics.reductions.by_need import Modal
from foilstudy.measure.dynamics.structure import Structure


class CraigBampton(Modal):
    """Keep every clamped mode below a cut-off frequency."""

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure.

        Raises
        ------
        SolveError
            If a factorisation or the mode search fails.
        """
        limit = (2 * np.pi * self.cutoff_hz) ** 2
        k, m = structure.stiffness.interior, structure.mass.interior
        modes = modes_below(k, m, limit, self.modes_max)
        model = project(structure, modes.shapes, "craig_bampton")
        return judged(structure, model, self.wanted)
