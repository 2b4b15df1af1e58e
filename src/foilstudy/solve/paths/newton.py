"""Displacement steps with plain Newton: the way that is published as fragile."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.continuation import FactorSteps
from foilstudy.solve.paths.continued import ContinuedPath


@dataclass(frozen=True)
class NewtonPath(ContinuedPath):
    """The rings come nearer in steps, each ended by Newton's method; halved where that fails.

    Without a line search, and at whatever equilibrium the iterations find: an unstable one is as
    good to them as a stable one.

    Attributes
    ----------
    first_step, longest_step, budget, settling
        See `ContinuedPath`.
    leaps : bool
        Whether an equilibrium of another path is taken where the iterations happen to find one.
    """

    kind = "newton"
    leaps: bool = True

    def rule(self) -> FactorSteps:
        """See `ContinuedPath`."""
        return FactorSteps(self.leaps)
