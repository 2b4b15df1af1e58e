"""Stiffness from the force on a ring that is moved there and back."""

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
class DisplacementProbe:
    """The top ring moved by plus and minus d; difference of the forces over 2 d.

    Second order in d against the tangent, as long as the foil does not snap.

    Attributes
    ----------
    sizes : tuple of float
        Of d, in turn, each from the shape that the one before has reached, m. The last one is the
        stiffness.
    stressed : bool
        Whether the stress of crumpling is left in.
    others : str
        ``held`` or ``free``: the motions of the top ring in other directions.
    """

    kind = "displacement_probe"
    sizes: tuple[float, ...] = (1e-4, 1e-3)
    stressed: bool = False
    others: str = "held"

    def __post_init__(self) -> None:
        require_others(self.others)
        if not self.sizes:
            raise ValueError("a displacement probe needs a size")
        for size in self.sizes:
            require_number("size of a displacement probe", size, "m", above=0)

    def of(self, crumpled: Crumpled) -> MeasuredStiffness:
        """See `StiffnessMeasure`."""
        problem = crumpled.problem() if self.stressed else Problem(crumpled.relieved())
        along = np.full((len(self.sizes), 3), np.nan)
        reasons = []
        for axis in range(3):
            try:
                along[:, axis] = self._along(problem, crumpled.points, axis, reasons)
            except SolveError as error:
                reasons.append(str(error))
        levels = tuple(combined(each, self.others) for each in along)
        return MeasuredStiffness(levels[-1], in_words(reasons), levels)

    def _along(
        self, problem: Problem, points: np.ndarray, axis: int, reasons: list[str]
    ) -> np.ndarray:
        """Stiffness along an axis by the sizes; NaN from the first that finds no equilibrium."""
        stiffness = np.full(len(self.sizes), np.nan)
        rest = untouched(problem, points)
        free = tuple(k for k in range(6) if k != axis) if self.others == "free" else ()
        ends = [rest, rest]
        for level, size in enumerate(self.sizes):
            for end, side in enumerate((1, -1)):
                motion = np.zeros(6)
                motion[axis] = side * size
                # what held the ring goes on to do so, that it moves by the probe alone
                found = guided(problem, points, Guide(motion, free, rest.pull[1]), ends[end])
                if found.status != "converged":
                    reasons.append(
                        f"no equilibrium with the ring moved by {1e3 * side * size:g} mm along "
                        f"{'xyz'[axis]}: {found.message}"
                    )
                    return stiffness
                reasons.append(doubt(rest, found, axis))
                ends[end] = found
            ahead, behind = (end.pull[1, axis] for end in ends)
            stiffness[level] = (ahead - behind) / (2 * size)
        return stiffness
