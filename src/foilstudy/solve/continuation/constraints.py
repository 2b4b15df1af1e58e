"""What makes a point on a path the next one: a scalar equation beside those of equilibrium.

Lengths are root mean squares of the unknowns, in their unit, so that they do not grow with the
mesh; the factor counts with a weight in the same unit.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

Constraint = Callable[[np.ndarray, float], tuple[float, np.ndarray, float]]
"""From the increments of unknowns and factor to the value that has to vanish and its gradients."""


@dataclass(frozen=True, eq=False)
class Increment:
    """From one point of a path to another.

    Attributes
    ----------
    q : ndarray, shape (n,)
    factor : float
    """

    q: np.ndarray
    factor: float

    def times(self, scale: float) -> Increment:
        """A multiple."""
        return Increment(scale * self.q, scale * self.factor)


@dataclass(frozen=True)
class Metric:
    """Inner product of increments.

    Attributes
    ----------
    weight : float
        Of the factor, in the unit of the unknowns.
    """

    weight: float

    def inner(self, one: Increment, other: Increment) -> float:
        """Mean product of the unknowns, and of the weighted factors."""
        return float(one.q @ other.q) / one.q.size + self.weight**2 * one.factor * other.factor

    def length(self, increment: Increment) -> float:
        """Root of the square."""
        return float(np.sqrt(self.inner(increment, increment)))


def at_factor(target: float) -> Constraint:
    """The factor grows by so much: steps of load or of displacement."""

    def constraint(q: np.ndarray, factor: float):
        return factor - target, np.zeros_like(q), 1.0

    return constraint


def on_sphere(length: float, metric: Metric) -> Constraint:
    """The increment has a length: a cylinder where the weight of the factor is zero.

    M. A. Crisfield, 'A fast incremental/iterative solution procedure that handles snap-through',
    Computers and Structures 13 (1981) 55-62; linearised anew in every iteration.
    """

    def constraint(q: np.ndarray, factor: float):
        off = q @ q / q.size + metric.weight**2 * factor**2 - length**2
        return off / (2 * length), q / (q.size * length), metric.weight**2 * factor / length

    return constraint


def on_plane(normal: Increment, length: float, metric: Metric) -> Constraint:
    """The increment has a length along a direction of unit length.

    Along the predictor it is that of E. Riks, 'An incremental approach to the solution of snapping
    and buckling problems', International Journal of Solids and Structures 15 (1979) 529-551; along
    a mode it leads off a bifurcation.
    """

    def constraint(q: np.ndarray, factor: float):
        along = metric.inner(normal, Increment(q, factor))
        return along - length, normal.q / q.size, metric.weight**2 * normal.factor

    return constraint
