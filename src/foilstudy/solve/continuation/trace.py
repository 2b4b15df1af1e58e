"""What following a path gave."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Point:
    """An equilibrium on a path.

    Attributes
    ----------
    factor : float
    force : float
        See `Equations.force`, N.
    negative_eigenvalues : int
        Of the tangent at this factor: with the load or the motion held, 0 where it is stable.
    q : ndarray, shape (n,)
        Unknowns.
    residual : float
        Relative.
    iterations : int
        Corrections that it took.
    factorisations : int
        Spent until it was reached, from the start of the path.
    branch : int
        How many branches have been switched on the way.
    leapt : bool
        Whether the step to it landed on another path than it set out on.
    """

    factor: float
    force: float
    negative_eigenvalues: int
    q: np.ndarray
    residual: float
    iterations: int
    factorisations: int
    branch: int = 0
    leapt: bool = False


@dataclass(frozen=True, eq=False)
class Trace:
    """A path as far as it was followed.

    Attributes
    ----------
    status : str
        ``converged`` (the end was reached), ``budget_spent``, ``singular`` (the tangent stayed
        singular however short the step) or ``not_converged`` (the corrections did not converge
        however short the step).
    reason : str
        Why it ended there.
    points : tuple of Point
        In the order of the path, the start first; empty where that is no equilibrium.
    factorisations : int
        Spent, those of failed steps included.
    """

    status: str
    reason: str
    points: tuple[Point, ...]
    factorisations: int

    @property
    def message(self) -> str:
        """One sentence on the status."""
        if not self.points:
            return self.reason
        return (
            f"{self.reason}; {len(self.points)} points up to factor {self.farthest:.4g} with "
            f"{self.factorisations} factorisations"
        )

    @property
    def farthest(self) -> float:
        """Largest factor reached; zero where there is no point."""
        return self.within(self.factorisations)

    def within(self, factorisations: int) -> float:
        """Largest factor reached with so many factorisations."""
        reached = (p.factor for p in self.points if p.factorisations <= factorisations)
        return max(reached, default=0.0)

    def __repr__(self) -> str:
        return f"<Trace: {self.status}, {self.message}>"
