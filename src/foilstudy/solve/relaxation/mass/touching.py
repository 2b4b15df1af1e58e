"""A mass scaling for sheets that touch: no motion that crosses, no step that contact destabilises.

The masses of the shell bound its own stiffness. Closed contacts add to it, so the mass is
multiplied where the two together would exceed what a step of 1 bears, lambda_max(M^-1 K) <= 4; the
stiffness of the contacts is measured by power iteration. A motion that would close a gap almost is
shortened as a whole, and its momentum with it: as inelastic as a knock, and momentum and velocity
stay those of one mass, as the damping has to see.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.model.contact import SelfContact
from foilstudy.model.patch import RING_ROWS
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.mass import Mass, MassScaling
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling

_FREE = slice(RING_ROWS, -RING_ROWS)
_BOUND, _SHELL, _MARGIN = 3.8, 1.4, 1.1
"""Largest eigenvalue allowed, what the shell is taken to have of it where sheets touch, and the
factor on what power iteration has found of the contacts."""
_EVERY, _ITERATIONS = 5, 2
_CLOSING = 0.9
"""Share of its gap by which a pair may close in a step."""
_SHORTENINGS = 12


@dataclass(frozen=True)
class TouchingMassScaling:
    """A mass of the shell, and what contact makes of it.

    Attributes
    ----------
    shell : MassScaling
        Alone at work as long as nothing touches.
    """

    kind = "touching"
    shell: MassScaling = field(default_factory=SpectralMassScaling)

    def start(self, problem: Problem) -> Mass:
        """See `MassScaling`; of a problem without contact it is the mass of the shell."""
        mass = self.shell.start(problem)
        contacts = [term for term in problem.terms if isinstance(term, SelfContact)]
        return TouchingMass(mass, contacts[0]) if contacts else mass


class TouchingMass:
    """See `TouchingMassScaling`; at work in one relaxation.

    The force has to be asked for at the present shape before the velocity is.

    Attributes
    ----------
    largest_factor : float
        On the mass, so far.
    shortened : int
        Steps that were shortened.
    """

    def __init__(self, shell: Mass, contact: SelfContact):
        self._shell, self._contact = shell, contact
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
        if not np.isfinite(momentum).all():
            return self._shell.velocity(momentum)
        factor = self._mass_factor(momentum)
        velocity = self._shell.velocity(momentum)
        if factor > 1.0:
            velocity = velocity / factor
        motion, rings = self._contact.knot_motion(velocity), self._ring_motion()
        share = self._passable(motion, rings)
        if share < 1.0:
            self.shortened += 1
            momentum *= share
            velocity, motion = share * velocity, share * motion
        self._knots, self._moved = self._contact.knots, motion
        return velocity

    def _ring_motion(self) -> np.ndarray | float:
        """What the rings moved the knots by in the last step beside their own motion.

        The ramp is smooth, so that it is what they will move them by in this one.
        """
        here = self._contact.knots
        if self._knots is None or np.array_equal(here[-1], self._knots[-1]):
            return 0.0
        return here - self._knots - self._moved

    def _passable(self, motion: np.ndarray, rings: np.ndarray | float) -> float:
        share = 1.0
        for _ in range(_SHORTENINGS):
            passed = self._contact.passable_share(share * motion + rings, _CLOSING)
            if passed >= 1.0:
                return share
            share *= min(passed, 0.9)
        if self._contact.passable_share(0.0 * motion + rings, _CLOSING) >= 1.0:
            return 0.0
        raise SolveError("the rings close a gap between parts of the foil; use more ramp steps")

    def _mass_factor(self, momentum: np.ndarray) -> float:
        """Factor on the mass that keeps a step stable, measured every few steps."""
        if not len(self._contact.closed()):
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
            force = self._contact.spring_forces(self._probe)
            response = self._shell.velocity(force).copy()
            size = np.sum(response * force)  # f M^-1 f = x K M^-1 K x
            if not size > 0:
                return 0.0
            work = np.sum(self._probe * force)
            largest = size / work
            self._probe = response / np.sqrt(size)
        return float(largest)
