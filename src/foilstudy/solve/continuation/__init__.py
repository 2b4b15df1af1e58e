"""Paths of equilibria by Newton's method: steps of a factor, arc length, branch switching."""

from foilstudy.solve.continuation.branches import Switching
from foilstudy.solve.continuation.corrector import Correction
from foilstudy.solve.continuation.equations import Equations
from foilstudy.solve.continuation.march import March, follow
from foilstudy.solve.continuation.rules import ArcSteps, FactorSteps, Rule
from foilstudy.solve.continuation.trace import Point, Trace

__all__ = [
    "ArcSteps",
    "Correction",
    "Equations",
    "FactorSteps",
    "March",
    "Point",
    "Rule",
    "Switching",
    "Trace",
    "follow",
]
