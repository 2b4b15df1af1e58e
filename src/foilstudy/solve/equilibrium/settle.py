"""From any shape of a sheet between its rings to a stable equilibrium.

Explicit relaxation is cheap and goes through many snaps; once it is in a basin, quasi-Newton steps
with a factored tangent end it in few. So the sheet is relaxed to a moderate residual and then
minimised; what turns out to have another snap ahead is relaxed again, further down. A sheet that
still snaps after many steps is minimised all the way: slower, but each step lowers the energy.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import SymmetricBlocks
from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.choices import SEARCHES
from foilstudy.solve.equilibrium.newton import NewtonOptions, NewtonResult
from foilstudy.solve.pace import REST_STEPS_MIN
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Motion, Ramp, StoppingRule, relax
from foilstudy.solve.residual import relative_residual

_NO_MOTION = Ramp(0.0, 0)
_OFF_SADDLE, _NEXT_SADDLE = 2000, 1e-3
"""Steps of relaxation at least once a saddle has been left, as the motion begins slowly, and the
residual at which it ends at the latest: the sheet may come to another saddle."""
_FREE = slice(RING_ROWS, -RING_ROWS)


class HeldSheet:
    """Potential energy of a sheet whose rings stand still, for `minimise`.

    Terms with a memory start from the state that was last committed. Where it follows the shape to
    the least of energy and what is spent, as plastic flow does, it follows in every evaluation; of
    other terms it is held.

    Parameters
    ----------
    problem : Problem
    points : ndarray, shape (3, rows, columns)
        Control points, m; those of the rings are kept.

    Attributes
    ----------
    ring_force : float
        Norm of the force on the rings at the last evaluation, N.
    """

    def __init__(self, problem: Problem, points: np.ndarray):
        self._problem, self._points = problem, points.copy()
        self._force = np.empty_like(points)
        self._at: np.ndarray | None = None
        self.ring_force = np.nan

    def unknowns(self, points: np.ndarray) -> np.ndarray:
        """The free control points as one vector, in the order of the stiffness matrix."""
        return points[:, _FREE].transpose(1, 2, 0).reshape(-1)

    def points(self, q: np.ndarray) -> np.ndarray:
        """Control points, shape (3, rows, columns), m."""
        points = self._points.copy()
        free = points[:, _FREE]
        free[:] = q.reshape(free.shape[1], free.shape[2], 3).transpose(2, 0, 1)
        return points

    def value_and_gradient(self, q: np.ndarray) -> tuple[float, np.ndarray]:
        """Potential energy and what is spent (J), and force on the free control points (N)."""
        points = self.points(q)
        state = self._problem.followed(points)
        energies = self._problem.force(points, self._force, state)
        rings = self._force[:, :RING_ROWS], self._force[:, -RING_ROWS:]
        self.ring_force, self._at = float(np.linalg.norm(np.stack(rings))), q.copy()
        value = float(energies.sum()) + self._problem.spent(state)
        return value, self.unknowns(self._force)

    def hessian(self, q: np.ndarray) -> sparse.csr_matrix | SymmetricBlocks:
        """Tangent stiffness of the free control points at the state they lead to, N/m."""
        points = self.points(q)
        return self._problem.held_tangent(points, self._problem.followed(points))

    def ring_force_at(self, q: np.ndarray) -> float:
        """Norm of the force on the rings, N: the scale of residuals."""
        if self._at is None or not np.array_equal(self._at, q):
            self.value_and_gradient(q)
        return self.ring_force


@dataclass(frozen=True)
class SettleOptions:
    """How far, and how.

    Attributes
    ----------
    residual_tolerance : float
        Largest norm of the force on the free control points relative to that on the rings.
    switch_residual : float
        Residual at which relaxation gives way to the minimisation, a third of it in every further
        round. From 1e-3 on the minimisation ends where the relaxation went, and one tangent is
        enough; from 1e-2 it takes more of them, and so more time (docs/tradeoff.md).
    relaxation_steps_max : int
        Steps of relaxation, over all rounds.
    hessians_per_round : int
        Tangents formed before the sheet is relaxed again.
    hessians_last : int
        Tangents formed once no steps of relaxation are left; up to 20 were needed.
    rounds_max : int
    search : str
        How minima are sought: a name of `foilstudy.solve.choices.SEARCHES`.
    """

    residual_tolerance: float = 1e-8
    switch_residual: float = 1e-3
    relaxation_steps_max: int = REST_STEPS_MIN
    hessians_per_round: int = 3
    hessians_last: int = 60
    rounds_max: int = 10
    search: str = "quasi_newton"


@dataclass(frozen=True)
class SettleResult:
    """Outcome of settling a sheet.

    Attributes
    ----------
    status : str
        ``converged`` (residual met and no negative eigenvalue), ``not_converged`` or ``diverged``.
    message : str
        One sentence on the status.
    points : ndarray, shape (3, rows, columns)
        Control points, m.
    residual : float
    negative_eigenvalues : int or None
        Of the tangent with the rings held; None where it was not counted.
    relaxation_steps, hessians, newton_steps : int
        Work done: explicit steps, tangents formed, quasi-Newton steps.
    shortened_steps : int
        See `Motion`; those before the settling are counted, too.
    """

    status: str
    message: str
    points: np.ndarray
    residual: float
    negative_eigenvalues: int | None
    relaxation_steps: int
    hessians: int
    newton_steps: int
    shortened_steps: int = 0


def settle(
    problem: Problem, motion: Motion, points: np.ndarray, options: SettleOptions | None = None
) -> SettleResult:
    """Stable equilibrium with the rings held, from any shape.

    Parameters
    ----------
    problem : Problem
    motion : Motion
        Of the relaxation; its damper after the ramp is used.
    points : ndarray, shape (3, rows, columns)
        Control points to start from, m.
    options : SettleOptions, optional

    Returns
    -------
    SettleResult
        Never raises for a sheet that does not settle: the status says so.
    """
    options = options or SettleOptions()
    steps = hessians = newton_steps = saddles = 0
    steps_min = 0
    for each in range(options.rounds_max):
        residual = max(options.switch_residual / 3 ** (each - saddles), options.residual_tolerance)
        if steps_min:
            residual = max(_NEXT_SADDLE, options.switch_residual)
        left = options.relaxation_steps_max - steps
        rule = StoppingRule(residual, left, relaxation_steps_min=min(steps_min, left))
        relaxed = relax(problem, motion, _NO_MOTION, rule, points)
        points, steps = relaxed.points, steps + relaxed.steps
        if relaxed.status == "diverged":
            return SettleResult(
                relaxed.status, relaxed.message, points, relaxed.residual, None,
                steps, hessians, newton_steps, motion.shortened_steps,
            )  # fmt: skip
        last = relaxed.status == "not_converged"
        most = options.hessians_last if last else options.hessians_per_round
        before, stop = points, not last and each + 1 < options.rounds_max
        points, polished = minimised(problem, points, options, most, stop_at_saddle=stop)
        hessians, newton_steps = hessians + polished.iterations, newton_steps + polished.steps
        at_saddle = polished.status == "saddle"
        saddles, steps_min = saddles + at_saddle, _OFF_SADDLE * at_saddle
        if at_saddle:
            step = points - before  # far enough for the relaxation to notice: a thickness
            points = before + step * (problem.shell.thickness / np.abs(step).max())
        converged = polished.status == "converged"
        if not converged and stop:
            continue
        # also where it has not converged: what is measured belongs to the shape that is returned
        residual = _committed(problem, points, polished.residual)
        unheld = _unheld(problem, points)
        rests = residual <= options.residual_tolerance and unheld <= options.switch_residual
        if converged and rests:
            return SettleResult(
                "converged", polished.message, points, residual, polished.negative_eigenvalues,
                steps, hessians, newton_steps, motion.shortened_steps,
            )  # fmt: skip
        if problem.has_memory:
            after = f"{max(residual, unheld):.1e} once the state had followed the shape"
            polished = replace(polished, residual=residual, message=f"{polished.message}; {after}")
        if last and not converged:
            break
    return SettleResult(
        "not_converged", polished.message, points, polished.residual,
        polished.negative_eigenvalues, steps, hessians, newton_steps, motion.shortened_steps,
    )  # fmt: skip


def _committed(problem: Problem, points: np.ndarray, residual: float) -> float:
    """Residual of an equilibrium once terms with memory have taken note of its shape."""
    if not problem.has_memory:
        return residual
    problem.commit(points)
    held = HeldSheet(problem, points)
    _, gradient = held.value_and_gradient(held.unknowns(points))
    return relative_residual(float(np.linalg.norm(gradient)), held.ring_force)


def _unheld(problem: Problem, points: np.ndarray) -> float:
    """What the rings do not hold of the force on them, relative to that; it is no free force."""
    if not problem.gives_way:
        return 0.0
    force = np.empty_like(points)
    problem.force(points, force)
    rings = force[:, :RING_ROWS], force[:, -RING_ROWS:]
    return relative_residual(problem.unheld(points, force), float(np.linalg.norm(np.stack(rings))))


def minimised(
    problem: Problem,
    points: np.ndarray,
    options: SettleOptions,
    hessians_max: int,
    stop_at_saddle: bool = False,
) -> tuple[np.ndarray, NewtonResult]:
    """Minimise the energy with the rings held; the new control points and the outcome.

    Parameters
    ----------
    problem : Problem
        Its state is held.
    points : ndarray, shape (3, rows, columns)
        Control points to start from, m.
    options : SettleOptions
        Search and tolerance.
    hessians_max : int
        Tangents formed at most.
    stop_at_saddle : bool
        See `NewtonOptions`.
    """
    held = HeldSheet(problem, points)
    newton = NewtonOptions(
        residual_tolerance=options.residual_tolerance,
        scale=held.ring_force_at,
        iterations_max=hessians_max,
        stop_at_saddle=stop_at_saddle,
    )
    result = SEARCHES[options.search](held, held.unknowns(points), newton)
    return held.points(result.q), result


def stopped_at(
    problem: Problem,
    motion: Motion,
    points: np.ndarray,
    residuals: Iterable[float],
    relaxation_steps_max: int = 40_000,
) -> Iterator[tuple[float, np.ndarray]]:
    """Where a relaxation would have been stopped by each of several residuals.

    Between two of them the motion begins anew at rest. Ends early where a residual is not reached.

    Parameters
    ----------
    residuals : iterable of float
        Falling.

    Yields
    ------
    residual : float
        The one that was asked for.
    points : ndarray, shape (3, rows, columns)
        m.
    """
    for residual in residuals:
        rule = StoppingRule(residual, relaxation_steps_max)
        result = relax(problem, motion, _NO_MOTION, rule, points)
        if result.status != "converged":
            return
        points = result.points
        yield residual, points
