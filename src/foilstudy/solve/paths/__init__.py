"""Ways from the uncrumpled cylinder to a crumpled equilibrium: one file each, protocol `Path`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

import numpy as np

from foilstudy.base.costs import Cost
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.loop import History

__all__ = ["Arrival", "Path"]


@dataclass(frozen=True, eq=False, repr=False)
class Arrival:
    """Where a path has led, and whether that is a stable equilibrium.

    Attributes
    ----------
    status : str
        One of `foilstudy.base.outcome.STATUSES`.
    message : str
        One sentence on the status.
    points : ndarray, shape (3, rows, columns)
        Control points, m.
    residual : float
        Norm of the force on the free control points relative to that on the rings.
    negative_eigenvalues : int or None
        Of the tangent with the rings held; None where it was not counted.
    steps, newton_steps, hessians : int
        Pseudo-time steps with those of the ramp, quasi-Newton steps, tangents formed.
    history : History or None
        Along the way; None where there was no motion.
    costs : mapping of str to Cost
        Of the stages of the path, by their names.
    state : tuple
        Of the terms of the problem at the end; empty where none has a memory.
    reached : float
        Share of the shortening that the path has come to.
    budget_spent : bool
        Whether it ended there for want of factorisations.
    free_heights : tuple of float
        Heights to which the ring sprang each time that it was let go on the way, m; NaN where it
        did not come free.
    shortened_steps : int
        Steps of the motion that were shortened, lest parts of the foil cross.
    """

    status: str
    message: str
    points: np.ndarray
    residual: float
    negative_eigenvalues: int | None
    steps: int
    newton_steps: int
    hessians: int
    history: History | None
    costs: Mapping[str, Cost] = field(default_factory=dict)
    state: tuple[Any, ...] = ()
    reached: float = 1.0
    budget_spent: bool = False
    free_heights: tuple[float, ...] = ()
    shortened_steps: int = 0

    def after(self, earlier: Arrival) -> Arrival:
        """The same with the work and the history of what came before, on a coarser mesh say."""
        names = {**earlier.costs, **self.costs}
        costs = {
            name: sum((a.costs[name] for a in (earlier, self) if name in a.costs), start=Cost())
            for name in names
        }
        return replace(
            self,
            steps=earlier.steps + self.steps,
            newton_steps=earlier.newton_steps + self.newton_steps,
            hessians=earlier.hessians + self.hessians,
            history=earlier.history,
            costs=costs,
            free_heights=earlier.free_heights + self.free_heights,
            shortened_steps=earlier.shortened_steps + self.shortened_steps,
        )

    def __repr__(self) -> str:
        return f"<Arrival: {self.status}, {self.message}, {self.steps} steps>"


class Path(Protocol):
    """A strategy to crumple; a frozen specification.

    Its class has a method ``for_study(ramp_steps, scheme, settling, check_interval)``, which makes
    the one that a study takes; it leaves out what it has no use for.
    """

    def follow(
        self, problem: Problem, shortening: float, start: np.ndarray | None = None
    ) -> Arrival:
        """From the stress-free shape, or from `start`, to rings nearer by `shortening`, m."""
        ...

    def push(self, problem: Problem, shortening: float, start: np.ndarray | None = None) -> Arrival:
        """Like `follow`, but only near an equilibrium: ``converged`` says no more than that."""
        ...

    def relax(self, problem: Problem, points: np.ndarray) -> Arrival:
        """From any shape to near an equilibrium, the rings held."""
        ...

    def settle(self, problem: Problem, points: np.ndarray) -> Arrival:
        """From any shape to an equilibrium, the rings held."""
        ...
