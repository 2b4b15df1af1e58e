"""The mass of a sheet that touches: no motion that crosses, no step that contact destabilises.

The masses of the shell bound its own stiffness. Closed contacts add to it, so the mass is
multiplied where the two together would exceed what a step of 1 bears, lambda_max(M^-1 K) <= 4; the
stiffness of the contacts is measured by power iteration. A motion that would close a gap almost is
shortened as a whole, and its momentum with it: as inelastic as a knock, and momentum and velocity
stay those of one mass, as the damping has to see.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.solve.problem import Problem, Term
from foilstudy.solve.relaxation.mass import Mass

__all__ = ["Impassable", "TouchingMass", "minding_contact"]

_BOUND, _SHELL, _MARGIN = 3.8, 1.4, 1.1
"""Largest eigenvalue allowed, what the shell is taken to have of it where sheets touch, and the
factor on what power iteration has found of the contacts."""
_EVERY, _ITERATIONS = 5, 2
_CLOSING = 0.9
"""Share of its gap by which a pair may close in a step."""
_SHORTENINGS = 12


@runtime_checkable
class Impassable(Term, Protocol):
    """A term that keeps parts of a sheet from passing something."""

    def knots(self) -> np.ndarray:
        """The last shape with a finite energy, shape (count, 3), m."""
        ...

    def touches(self) -> bool:
        """Whether it exerts anything there."""
        ...

    def free_way(self, free: np.ndarray) -> bool:
        """Whether a motion of the control points between the rings meets nothing, for sure."""
        ...

    def knot_motion(self, free: np.ndarray) -> np.ndarray:
        """Motion of the knots with one of the control points between the rings, those standing."""
        ...

    def passable_share(self, motion: np.ndarray, closing: float) -> float:
        """Part of a motion of the knots in which no gap closes by more than a share of it."""
        ...

    def spring_forces(self, free: np.ndarray) -> np.ndarray:
        """Forces of what is closed as springs along its gaps, in a small motion."""
        ...


@runtime_checkable
class Sticking(Term, Protocol):
    """A term that holds parts of a sheet on each other by springs, which its state knows."""

    def stick_forces(self, free: np.ndarray, state: Any) -> np.ndarray:
        """Forces of these in a small motion of the control points between the rings."""
        ...


def minding_contact(mass: Mass, problem: Problem) -> Mass:
    """A mass of a shell, with what contact makes of it where the problem has any."""
    contacts = [term for term in problem.terms if isinstance(term, Impassable)]
    if not contacts:
        return mass
    sticking = [k for k, term in enumerate(problem.terms) if isinstance(term, Sticking)]

    def sticks(free: np.ndarray) -> list[np.ndarray]:
        return [problem.terms[k].stick_forces(free, problem.state[k]) for k in sticking]

    return TouchingMass(mass, contacts, sticks)


class TouchingMass:
    """At work in one relaxation; the mass of the shell as long as nothing touches.

    The force has to be asked for at the present shape before the velocity is.

    Parameters
    ----------
    shell : Mass
    contacts : sequence of Impassable
        On the same knots.
    sticks : callable, optional
        Forces of what sticks, a term each, in a motion of the control points between the rings.

    Attributes
    ----------
    largest_factor : float
        On the mass, so far.
    shortened : int
        Steps that were shortened.
    """

    def __init__(
        self,
        shell: Mass,
        contacts: Sequence[Impassable],
        sticks: Callable[[np.ndarray], list[np.ndarray]] = lambda _: [],
    ):
        self._shell, self._contacts, self._sticks = shell, tuple(contacts), sticks
        self._probe: np.ndarray | None = None
        self._since, self._factor = 0, 1.0
        self._knots: np.ndarray | None = None
        self._moved: np.ndarray | None = None
        self.largest_factor, self.shortened = 1.0, 0

    def velocity(self, momentum: np.ndarray) -> np.ndarray:
        """See `Mass`; where the motion is shortened, `momentum` is as well.

        Raises
        ------
        SolveError
            If the rings alone would close a gap, however still the sheet stood.
        """
        if self._touch() and not np.isfinite(momentum).all():
            return self._shell.velocity(momentum)
        factor = self._mass_factor(momentum)
        velocity = self._shell.velocity(momentum)
        if factor > 1.0:
            velocity = velocity / factor
        if all([each.free_way(velocity) for each in self._contacts]):
            self._knots = None
            return velocity
        if not np.isfinite(velocity).all():
            return velocity
        motion, rings = self._contacts[0].knot_motion(velocity), self._ring_motion()
        share = self._passable(motion, rings)
        if share < 1.0:
            self.shortened += 1
            momentum *= share
            velocity, motion = share * velocity, share * motion
        self._knots, self._moved = self._contacts[0].knots(), motion
        return velocity

    def _ring_motion(self) -> np.ndarray | float:
        """What the rings moved the knots by in the last step beside their own motion.

        The ramp is smooth, so that it is what they will move them by in this one.
        """
        here = self._contacts[0].knots()
        if self._knots is None or np.array_equal(here[-1], self._knots[-1]):
            return 0.0
        return here - self._knots - self._moved

    def _passable(self, motion: np.ndarray, rings: np.ndarray | float) -> float:
        share = 1.0
        for _ in range(_SHORTENINGS):
            passed = self._passed(share * motion + rings)
            if passed >= 1.0:
                return share
            share *= min(passed, 0.9)
        if self._passed(0.0 * motion + rings) >= 1.0:
            return 0.0
        raise SolveError("the rings close a gap between parts of the foil; use more ramp steps")

    def _passed(self, motion: np.ndarray) -> float:
        return min(each.passable_share(motion, _CLOSING) for each in self._contacts)

    def _touch(self) -> bool:
        return any([each.touches() for each in self._contacts])

    def _mass_factor(self, momentum: np.ndarray) -> float:
        """Factor on the mass that keeps a step stable, measured every few steps."""
        if not self._touch():
            self._probe, self._since = None, 0
            return 1.0
        if self._since % _EVERY == 0:
            self._factor = max(1.0, (_MARGIN * self._largest(momentum) + _SHELL) / _BOUND)
            self.largest_factor = max(self.largest_factor, self._factor)
        self._since += 1
        return self._factor

    def _largest(self, momentum: np.ndarray) -> float:
        """Largest eigenvalue of the contacts in the metric of the mass, by warm power iteration."""
        if self._probe is None:
            # any motion that no contact is blind to; a fixed one gives the same bits
            self._probe = np.cos(np.arange(momentum.size, dtype=float)).reshape(momentum.shape)
            rounds = 4 * _ITERATIONS
        else:
            rounds = _ITERATIONS
        largest = 0.0
        for _ in range(rounds):
            probe = self._probe
            force = sum([each.spring_forces(probe) for each in self._contacts])
            force = sum(self._sticks(probe), start=force)
            response = self._shell.velocity(force).copy()
            size = np.sum(response * force)  # f M^-1 f = x K M^-1 K x
            if not size > 0:
                return 0.0
            work = np.sum(self._probe * force)
            largest = size / work
            self._probe = response / np.sqrt(size)
        return float(largest)
