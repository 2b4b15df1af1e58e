"""What paths by continuation have in common: from a trace of equilibria to an arrival."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.costs import Cost, measured
from foilstudy.solve.continuation import Correction, March, Rule, Trace, follow
from foilstudy.solve.continuation.pushed_sheet import PushedSheet
from foilstudy.solve.paths import Arrival
from foilstudy.solve.paths.static import StaticPath, static_history
from foilstudy.solve.problem import Problem


@dataclass(frozen=True)
class ContinuedPath(StaticPath):
    """A `Path` by continuation; a strategy gives its rule of stepping.

    Attributes
    ----------
    settling : SettleOptions
        See `StaticPath`.
    first_step : float
        Share of the shortening in the first step. The published foil of 500 um comes to its first
        limit point at 0.006 (on elements of 18 mm) to 0.011 (of 10 mm).
    longest_step : float
        Bound of a step, over the first one.
    budget : int
        Factorisations at most.
    """

    first_step: float = 0.002
    longest_step: float = 20.0
    budget: int = 1000

    def rule(self) -> Rule:
        """How the path steps."""
        raise NotImplementedError

    def pushed(self, problem: Problem, shortening: float) -> Arrival:
        """See `StaticPath`."""
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


def _arrived(problem: Problem, sheet: PushedSheet, trace: Trace, cost: Cost) -> Arrival:
    if not trace.points:
        return Arrival(
            "failed", trace.message, problem.reference, np.nan, None, 0, 0, trace.factorisations,
            None, {"continuation": cost},
        )  # fmt: skip
    last = trace.points[-1]
    status, words = _outcome(trace)
    corrections = sum(point.iterations for point in trace.points)
    shapes = [sheet.points(point.q, point.factor) for point in trace.points]
    history = static_history(problem, shapes, [point.residual for point in trace.points])
    return Arrival(
        status, words, shapes[-1], last.residual, last.negative_eigenvalues,
        len(trace.points) - 1, corrections, trace.factorisations, history,
        {"continuation": cost}, reached=trace.farthest,
        budget_spent=trace.status == "budget_spent",
    )  # fmt: skip


def _outcome(trace: Trace) -> tuple[str, str]:
    """Status and sentence: usable is only what has closed the gap."""
    last, spent = trace.points[-1], f"{trace.factorisations} factorisations"
    if trace.status != "converged":
        share = f"{100 * trace.farthest:.3g} % of the shortening"
        return "failed", f"the path came to {share} with {spent}: {trace.reason}"
    leaps = sum(point.leapt for point in trace.points)
    how = f"relative residual {last.residual:.1e} with {spent}, {leaps} leaps to other paths"
    if last.negative_eigenvalues:
        count = last.negative_eigenvalues
        return "not_converged", f"an unstable equilibrium, {count} negative eigenvalues: {how}"
    return "converged", how
