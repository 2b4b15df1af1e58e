"""What static paths have in common: equilibria of the sheet one after the other, without motion.

Where such a path ends before the gap is closed, so does the crumple.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from foilstudy.base.costs import measured
from foilstudy.base.errors import Refusal
from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.equilibrium.settle import SettleOptions, settle
from foilstudy.solve.paths import Arrival
from foilstudy.solve.paths.relaxation import arrived
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import History
from foilstudy.solve.relaxation.scheme import Scheme


@dataclass(frozen=True)
class StaticPath:
    """A `Path` without motion; a strategy gives `pushed`.

    Attributes
    ----------
    settling : SettleOptions
        Its tolerance is that of the path; a shape from elsewhere is minimised by it, without
        relaxation.
    """

    kind: ClassVar[str]
    settling: SettleOptions = field(default_factory=SettleOptions)

    @classmethod
    def for_study(
        cls, ramp_steps: int, scheme: Scheme, settling: SettleOptions, check_interval: int
    ) -> Self:
        """See `Path`."""
        return cls(settling=settling)

    def pushed(self, problem: Problem, shortening: float) -> Arrival:
        """`follow` for a problem without memory."""
        raise NotImplementedError

    def follow(
        self, problem: Problem, shortening: float, start: np.ndarray | None = None
    ) -> Arrival:
        """See `Path`.

        Raises
        ------
        Refusal
            If the problem has a memory, of which a path of equilibria knows nothing, or if it does
            not begin at the stress-free shape.
        """
        if start is not None:
            raise Refusal(
                f"method.path: {self.kind} begins at the stress-free shape, and not at one that "
                "has buckled; use relaxation."
            )
        if problem.has_memory:
            raise Refusal(
                f"method.path: {self.kind} follows elastic equilibria and would lose the memory of "
                "the material; use relaxation."
            )
        return self.pushed(problem, shortening)

    def push(self, problem: Problem, shortening: float, start: np.ndarray | None = None) -> Arrival:
        """See `Path`: nothing is near an equilibrium that is none, so this is `follow`."""
        return self.follow(problem, shortening, start)

    def relax(self, problem: Problem, points: np.ndarray) -> Arrival:
        """See `Path`: there is no motion, so this is `settle`."""
        return self.settle(problem, points)

    def settle(self, problem: Problem, points: np.ndarray) -> Arrival:
        """See `Path`."""
        options = replace(self.settling, relaxation_steps_max=0)
        with measured() as cost:
            settled = settle(problem, Scheme().start(problem), points, options)
        return arrived(problem, settled, {"settling": cost})


def static_history(
    problem: Problem, shapes: Sequence[np.ndarray], residuals: Sequence[float]
) -> History:
    """Equilibria one after the other as a history: nothing moves.

    Parameters
    ----------
    problem : Problem
    shapes : sequence of ndarray, shape (3, rows, columns)
        Control points, m.
    residuals : sequence of float
    """
    force = np.empty_like(problem.reference)
    energies, reactions = [], []
    for shape in shapes:
        energies.append(problem.force(shape, force))
        reactions.append(-float(force[2, -RING_ROWS:].sum()))
    return History(
        np.arange(len(shapes)),
        np.array([shape[2, -RING_ROWS:].mean() for shape in shapes]),
        np.array(reactions),
        dict(zip(problem.energy_names, np.array(energies).T, strict=True)),
        np.zeros(len(shapes)),
        np.array(residuals),
    )
