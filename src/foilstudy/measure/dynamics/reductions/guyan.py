"""Guyan reduction: the interior follows the rings statically.

R. J. Guyan, Reduction of stiffness and mass matrices, AIAA J. 3 (1965) 380.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.measure.dynamics.accuracy import Wanted, judged
from foilstudy.measure.dynamics.reduction import ReducedModel, project
from foilstudy.measure.dynamics.structure import Structure


@dataclass(frozen=True)
class Guyan:
    """Constraint modes only: right at rest, and well below the first mode.

    Attributes
    ----------
    wanted : Wanted, optional
        What the error is estimated for.
    """

    wanted: Wanted | None = None

    @classmethod
    def for_band(cls, wanted: Wanted, cutoff_hz: float | None = None) -> Guyan:
        """See `Reduction`; there is no cut-off."""
        return cls(wanted)

    def reduce(self, structure: Structure) -> ReducedModel:
        """Reduced model of the structure."""
        basis = np.empty((structure.mass.interior.shape[0], 0))
        return judged(structure, project(structure, basis, "guyan"), self.wanted)
