"""The relaxation loop: a ring motion, then relaxation until the stopping rule holds."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numba import njit

from foilstudy.linalg import SolveError
from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.damping import Halt
from foilstudy.solve.relaxation.scheme import Motion
from foilstudy.solve.relaxation.turning import Turning
from foilstudy.solve.residual import relative_residual


@dataclass(frozen=True)
class Ramp:
    """Smooth motion of the top ring down to the gap height, in `steps` pseudo-time steps.

    With zero steps the ring stands still.

    Attributes
    ----------
    shortening : float
        m.
    steps : int
    spread : bool
        Whether each increment is spread over the height, so that the sheet does not lag behind at
        the moving ring; without, the ring moves alone.
    turning : Turning or None
        What the ring does on the way beside that.
    """

    shortening: float
    steps: int
    spread: bool = True
    turning: Turning | None = None

    def shortening_at(self, step: int) -> float:
        """Quintic ramp 10 tau^3 - 15 tau^4 + 6 tau^5: no velocity or acceleration at its ends."""
        tau = self._time(step)
        return self.shortening * tau**3 * (10 + tau * (-15 + 6 * tau))

    def progress_at(self, step: int) -> float:
        """The same of a way of 1."""
        tau = self._time(step)
        return tau**3 * (10 + tau * (-15 + 6 * tau))

    def _time(self, step: int) -> float:
        return min(step / self.steps, 1.0) if self.steps else 1.0


@dataclass(frozen=True)
class StoppingRule:
    """When a relaxation counts as converged, and when to give up.

    Attributes
    ----------
    residual_tolerance : float
        Largest norm of the force on the free control points relative to that on the rings.
    relaxation_steps_max : int
        Steps allowed after the ramp.
    check_interval : int
        Steps between two checks and two history entries.
    relaxation_steps_min : int
        Steps after the ramp before which no residual is judged: beside a saddle it is small.
    energy : float
        Beside which a kinetic energy is judged where the strain energy is less, J: that of a foil
        which comes free of stress goes to zero.
    """

    residual_tolerance: float
    relaxation_steps_max: int
    check_interval: int = 20
    relaxation_steps_min: int = 0
    energy: float = 0.0


@dataclass(frozen=True)
class History:
    """Quantities along the steps, one array entry per check.

    Height in m, reaction force on the top ring in N (positive when the sheet pushes it up),
    energies in J, by the name the problem gives them, residual relative.
    """

    step: np.ndarray
    height: np.ndarray
    reaction_force: np.ndarray
    energies: dict[str, np.ndarray]
    kinetic_energy: np.ndarray
    residual: np.ndarray


@dataclass(frozen=True)
class RelaxationResult:
    """Outcome of a relaxation.

    Attributes
    ----------
    status : str
        ``converged``, ``not_converged`` (step limit reached) or ``diverged``.
    message : str
        One sentence on the status.
    points : ndarray, shape (3, rows, columns)
        Last control points, m.
    residual, kinetic_energy_ratio : float
        At the end.
    steps : int
        Steps done, ramp included.
    history : History
    shortened_steps : int
        Of these and of those before that the motion has done, see `Motion`.
    """

    status: str
    message: str
    points: np.ndarray
    residual: float
    kinetic_energy_ratio: float
    steps: int
    history: History
    shortened_steps: int = 0


_UNSTABLE = 0.5
"""Kinetic over strain energy at the step limit above which the motion feeds itself."""


@njit(cache=True, fastmath=True, error_model="numpy")
def _advance(momentum, force, free_start, free_stop, damping):
    """momentum <- ((1 - c/2) momentum - f) / (1 + c/2) on the free rows."""
    keep = (1.0 - 0.5 * damping) / (1.0 + 0.5 * damping)
    push = -1.0 / (1.0 + 0.5 * damping)
    for c in range(3):
        for j in range(free_start, free_stop):
            m = momentum[c, j - free_start]
            f = force[c, j]
            for i in range(f.size):
                m[i] = keep * m[i] + push * f[i]


@njit(cache=True, fastmath=True, error_model="numpy")
def _move(points, velocity, share, lowering, free_start, free_stop):
    """Add the velocity on the free rows and every row's share of the ring's motion."""
    for j in range(points.shape[1]):
        drop = lowering * share[j]
        z = points[2, j]
        for i in range(z.size):
            z[i] -= drop
    for c in range(3):
        for j in range(free_start, free_stop):
            x = points[c, j]
            v = velocity[c, j - free_start]
            for i in range(x.size):
                x[i] += v[i]


@njit(cache=True, fastmath=True, error_model="numpy")
def _product(velocity, other, start):
    """v . other over the free rows, the first of which is `start` in the other array.

    Nothing is written, so that the order of the sum does not depend on where the arrays lie.
    """
    total = 0.0
    for c in range(3):
        for j in range(velocity.shape[1]):
            v = velocity[c, j]
            o = other[c, start + j]
            part = 0.0
            for i in range(v.size):
                part += v[i] * o[i]
            total += part
    return total


def relax(
    problem: Problem,
    motion: Motion,
    ramp: Ramp,
    rule: StoppingRule,
    start: np.ndarray | None = None,
) -> RelaxationResult:
    """Push the top ring of a sheet down and relax the sheet to equilibrium.

    Terms with memory take note of the shape after every step.

    Parameters
    ----------
    problem : Problem
    motion : Motion
        From `Scheme.start`; its dampers go on from where they are.
    ramp : Ramp
    rule : StoppingRule
    start : ndarray, shape (3, rows, columns), optional
        Control points to start from, at rest, m; the stress-free shape by default.

    Returns
    -------
    RelaxationResult
        Never raises for a sheet that fails to converge: the status says so. Where the mass cannot
        be solved for it is ``diverged``.
    """
    points = (problem.beginning if start is None else start).copy()
    rows = points.shape[1]
    free = (RING_ROWS, rows - RING_ROWS)
    share = np.zeros(rows)
    if ramp.spread:
        height = (
            problem.patch.size_along * (rows - 2)
            if start is None
            else points[2, -RING_ROWS:].mean()
        )
        share = np.clip(points[2].mean(axis=1) / height, 0.0, 1.0)
    share[:RING_ROWS], share[-RING_ROWS:] = 0.0, 1.0
    turned = ramp.turning.begun(points, share, problem.ring_height) if ramp.turning else None
    force = np.empty_like(points)
    momentum = np.zeros((3, free[1] - free[0], points.shape[2]))
    velocity = np.zeros_like(momentum)
    work_before = momentum_norm = 0.0
    recorder = _Recorder(ramp, problem, rule.energy)
    status, step, failure, halt = "not_converged", 0, None, None
    last_step = ramp.steps + rule.relaxation_steps_max
    while True:
        checked = step % rule.check_interval == 0 or step == last_step
        if checked:
            energies = problem.force(points, force)
        else:
            problem.gradient(points, force)
        work_rate = _product(velocity, force, RING_ROWS) - work_before
        if checked:
            entry = recorder.record(step, points, force, energies, 0.5 * momentum_norm)
            finite = np.isfinite(energies.sum() + entry.kinetic_energy)
            if not finite or np.isnan(entry.residual):
                status = "diverged"
                break
            if step >= ramp.steps + rule.relaxation_steps_min and entry.settled(rule):
                status = "converged"
                break
        if step == last_step:
            if entry.kinetic_energy_ratio > _UNSTABLE:
                status = "diverged"
            break
        damper = motion.ramp_damper if step < ramp.steps else motion.relaxation_damper
        if halt is not None:  # it has just come to rest
            momentum[:] = (1.0 - halt.push) * force[:, free[0] : free[1]]
        _advance(momentum, force, *free, damper.coefficient(work_rate, momentum_norm))
        try:
            velocity = motion.mass.velocity(momentum)
            norm = _product(velocity, momentum, 0)
            halt = damper.halt(norm)
            if halt is not None:
                velocity, norm = _return(motion, momentum, force, halt), 0.0
        except SolveError as error:
            energies = problem.force(points, force)
            recorder.record(step, points, force, energies, 0.5 * momentum_norm)
            status, failure = "diverged", str(error)
            break
        work_before = _product(velocity, force, RING_ROWS)
        momentum_norm = norm
        step += 1
        lowering = ramp.shortening_at(step) - ramp.shortening_at(step - 1)
        _move(points, velocity, share, lowering, *free)
        if turned and step <= ramp.steps:
            turned.move(points, ramp.progress_at(step - 1), ramp.progress_at(step))
        if problem.gives_way:
            problem.give_way(points, force, at_rest=step > ramp.steps)
            if turned:
                turned.renew(points, ramp.progress_at(step))
        if problem.has_memory:
            problem.commit(points)
    result = recorder.result(status, step, points, rule, failure)
    return replace(result, shortened_steps=motion.shortened_steps)


def _return(motion: Motion, momentum: np.ndarray, force: np.ndarray, halt: Halt) -> np.ndarray:
    """Clear the momentum; the motion of this step, back to where it comes to rest."""
    momentum += force[:, RING_ROWS:-RING_ROWS]  # undamped: that of the step before
    back = -halt.back * motion.mass.velocity(momentum)
    momentum[:] = 0.0
    return back


@dataclass(frozen=True)
class _Entry:
    residual: float
    kinetic_energy: float
    strain_energy: float  # of the shell: that of loads may be negative
    least_energy: float

    @property
    def kinetic_energy_ratio(self) -> float:
        beside = max(self.strain_energy, self.least_energy)
        return self.kinetic_energy / beside if beside != 0 else 0.0

    def settled(self, rule: StoppingRule) -> bool:
        return self.residual <= rule.residual_tolerance


class _Recorder:
    def __init__(self, ramp: Ramp, problem: Problem, least_energy: float):
        self._problem, self._ramp, self._least_energy = problem, ramp, least_energy
        self._energy_names = problem.energy_names
        self._of_shell = len(problem.shell.energy_names)
        self._rows: list[tuple] = []
        self._last: _Entry | None = None

    def record(self, step, points, force, energies, kinetic) -> _Entry:
        if self._rows and self._rows[-1][0] == step:
            return self._last
        free = force[:, RING_ROWS:-RING_ROWS]
        rings = np.sqrt(np.sum(force[:, :RING_ROWS] ** 2) + np.sum(force[:, -RING_ROWS:] ** 2))
        unheld = self._problem.unheld(points, force)
        residual = relative_residual(np.sqrt(np.sum(free**2) + unheld**2), rings)
        reaction = -float(np.sum(force[2, -RING_ROWS:]))
        self._rows.append(
            (step, -self._ramp.shortening_at(step), reaction, *energies, kinetic, residual)
        )
        strain = float(energies[: self._of_shell].sum())
        self._last = _Entry(float(residual), float(kinetic), strain, self._least_energy)
        return self._last

    def _energy_words(self) -> str:
        ratio = self._last.kinetic_energy_ratio
        if not np.isfinite(ratio):
            return "the energy was not finite"
        if np.isnan(self._last.residual):
            return "the forces were not finite"
        return f"the kinetic energy was {ratio:.1g} of the strain energy"

    def result(self, status, step, points, rule, failure=None) -> RelaxationResult:
        last = self._last
        steps, heights, reactions, *energies, kinetic, residuals = np.array(self._rows).T
        messages = {
            "converged": f"relative residual {last.residual:.1e} after {step} steps",
            "not_converged": (
                f"relative residual {last.residual:.1e} (wanted {rule.residual_tolerance:.1e}) "
                f"when the step limit of {step} was reached"
            ),
            "diverged": (
                f"the stepping was unstable: {self._energy_words()} at step {step}; use a smaller "
                "imperfection or more ramp steps"
            ),
        }
        message = f"{failure} (step {step})" if failure else messages[status]
        height = self._problem.ring_height(points) + self._ramp.shortening_at(step)
        history = History(
            steps.astype(np.int64),
            height + heights,
            reactions,
            dict(zip(self._energy_names, energies, strict=True)),
            kinetic,
            residuals,
        )
        return RelaxationResult(
            status,
            message,
            points,
            last.residual,
            last.kinetic_energy_ratio,
            step,
            history,
        )
