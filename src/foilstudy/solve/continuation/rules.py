"""How far the next point of a path is and in which direction: steps of the factor or of the arc."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from foilstudy.solve.continuation.branches import Switching
from foilstudy.solve.continuation.constraints import (
    Constraint,
    Increment,
    Metric,
    at_factor,
    on_plane,
    on_sphere,
)
from foilstudy.solve.continuation.linearised import StepFailed


class Rule(Protocol):
    """A kind of step."""

    def metric(self, velocity: np.ndarray) -> Metric:
        """By which lengths are measured, given the derivative of the unknowns at the start."""
        ...

    def predictor(self, velocity: np.ndarray, last: Increment, metric: Metric) -> Increment:
        """Along the tangent of the path, of unit length.

        Parameters
        ----------
        velocity : ndarray, shape (n,)
            Derivative of the unknowns by the factor.
        last : Increment
            The one before, or the direction to begin with.
        metric : Metric

        Raises
        ------
        StepFailed
            If the path has no direction.
        """
        ...

    def constraint(self, predictor: Increment, length: float, metric: Metric) -> Constraint:
        """That of a step of so much."""
        ...

    def leapt(self, made: Increment, guess: Increment, metric: Metric) -> bool:
        """Whether a step, by what was predicted of it, has landed on another path."""
        ...

    leaps: bool
    """Whether that is put up with; else the step is tried shorter."""

    switching: Switching | None
    """Whether and how the path is left where it loses its stability."""


_BENT = 0.5
"""Least cosine between a step and its prediction: a path bends, and does not leap."""
_STRETCHED = 3.0
"""Most of a step of the factor over its prediction: 2 where it just reaches a limit point."""


def _bent(made: Increment, guess: Increment, metric: Metric) -> bool:
    return metric.inner(made, guess) < _BENT * metric.length(made) * metric.length(guess)


@dataclass(frozen=True)
class FactorSteps:
    """Steps of load or of displacement: the factor grows, and the path must not turn back.

    Attributes
    ----------
    leaps : bool
        Whether an equilibrium of another path is taken where the iterations happen to find one.
    """

    leaps: bool = False
    switching = None

    def metric(self, velocity: np.ndarray) -> Metric:
        """See `Rule`."""
        return Metric(0.0)

    def predictor(self, velocity: np.ndarray, last: Increment, metric: Metric) -> Increment:
        """See `Rule`."""
        return Increment(velocity, 1.0)

    def constraint(self, predictor: Increment, length: float, metric: Metric) -> Constraint:
        """See `Rule`."""
        return at_factor(length)

    def leapt(self, made: Increment, guess: Increment, metric: Metric) -> bool:
        """See `Rule`."""
        if metric.length(guess) == 0:  # nothing moves, as on the way of a straight column
            return False
        return _bent(made, guess, metric) or (
            metric.length(made) > _STRETCHED * metric.length(guess)
        )


@dataclass(frozen=True)
class ArcSteps:
    """Steps of the arc length: the path may turn back in the factor and in the unknowns.

    It goes on in the direction of the step before, whatever the determinant does.

    Attributes
    ----------
    surface : str
        ``sphere``, ``cylinder`` (without the factor) or ``plane``.
    share : float
        Weight of the factor over the displacement that it brings at the start.
    switching : Switching, optional
        Whether and how the path is left where it loses its stability.
    """

    surface: str = "sphere"
    share: float = 1.0
    switching: Switching | None = None
    leaps = False

    def __post_init__(self):
        if self.surface not in SURFACES:
            raise ValueError(f"an arc ends on a {', '.join(SURFACES)}, not on a {self.surface!r}")

    def metric(self, velocity: np.ndarray) -> Metric:
        """See `Rule`."""
        size = float(np.sqrt(velocity @ velocity / velocity.size))
        return Metric(0.0 if self.surface == "cylinder" else self.share * size)

    def predictor(self, velocity: np.ndarray, last: Increment, metric: Metric) -> Increment:
        """See `Rule`."""
        ahead = Increment(velocity, 1.0)
        side = 1.0 if metric.inner(ahead, last) >= 0 else -1.0
        length = metric.length(ahead)
        if length == 0:
            raise StepFailed("nothing moves with the factor, so that an arc has no length")
        return ahead.times(side / length)

    def constraint(self, predictor: Increment, length: float, metric: Metric) -> Constraint:
        """See `Rule`."""
        if self.surface == "plane":
            return on_plane(predictor, length, metric)
        return on_sphere(length, metric)

    def leapt(self, made: Increment, guess: Increment, metric: Metric) -> bool:
        """See `Rule`."""
        return _bent(made, guess, metric)


SURFACES = ("sphere", "cylinder", "plane")
