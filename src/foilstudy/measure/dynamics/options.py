"""What is asked of the dynamics of a structure, as data."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.spec import choice_field
from foilstudy.measure.choices import REDUCTIONS, STRUCTURAL_DAMPINGS
from foilstudy.measure.dynamics.accuracy import Wanted
from foilstudy.measure.dynamics.damping import Damping, ModalDamping
from foilstudy.measure.dynamics.reduction import ReducedModel
from foilstudy.measure.dynamics.response import frequency_grid
from foilstudy.measure.dynamics.structure import Structure


@dataclass(frozen=True)
class DynamicsOptions:
    """Reduction, accuracy, band and damping; how many modes are kept.

    Attributes
    ----------
    reduction : str
        A name of `foilstudy.measure.choices.REDUCTIONS`.
    tolerance : float
        Largest relative error of the reduction in the band.
    cutoff_hz : float or None
        Of a modal reduction; None lets the tolerance decide.
    lowest_hz, highest_hz : float
        Band.
    frequencies : int
        In it, spaced logarithmically.
    damping : Damping
    eigenfrequencies, mode_shapes : int
        With both rings held.
    """

    reduction: str = "rational_krylov"
    tolerance: float = 1e-3
    cutoff_hz: float | None = None
    lowest_hz: float = 1.0
    highest_hz: float = 800.0
    frequencies: int = 200
    damping: Damping = choice_field(STRUCTURAL_DAMPINGS, lambda: ModalDamping(0.05))
    eigenfrequencies: int = 20
    mode_shapes: int = 6

    @property
    def grid(self) -> np.ndarray:
        """Frequencies, Hz."""
        return frequency_grid(self.lowest_hz, self.highest_hz, self.frequencies)

    def reduced(self, structure: Structure) -> ReducedModel:
        """Reduced model of a structure, with its error estimate for the band.

        Raises
        ------
        SolveError
            If a factorisation or a mode search fails.
        """
        wanted = Wanted(self.tolerance, self.lowest_hz, self.highest_hz, self.damping)
        return REDUCTIONS[self.reduction].for_band(wanted, self.cutoff_hz).reduce(structure)
