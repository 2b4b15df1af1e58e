"""Stiffness from the way of a ring that is pulled: the published probe."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.linalg import SolveError
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.measures import MeasuredStiffness
from foilstudy.pipeline.measures.probing import combined, doubt, in_words, require_others
from foilstudy.solve.equilibrium.guided import Guide, guided, untouched
from foilstudy.solve.problem import Problem


@dataclass(frozen=True)
class ForceProbe:
    """The top ring of the stress-free crumple under a dead force; force over displacement.

    First order in the force against the tangent. A minimum is sought: where the force takes the
    foil past a limit point, it is the one that the foil snaps to.

    Attributes
    ----------
    force : float
        N; positive ones pull the rings apart, or along x and y.
    others : str
        ``held`` or ``free``: the motions of the top ring in other directions.
    """

    kind = "force_probe"
    force: float = 100.0
    others: str = "held"

    def __post_init__(self) -> None:
        require_others(self.others)
        require_number("size of a force probe", abs(self.force), "N", above=0)

    def of(self, crumpled: Crumpled) -> MeasuredStiffness:
        """See `StiffnessMeasure`."""
        problem = Problem(crumpled.relieved())
        rest = untouched(problem, crumpled.points)
        along, reasons = np.full(3, np.nan), []
        for axis in range(3):
            force = np.zeros(6)
            force[axis] = self.force
            free = (axis,) if self.others == "held" else tuple(range(6))
            try:
                found = guided(problem, crumpled.points, Guide(free=free, force=force))
            except SolveError as error:
                reasons.append(str(error))
                continue
            if found.status == "converged":
                along[axis] = self.force / found.motion[axis]
                reasons.append(doubt(rest, found, axis))
            else:
                reasons.append(
                    f"no equilibrium with {self.force:g} N along {'xyz'[axis]}: {found.message}"
                )
        return MeasuredStiffness(combined(along, self.others), in_words(reasons))
