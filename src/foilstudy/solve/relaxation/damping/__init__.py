"""Dampings of the relaxation: one file each, all of the protocol `Damping`.

A damping is a frozen specification; what it remembers of a motion lives in the object that `start`
returns, one for each run.
"""

from __future__ import annotations

from typing import Protocol

__all__ = ["Damper", "Damping"]


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


class Damping(Protocol):
    """Chooses the viscous coefficient of every pseudo-time step.

    Its class has methods ``for_ramp()`` and ``for_relaxation()``, which make the one that a study
    takes while the ring moves, and after.
    """

    def start(self) -> Damper:
        """At work on a motion that begins now."""
        ...
