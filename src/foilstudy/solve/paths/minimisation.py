"""Displacement steps, each to a stable equilibrium: the static way that does arrive.

Where a step makes the sheet unstable, the minimisation leaves the saddle along the lowest mode and
goes downhill to wherever that leads: a snap without inertia, which no continuous path could follow.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from foilstudy.base.costs import measured
from foilstudy.solve.continuation.pushed_sheet import PushedSheet
from foilstudy.solve.equilibrium.newton import NewtonResult
from foilstudy.solve.equilibrium.settle import minimised
from foilstudy.solve.paths import Arrival
from foilstudy.solve.paths.static import StaticPath, static_history
from foilstudy.solve.problem import Problem


@dataclass(frozen=True)
class MinimisationPath(StaticPath):
    """The rings come nearer in equal steps, after each of which the energy is minimised.

    Attributes
    ----------
    settling : SettleOptions
        See `StaticPath`; its search is used, and as many tangents for a step as for the last round
        of settling.
    steps : int
    budget : int
        Tangents formed at most, over all steps.
    """

    kind = "minimisation"
    steps: int = 50
    budget: int = 1000

    def pushed(self, problem: Problem, shortening: float) -> Arrival:
        """See `StaticPath`."""
        shapes, results = [problem.reference], []
        with measured() as cost:
            for shape, result in self._stable(problem, PushedSheet(problem, shortening)):
                shapes.append(shape)
                results.append(result)
        last, tangents = results[-1], sum(result.iterations for result in results)
        status, message = last.status, f"{len(results)} steps, {tangents} tangents; {last.message}"
        arrived = status == "converged"
        reached = 1.0 if arrived else (len(results) - 1) / self.steps
        if not arrived:
            status = "failed"
            message = f"the path came to {100 * reached:.3g} % of the shortening: {message}"
        residuals = [0.0, *(result.residual for result in results)]
        return Arrival(
            status, message, shapes[-1], last.residual, last.negative_eigenvalues, len(results),
            sum(result.steps for result in results), tangents,
            static_history(problem, shapes, residuals), {"minimisation": cost}, reached=reached,
            budget_spent=not arrived and tangents >= self.budget,
        )  # fmt: skip

    def _stable(
        self, problem: Problem, sheet: PushedSheet
    ) -> Iterator[tuple[np.ndarray, NewtonResult]]:
        """Shapes and what the search says of them, until one is not found."""
        shape, spent = problem.reference, 0
        step = sheet.motion / self.steps
        for _ in range(self.steps):
            most = min(self.settling.hessians_last, self.budget - spent)
            shape, result = minimised(problem, shape + step, self.settling, most)
            spent += result.iterations
            yield shape, result
            if result.status != "converged":
                return
