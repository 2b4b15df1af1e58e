"""The path of the studies: a ramp with relaxation, then settling.

The motion goes on from the ramp into the relaxation, as stopping in between would lead elsewhere;
and its dampers go on from the relaxation into the settling.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from foilstudy.base.costs import Cost, measured
from foilstudy.solve.equilibrium.settle import SettleOptions, SettleResult, settle
from foilstudy.solve.pace import RAMP_STEPS
from foilstudy.solve.paths import Arrival
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import Ramp, RelaxationResult, StoppingRule, relax
from foilstudy.solve.relaxation.scheme import Scheme


@dataclass(frozen=True)
class RelaxationPath:
    """Explicit relaxation until the residual is moderate, then minimisation.

    Attributes
    ----------
    ramp_steps : int
        Pseudo-time steps in which the top ring closes the gap.
    scheme : Scheme
    settling : SettleOptions
        Its `relaxation_steps_max` counts from the end of the ramp.
    check_interval : int
        Steps between two checks and two history entries.
    """

    kind = "relaxation"
    ramp_steps: int = RAMP_STEPS
    scheme: Scheme = field(default_factory=Scheme)
    settling: SettleOptions = field(default_factory=SettleOptions)
    check_interval: int = 20

    @classmethod
    def for_study(
        cls, ramp_steps: int, scheme: Scheme, settling: SettleOptions, check_interval: int
    ) -> RelaxationPath:
        """See `Path`."""
        return cls(ramp_steps, scheme, settling, check_interval)

    def follow(
        self, problem: Problem, shortening: float, start: np.ndarray | None = None
    ) -> Arrival:
        """See `Path`."""
        motion, settling = self.scheme.start(problem), self.settling
        with measured() as relaxing:
            relaxed = relax(problem, motion, self._ramp(shortening), self.stopping_rule(), start)
        if relaxed.status == "diverged":
            return ended(relaxed, {"relaxing": relaxing})
        left = settling.relaxation_steps_max - (relaxed.steps - self.ramp_steps)
        settling = replace(settling, relaxation_steps_max=left)
        with measured() as cost:
            settled = settle(problem, motion, relaxed.points, settling)
        return arrived(problem, settled, {"relaxing": relaxing, "settling": cost}, relaxed)

    def push(self, problem: Problem, shortening: float, start: np.ndarray | None = None) -> Arrival:
        """See `Path`."""
        return self._relaxed(problem, self._ramp(shortening), start)

    def relax(self, problem: Problem, points: np.ndarray) -> Arrival:
        """See `Path`."""
        return self._relaxed(problem, Ramp(0.0, 0), points)

    def _relaxed(self, problem: Problem, ramp: Ramp, points: np.ndarray | None) -> Arrival:
        with measured() as cost:
            relaxed = relax(problem, self.scheme.start(problem), ramp, self.stopping_rule(), points)
        state = problem.state if problem.has_memory else ()
        return replace(ended(relaxed, {"relaxing": cost}), state=state)

    def _ramp(self, shortening: float) -> Ramp:
        return Ramp(shortening, self.ramp_steps)

    def stopping_rule(self) -> StoppingRule:
        """Of the relaxation after a ramp."""
        settling = self.settling
        return StoppingRule(
            settling.switch_residual, settling.relaxation_steps_max, self.check_interval
        )

    def settle(self, problem: Problem, points: np.ndarray) -> Arrival:
        """See `Path`."""
        with measured() as cost:
            settled = settle(problem, self.scheme.start(problem), points, self.settling)
        return arrived(problem, settled, {"settling": cost})


def ended(relaxed: RelaxationResult, costs: Mapping[str, Cost]) -> Arrival:
    """Where a relaxation has ended, without settling."""
    return Arrival(
        relaxed.status, relaxed.message, relaxed.points, relaxed.residual, None,
        relaxed.steps, 0, 0, relaxed.history, costs, shortened_steps=relaxed.shortened_steps,
    )  # fmt: skip


def arrived(
    problem: Problem,
    settled: SettleResult,
    costs: Mapping[str, Cost],
    relaxed: RelaxationResult | None = None,
) -> Arrival:
    """Where settling has ended, after a relaxation."""
    before = relaxed.steps if relaxed else 0
    return Arrival(
        settled.status, settled.message, settled.points, settled.residual,
        settled.negative_eigenvalues, before + settled.relaxation_steps, settled.newton_steps,
        settled.hessians, relaxed.history if relaxed else None, costs,
        problem.state if problem.has_memory else (),
        shortened_steps=settled.shortened_steps,
    )  # fmt: skip
