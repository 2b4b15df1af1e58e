"""Dampings of the relaxation: one file each, all of the protocol `Damping`.

A damping is a frozen specification; what it remembers of a motion lives in the object that `start`
returns, one for each run.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

__all__ = ["Damper", "Damping", "Halt"]


@dataclass(frozen=True)
class Halt:
    """That an undamped motion stops, and where.

    Attributes
    ----------
    back : float
        Steps from the shape that has been reached back along the velocity that led there.
    push : float
        Share of the force in the first step from rest: 1/2 brings the velocity from a shape at rest
        to the middle of the step, 1 is what a loop does that only has its velocities cleared.
    """

    back: float = 0.0
    push: float = 0.5


class Damper(Protocol):
    """A damping at work on one motion."""

    def coefficient(self, work_rate: float, momentum_norm: float) -> float:
        """Coefficient c (mass proportional, per step) from the current motion.

        Parameters
        ----------
        work_rate : float
            v . (f - f_old): change of the internal force over the last step along the motion, J.
        momentum_norm : float
            v . M v, J.
        """
        ...

    def halt(self, momentum_norm: float) -> Halt | None:
        """Whether the motion stops instead of making a step; only of one without viscous damping.

        Parameters
        ----------
        momentum_norm : float
            v . M v with the velocity of the coming step, J.
        """
        return None


class Damping(Protocol):
    """Chooses how a motion loses its energy.

    Its class has methods ``for_ramp()`` and ``for_relaxation()``, which make the one that a study
    takes while the ring moves, and after.
    """

    def start(self) -> Damper:
        """At work on a motion that begins now."""
        ...
