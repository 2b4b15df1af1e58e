"""Equilibria of a sheet whose top ring is moved along one of its motions, step by step.

At each step the sheet is first moved along the tangent of the path, and corrected with the factors
of the step before; where that does not lead to a minimum at once, the energy is minimised. Terms
whose state follows the shape, as plastic flow does, follow on the way, and every step is committed:
such a sweep is a path with a history, and its way back another one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from foilstudy.linalg import Factorisation, SolveError, SymmetricBlocks, factorise
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.supports.interpolation import as_vector
from foilstudy.solve.choices import SEARCHES
from foilstudy.solve.equilibrium.newton import NewtonOptions
from foilstudy.solve.equilibrium.quasi_newton import InverseHessian
from foilstudy.solve.equilibrium.settle import HeldSheet
from foilstudy.solve.problem import Problem
from foilstudy.solve.residual import least_scale, relative_residual

_TOP = slice(-RING_ROWS, None)
_SNAPPED = 0.1
"""Work that is missing from the energy of a step, over that of a spring on the same step, from
which it has snapped. On smooth paths the rule below leaves a thousandth."""
_CORRECTIONS = 12
"""With the factors of the step before; each costs a twentieth of a factorisation."""


@dataclass(frozen=True)
class RingMotion:
    """One of the six motions of a ring, by the way of its rim.

    Attributes
    ----------
    axis : int
        0 to 2: translation along x, y, z; 3 to 5: rotation about them through the ring's centre.
    arm : float
        Radius of the rim by which rotations are counted, m.
    """

    axis: int
    arm: float

    def moved(self, ring: np.ndarray, way: float) -> np.ndarray:
        """A ring, points (3, n), once its rim has moved by a way, m."""
        unit = np.eye(3)[self.axis % 3]
        if self.axis < 3:
            return ring + way * unit[:, None]
        centre = ring.mean(axis=1, keepdims=True)
        arms, angle = ring - centre, way / self.arm
        along = np.outer(unit, unit @ arms)
        turned = np.cross(unit, arms, axisb=0, axisc=0)
        return centre + along + np.cos(angle) * (arms - along) + np.sin(angle) * turned

    def velocity(self, ring: np.ndarray) -> np.ndarray:
        """Derivative of `moved` by the way, of a ring as it stands."""
        unit = np.eye(3)[self.axis % 3]
        if self.axis < 3:
            return np.repeat(unit[:, None], ring.shape[1], axis=1)
        arms = ring - ring.mean(axis=1, keepdims=True)
        return np.cross(unit, arms, axisb=0, axisc=0) / self.arm

    def acceleration(self, ring: np.ndarray) -> np.ndarray:
        """Second derivative."""
        if self.axis < 3:
            return np.zeros_like(ring)
        unit = np.eye(3)[self.axis % 3]
        return np.cross(unit, self.velocity(ring), axisb=0, axisc=0) / self.arm


@dataclass(frozen=True)
class SweepOptions:
    """How a step is solved.

    Attributes
    ----------
    residual_tolerance : float
        Largest force on the free control points over that on the rings.
    hessians : int
        Tangents formed for a step at most.
    search : str
        A name of `foilstudy.solve.choices.SEARCHES`.
    """

    residual_tolerance: float = 1e-8
    hessians: int = 20
    search: str = "quasi_newton"


@dataclass(frozen=True, eq=False)
class Swept:
    """One equilibrium of a sweep.

    Attributes
    ----------
    status, message : str
        ``converged`` at a minimum, ``snapped`` at one that is not on the path of the step before,
        or as of `newton.NewtonResult`.
    way : float
        Of the rim of the top ring, m.
    points : ndarray, shape (3, rows, columns)
        m.
    energy : float
        Potential energy and what is spent, J.
    force : float
        That moves the ring along the motion: the derivative of the energy by the way, N.
    tangent : float
        The derivative of the force, the sheet following, N/m.
    released : float
        Work of the ring on the step less the change of energy, J.
    """

    status: str
    message: str
    way: float
    points: np.ndarray
    energy: float
    force: float
    tangent: float
    released: float = 0.0


@dataclass(frozen=True, eq=False)
class _Place:
    """An equilibrium, the derivative of its points by the way, and the factors of its tangent."""

    found: Swept
    velocity: np.ndarray
    factor: Factorisation

    @property
    def stable(self) -> bool:
        """Whether it is a minimum with held rings."""
        return self.factor.negative_eigenvalues == 0


class _Path:
    """A problem and the motion along which its ring is moved."""

    def __init__(
        self, problem: Problem, points: np.ndarray, motion: RingMotion, options: SweepOptions
    ):
        self._problem, self._rest, self._options = problem, points, options
        self._motion = motion
        self._floor = least_scale(problem.shell, options.residual_tolerance)
        self._owned = RING_ROWS * 3 * points.shape[2]

    def at(self, points: np.ndarray, way: float, status: str, message: str) -> _Place:
        """An equilibrium with its tangent.

        Raises
        ------
        SolveError
            If the tangent with held rings is singular.
        """
        problem = self._problem
        state = problem.followed(points)
        force = np.empty_like(points)
        energies = problem.force(points, force, state)
        ring, forces = points[:, _TOP].reshape(3, -1), force[:, _TOP].reshape(3, -1)
        velocity = np.zeros_like(points)
        velocity[:, _TOP] = self._motion.velocity(ring).reshape(3, RING_ROWS, -1)
        push = as_vector(velocity)
        pushed = problem.tangent(points, state) @ push
        free = slice(self._owned, -self._owned)
        factor = _factored(problem, points, state)
        following = -factor.solve(pushed[free])
        tangent = push @ pushed + following @ pushed[free]
        tangent += float((forces * self._motion.acceleration(ring)).sum())
        inner = following.reshape(-1, points.shape[2], 3).transpose(2, 0, 1)
        velocity[:, RING_ROWS:-RING_ROWS] = inner
        along = float((forces * self._motion.velocity(ring)).sum())
        energy = float(energies.sum()) + problem.spent(state)
        return _Place(
            Swept(status, message, way, points, energy, along, float(tangent)), velocity, factor
        )

    def step(self, here: _Place, way: float) -> _Place:
        """The equilibrium at another way."""
        before = here.found
        guess = before.points + (way - before.way) * here.velocity
        ring = self._motion.moved(self._rest[:, _TOP].reshape(3, -1), way)
        guess[:, _TOP] = ring.reshape(3, RING_ROWS, -1)
        try:
            there = self._corrected(guess, here, way) or self._minimised(guess, way)
        except SolveError as error:
            return replace(here, found=Swept("singular", str(error), way, guess, *[np.nan] * 3))
        after = there.found
        work = _work(before, after)
        spring = 0.5 * max(abs(before.tangent), abs(after.tangent)) * (way - before.way) ** 2
        released = work - (after.energy - before.energy)
        snapped = after.status == "converged" and released > _SNAPPED * spring
        status = "snapped" if snapped else after.status
        return replace(there, found=replace(after, status=status, released=released))

    def _corrected(self, guess: np.ndarray, here: _Place, way: float) -> _Place | None:
        """From a guess with the factors of the place before; None where that finds no minimum."""
        held = HeldSheet(self._problem, guess)
        q, inverse = held.unknowns(guess), InverseHessian(here.factor)
        _, gradient = held.value_and_gradient(q)
        residual = self._residual(held, gradient)
        for count in range(_CORRECTIONS):
            if residual <= self._options.residual_tolerance:
                words = f"relative residual {residual:.1e} after {count} corrections"
                there = self.at(held.points(q), way, "converged", words)
                return there if there.stable else None
            step, before, worst = -inverse.apply(gradient), gradient, residual
            q = q + step
            _, gradient = held.value_and_gradient(q)
            residual = self._residual(held, gradient)
            if not residual < worst:
                return None
            inverse.learn(step, gradient - before)
        return None

    def _minimised(self, guess: np.ndarray, way: float) -> _Place:
        held = HeldSheet(self._problem, guess)
        options = NewtonOptions(
            self._options.residual_tolerance,
            lambda q: max(held.ring_force_at(q), self._floor),
            self._options.hessians,
        )
        result = SEARCHES[self._options.search](held, held.unknowns(guess), options)
        return self.at(held.points(result.q), way, result.status, result.message)

    def _residual(self, held: HeldSheet, gradient: np.ndarray) -> float:
        scale = max(held.ring_force, self._floor)
        return relative_residual(float(np.linalg.norm(gradient)), scale)


def swept(
    problem: Problem,
    points: np.ndarray,
    motion: RingMotion,
    ways: np.ndarray,
    options: SweepOptions | None = None,
) -> Iterator[Swept]:
    """Move the top ring from an equilibrium; that first, then one result for each way.

    Ends with the first step that finds no minimum. A problem with a memory keeps that of the last
    step that was taken: give each sweep one of its own.

    Parameters
    ----------
    problem : Problem
    points : ndarray, shape (3, rows, columns)
        Control points of a stable equilibrium, m.
    motion : RingMotion
    ways : ndarray
        Of the rim, from rest, m.
    options : SweepOptions, optional

    Raises
    ------
    SolveError
        If the tangent at rest is singular.
    """
    path = _Path(problem, points, motion, options or SweepOptions())
    place = path.at(points, 0.0, "converged", "not moved")
    if not place.stable:
        words = "the state of rest is no minimum of the energy with held rings"
        yield replace(place.found, status="unstable", message=words)
        return
    yield place.found
    for way in ways:
        place = path.step(place, float(way))
        yield place.found
        if place.found.status not in ("converged", "snapped"):
            return
        if problem.has_memory:
            problem.commit(place.found.points)


def _work(before: Swept, after: Swept) -> float:
    """Of the ring on a step: the integral of the cubic with the forces and tangents of its ends."""
    step = after.way - before.way
    bend = (before.tangent - after.tangent) * step**2 / 12
    return 0.5 * step * (before.force + after.force) + bend


def _factored(problem: Problem, points: np.ndarray, state: tuple) -> Factorisation:
    """The tangent with held rings, which need not be definite."""
    tangent = problem.held_tangent(points, state)
    try:
        return factorise(tangent)
    except SolveError:
        if not isinstance(tangent, SymmetricBlocks):
            raise
        return factorise(tangent.full())
