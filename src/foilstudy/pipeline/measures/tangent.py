"""Stiffness from the derivative of the forces: the limit of every small probe."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.measure.stiffness import fixed_stiffness, free_stiffness
from foilstudy.measure.stiffness.condensation import condense
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.measures import MeasuredStiffness
from foilstudy.pipeline.measures.probing import require_others
from foilstudy.pipeline.structures import prestressed_stiffness, stress_free_stiffness


@dataclass(frozen=True)
class Tangent:
    """Static condensation of the consistent tangent onto the rings.

    Attributes
    ----------
    stressed : bool
        Whether the stress of crumpling is left in.
    others : str
        ``held`` or ``free``: the motions of the top ring in other directions.
    """

    kind = "tangent"
    stressed: bool = False
    others: str = "held"

    def __post_init__(self) -> None:
        require_others(self.others)

    def of(self, crumpled: Crumpled) -> MeasuredStiffness:
        """See `StiffnessMeasure`."""
        system = prestressed_stiffness if self.stressed else stress_free_stiffness
        try:
            stiffness = condense(system(crumpled)).stiffness
        except SolveError as error:
            return MeasuredStiffness(np.full(2, np.nan), str(error))
        if self.others == "held":
            return MeasuredStiffness(fixed_stiffness(stiffness))
        if falling := int((np.linalg.eigvalsh(stiffness[6:, 6:]) <= 0).sum()):
            return MeasuredStiffness(
                np.full(2, np.nan),
                f"a ring that is free falls from this equilibrium in {falling} of its 6 motions",
            )
        return MeasuredStiffness(free_stiffness(stiffness))
