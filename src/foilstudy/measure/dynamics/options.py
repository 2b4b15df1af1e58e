"""What is asked of the dynamics of a structure, as data."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.ranges import require_count, require_number
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

    def __post_init__(self):
        REDUCTIONS.choice(self.reduction)
        self.wanted  # noqa: B018  # refuses what is no tolerance and no band
        if self.cutoff_hz is not None:
            require_number("cut-off of a reduction", self.cutoff_hz, "Hz", above=0)
        require_count("number of frequencies", self.frequencies, 2)
        require_count("number of eigenfrequencies", self.eigenfrequencies, 1)
        require_count("number of mode shapes", self.mode_shapes, 0)

    def __repr__(self) -> str:
        return (
            f"<DynamicsOptions: {self.lowest_hz:g} to {self.highest_hz:g} Hz, {self.reduction} to "
            f"{self.tolerance:g}, {self.damping}>"
        )

    @property
    def wanted(self) -> Wanted:
        """Accuracy and band of the reduced model."""
        return Wanted(self.tolerance, self.lowest_hz, self.highest_hz, self.damping)

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
        return REDUCTIONS[self.reduction].for_band(self.wanted, self.cutoff_hz).reduce(structure)
