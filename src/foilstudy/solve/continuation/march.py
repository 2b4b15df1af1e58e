"""Following a path of equilibria, step by step."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from foilstudy.solve.continuation.branches import branch_off, singular_between
from foilstudy.solve.continuation.constraints import Increment, Metric, at_factor
from foilstudy.solve.continuation.corrector import Corrected, Correction, correct
from foilstudy.solve.continuation.equations import Equations
from foilstudy.solve.continuation.linearised import (
    BudgetSpent,
    SingularTangent,
    StepFailed,
    Workshop,
)
from foilstudy.solve.continuation.place import Place
from foilstudy.solve.continuation.rules import Rule
from foilstudy.solve.continuation.trace import Point, Trace


@dataclass(frozen=True)
class March:
    """How far a path is followed, and in what steps.

    Attributes
    ----------
    target : float
        Factor at which the path ends.
    first : float
        Of the factor in the first step, which sets the first length.
    longest, shortest : float
        Bounds of a step, over the first one.
    budget : int
        Factorisations at most.
    wanted_iterations : int
        Corrections of a step of the right length: more shorten the next one, fewer make it longer.
    correction : Correction
    """

    target: float = 1.0
    first: float = 0.02
    longest: float = 8.0
    shortest: float = 1e-4
    budget: int = 1000
    wanted_iterations: int = 4
    correction: Correction = field(default_factory=Correction)


_LONGER, _SHORTER = 2.0, 0.5
"""Largest change of the length from one step to the next."""
_HALF = 0.5


def follow(
    equations: Equations,
    start: np.ndarray,
    rule: Rule,
    march: March | None = None,
    stop: Callable[[Point], bool] | None = None,
) -> Trace:
    """Follow the equilibria from factor zero on.

    Parameters
    ----------
    equations : Equations
    start : ndarray, shape (n,)
        Near an equilibrium at factor zero.
    rule : Rule
    march : March, optional
    stop : callable, optional
        Whether a point ends the path before its target.

    Returns
    -------
    Trace
        Never raises for a path that cannot be followed: the status says so.
    """
    return _Walk(equations, rule, march or March(), stop).run(start)


class _Stuck(Exception):
    """No step is short enough; the cause is the failure of the shortest."""


class _Walk:
    """State of one march."""

    def __init__(self, equations: Equations, rule: Rule, march: March, stop):
        self._rule, self._march, self._stop = rule, march, stop
        self._workshop = Workshop(equations, march.budget)
        self._metric = Metric(1.0)
        self._shortest = self._longest = 0.0
        self._points: list[Point] = []
        self._branch = 0

    def run(self, start: np.ndarray) -> Trace:
        try:
            self._walk(start)
        except BudgetSpent:
            return self._trace("budget_spent", f"the {self._march.budget} factorisations are spent")
        except (_Stuck, StepFailed) as stuck:
            singular = isinstance(stuck.__cause__, SingularTangent)
            return self._trace("singular" if singular else "not_converged", str(stuck))
        return self._trace("converged", "followed to its end")

    def _walk(self, start: np.ndarray) -> None:
        here, length = self._begin(start)
        while here.factor < self._march.target and not self._stopped():
            there, length = self._advance(here, length)
            grown = there.negative_eigenvalues > here.negative_eigenvalues
            if self._rule.switching and grown and there.factor < self._march.target:
                there = self._switched(here, there)
            here = there
            self._note(here)

    def _begin(self, start: np.ndarray) -> tuple[Place, float]:
        """The start, and the first length."""
        origin, still = Increment(start, 0.0), Increment(0 * start, 0.0)
        try:
            found = correct(self._workshop, origin, still, at_factor(0.0), self._march.correction)
            tangent = self._workshop.tangent(found.q, found.factor)
            self._metric = self._rule.metric(tangent.velocity)
            onwards = Increment(tangent.velocity, 1.0)
            first = self._rule.predictor(tangent.velocity, onwards, self._metric)
        except StepFailed as failure:
            raise _Stuck(f"there is no start at factor 0: {failure}") from failure
        length = self._march.first / first.factor
        self._longest, self._shortest = (
            length * share for share in (self._march.longest, self._march.shortest)
        )
        place = Place(found, tangent, onwards)
        self._note(place)
        return place, length

    def _stopped(self) -> bool:
        return self._stop is not None and self._stop(self._points[-1])

    def _note(self, place: Place) -> None:
        found = place.found
        self._points.append(
            Point(
                found.factor,
                self._workshop.equations.force(found.q, found.factor),
                place.negative_eigenvalues,
                found.q,
                found.residual,
                found.iterations,
                self._workshop.spent,
                self._branch,
                place.leapt,
            )
        )

    def _advance(self, here: Place, length: float) -> tuple[Place, float]:
        """The next place, and the length of the step after it."""
        while True:
            try:
                there = self.step(here, length)
            except StepFailed as failure:
                length *= _HALF
                if length < self._shortest:
                    raise _Stuck(
                        f"stuck at factor {here.factor:.4g}, where no step was short enough: "
                        f"{failure}"
                    ) from failure
                continue
            pace = (self._march.wanted_iterations / max(there.found.iterations, 1)) ** _HALF
            change = float(np.clip(pace, _SHORTER, _LONGER))
            return there, min(length * change, self._longest)

    def step(self, here: Place, length: float) -> Place:
        """The place at so much of the path from another one, or at the target if that is nearer."""
        target = self._march.target - here.factor
        ahead = self._rule.predictor(here.tangent.velocity, here.last, self._metric)
        guess = ahead.times(length)
        if guess.factor >= target:
            found = self._at(here, guess.times(target / guess.factor), at_factor(target))
        else:
            found = self._at(here, guess, self._rule.constraint(ahead, length, self._metric))
            if found.factor > self._march.target:
                beyond = here.to(found)
                found = self._at(here, beyond.times(target / beyond.factor), at_factor(target))
        made = here.to(found)
        leapt = self._rule.leapt(made, guess, self._metric)
        if leapt and not self._rule.leaps:
            raise StepFailed("the step leapt to another path")
        return Place(found, self._workshop.tangent(found.q, found.factor), made, leapt)

    def _at(self, here: Place, guess: Increment, constraint) -> Corrected:
        return correct(self._workshop, here.base, guess, constraint, self._march.correction)

    def _switched(self, here: Place, there: Place) -> Place:
        """The place on the branch that leaves between two others, or the second of them."""
        if self._turned(here, there):
            return there
        switching, length = self._rule.switching, self._metric.length(here.to(there.found))
        bracket = singular_between(self.step, here, there, length, switching.bisections)
        off = branch_off(self._workshop, bracket, length, switching, self._march.correction)
        if off is None:
            return there
        self._branch += 1
        return off

    def _turned(self, here: Place, there: Place) -> bool:
        """Whether the factor turns back between two places: a limit point and no bifurcation."""
        onwards = self._rule.predictor(there.tangent.velocity, there.last, self._metric)
        return onwards.factor * here.last.factor < 0

    def _trace(self, status: str, reason: str) -> Trace:
        return Trace(status, reason, tuple(self._points), self._workshop.spent)
