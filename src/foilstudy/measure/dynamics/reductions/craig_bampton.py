"""Craig-Bampton reduction: constraint modes and modes with the rings held.

R. R. Craig, M. C. C. Bampton, Coupling of substructures for dynamic analyses, AIAA J. 6 (1968)
1313-1319.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import modes_below
from foilstudy.measure.dynamics.accuracy import Wanted, judged
from foilstudy.measure.dynamics.reduction import ReducedModel, Reduction, project
from foilstudy.measure.dynamics.reductions.by_need import ByNeed
from foilstudy.measure.dynamics.structure import Structure


@dataclass(frozen=True)
class CraigBampton:
    """Keep every clamped mode below a cut-off frequency.

    Attributes
    ----------
    cutoff_hz : float
    wanted : Wanted, optional
        What the error is estimated for.
    """

    cutoff_hz: float
    wanted: Wanted | None = None

    @classmethod
    def for_band(cls, wanted: Wanted, cutoff_hz: float | None = None) -> Reduction:
        """See `Reduction`; without a cut-off, as many modes as the tolerance needs."""
        return ByNeed(cls, wanted) if cutoff_hz is None else cls(cutoff_hz, wanted)

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure.

        Raises
        ------
        SolveError
            If a factorisation or the mode search fails.
        """
        limit = (2 * np.pi * self.cutoff_hz) ** 2
        modes = modes_below(structure.stiffness.interior, structure.mass.interior, limit)
        model = project(structure, modes.shapes, "craig_bampton")
        return judged(structure, model, self.wanted)
