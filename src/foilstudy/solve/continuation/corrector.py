"""Newton's method on the equations of equilibrium bordered by a constraint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.solve.continuation.constraints import Constraint, Increment
from foilstudy.solve.continuation.linearised import StepFailed, Workshop
from foilstudy.solve.residual import relative_residual


@dataclass(frozen=True)
class Correction:
    """When corrections end.

    Attributes
    ----------
    residual_tolerance : float
        Largest accepted norm of the residual relative to `Equations.scale`.
    iterations_max : int
        Tangents factored for one point; after so many the step is shortened.
    """

    residual_tolerance: float = 1e-8
    iterations_max: int = 10


@dataclass(frozen=True, eq=False)
class Corrected:
    """An equilibrium that meets the constraint.

    Attributes
    ----------
    q : ndarray, shape (n,)
    factor, residual : float
    iterations : int
    """

    q: np.ndarray
    factor: float
    residual: float
    iterations: int


_SHORT = 1e-6
"""Share of the constraint's own size within which it is met."""


def correct(
    workshop: Workshop,
    base: Increment,
    guess: Increment,
    constraint: Constraint,
    options: Correction,
) -> Corrected:
    """The equilibrium near a guess at which a constraint holds.

    Each iteration solves with the factored tangent twice, for the residual and for the derivative
    by the factor, and eliminates the factor by the linearised constraint: the bordered system,
    which is regular at limit points.

    Parameters
    ----------
    workshop : Workshop
    base : Increment
        Point from which the constraint counts.
    guess : Increment
        From there.
    constraint : Constraint
    options : Correction

    Raises
    ------
    StepFailed
        If the iterations do not converge or leave what is finite.
    BudgetSpent
    """
    equations = workshop.equations
    step_q, step_factor = guess.q, guess.factor
    size = abs(constraint(0 * step_q, 0.0)[0])  # what it asks for, seen from the base
    for iteration in range(options.iterations_max + 1):
        q, factor = base.q + step_q, base.factor + step_factor
        force = equations.residual(q, factor)
        residual = relative_residual(float(np.linalg.norm(force)), equations.scale(q, factor))
        off, slope_q, slope_factor = constraint(step_q, step_factor)
        if not (np.isfinite(residual) and np.isfinite(off)):
            raise StepFailed("the residual is not finite")
        if residual <= options.residual_tolerance and abs(off) <= _SHORT * size:
            return Corrected(q, factor, residual, iteration)
        if iteration == options.iterations_max:
            break
        tangent = workshop.tangent(q, factor)
        back = -tangent.factor.solve(force)
        pivot = slope_factor + slope_q @ tangent.velocity
        if pivot == 0:
            raise StepFailed("the constraint lies along the path")
        change = -(off + slope_q @ back) / pivot
        step_q = step_q + back + change * tangent.velocity
        step_factor = step_factor + change
    raise StepFailed(
        f"relative residual {residual:.1e} after {options.iterations_max} corrections "
        f"(wanted {options.residual_tolerance:.1e})"
    )
