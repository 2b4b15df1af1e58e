"""What paths by continuation have in common: from a trace of equilibria to an arrival.

They follow equilibria of the sheet whose rings are moved together, so that they are static all the
way; where such a path ends before the gap is closed, so does the crumple.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

import numpy as np

from foilstudy.base.costs import Cost, measured
from foilstudy.base.errors import Refusal
from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.continuation import Correction, March, Rule, Trace, follow
from foilstudy.solve.continuation.pushed_sheet import PushedSheet
from foilstudy.solve.equilibrium.settle import SettleOptions, settle
from foilstudy.solve.paths import Arrival
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import History
from foilstudy.solve.relaxation.scheme import Scheme


@dataclass(frozen=True)
class ContinuedPath:
    """A `Path` by continuation; a strategy gives its rule of stepping.

    Attributes
    ----------
    first_step : float
        Share of the shortening in the first step. The published foil of 500 um buckles at 0.003
        to 0.01.
    longest_step : float
        Bound of a step, over the first one.
    budget : int
        Factorisations at most.
    settling : SettleOptions
        Its tolerance is that of the path; a shape from elsewhere is minimised by it, without
        relaxation.
    """

    kind: ClassVar[str]
    first_step: float = 0.002
    longest_step: float = 20.0
    budget: int = 1000
    settling: SettleOptions = field(default_factory=SettleOptions)

    @classmethod
    def for_study(
        cls, ramp_steps: int, scheme: Scheme, settling: SettleOptions, check_interval: int
    ) -> Self:
        """See `Path`."""
        return cls(settling=settling)

    def rule(self) -> Rule:
        """How the path steps."""
        raise NotImplementedError

    def follow(self, problem: Problem, shortening: float) -> Arrival:
        """See `Path`.

        Raises
        ------
        Refusal
            If the problem has a memory, of which a path of equilibria knows nothing.
        """
        if problem.has_memory:
            raise Refusal(
                f"method.path: {self.kind} follows elastic equilibria and would lose the memory of "
                "the material; use relaxation."
            )
        tolerance = self.settling.residual_tolerance
        sheet = PushedSheet(problem, shortening, tolerance)
        march = March(
            first=self.first_step,
            longest=self.longest_step,
            budget=self.budget,
            correction=Correction(tolerance),
        )
        with measured() as cost:
            trace = follow(sheet, np.zeros(sheet.size), self.rule(), march)
        return _arrived(problem, sheet, trace, cost)

    def push(self, problem: Problem, shortening: float) -> Arrival:
        """See `Path`: nothing is near an equilibrium that is none, so this is `follow`."""
        return self.follow(problem, shortening)

    def relax(self, problem: Problem, points: np.ndarray) -> Arrival:
        """See `Path`: there is no motion, so this is `settle`."""
        return self.settle(problem, points)

    def settle(self, problem: Problem, points: np.ndarray) -> Arrival:
        """See `Path`."""
        options = replace(self.settling, relaxation_steps_max=0)
        with measured() as cost:
            settled = settle(problem, Scheme().start(problem), points, options)
        return Arrival(
            settled.status, settled.message, settled.points, settled.residual,
            settled.negative_eigenvalues, 0, settled.newton_steps, settled.hessians, None,
            {"settling": cost},
        )  # fmt: skip


def _arrived(problem: Problem, sheet: PushedSheet, trace: Trace, cost: Cost) -> Arrival:
    if not trace.points:
        return Arrival(
            "failed", trace.message, problem.reference, np.nan, None, 0, 0, trace.factorisations,
            None, {"continuation": cost},
        )  # fmt: skip
    last = trace.points[-1]
    status, words = _outcome(trace)
    corrections = sum(point.iterations for point in trace.points)
    return Arrival(
        status, words, sheet.points(last.q, last.factor), last.residual,
        last.negative_eigenvalues, len(trace.points) - 1, corrections, trace.factorisations,
        _history(problem, sheet, trace), {"continuation": cost},
    )  # fmt: skip


def _outcome(trace: Trace) -> tuple[str, str]:
    """Status and sentence: usable is only what has closed the gap."""
    last, spent = trace.points[-1], f"{trace.factorisations} factorisations"
    if trace.status != "converged":
        share = f"{100 * trace.farthest:.3g} % of the shortening"
        why = "their budget was spent" if trace.status == "budget_spent" else trace.message
        return "failed", f"the path came to {share} with {spent}: {why}"
    leaps = sum(point.leapt for point in trace.points)
    how = f"relative residual {last.residual:.1e} with {spent}, {leaps} leaps to other paths"
    if last.negative_eigenvalues:
        count = last.negative_eigenvalues
        return "not_converged", f"an unstable equilibrium, {count} negative eigenvalues: {how}"
    return "converged", how


def _history(problem: Problem, sheet: PushedSheet, trace: Trace) -> History:
    """The equilibria one after the other; nothing moves."""
    shapes = [sheet.points(point.q, point.factor) for point in trace.points]
    energies = np.array([problem.force(shape, np.empty_like(shape)) for shape in shapes])
    return History(
        np.arange(len(shapes)),
        np.array([shape[2, -RING_ROWS:].mean() for shape in shapes]),
        np.array([point.force for point in trace.points]),
        dict(zip(problem.energy_names, energies.T, strict=True)),
        np.zeros(len(shapes)),
        np.array([point.residual for point in trace.points]),
    )
