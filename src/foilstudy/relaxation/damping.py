"""What the relaxation asks of a damping, and adaptive viscous damping."""

from __future__ import annotations

from typing import Protocol

import numpy as np


class Damping(Protocol):
    """Chooses the viscous coefficient c of the next pseudo-time step."""

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


class AdaptiveViscousDamping:
    """Critical damping of the mode in which the sheet currently moves (Underwood 1983).

    c = 2 omega_0 with the Rayleigh quotient omega_0^2 = |v . (f - f_old)| / (v . M v).
    """

    def __init__(self, scale: float = 1.0):
        self.scale = scale

    def coefficient(self, work_rate: float, momentum_norm: float) -> float:
        if momentum_norm <= 0.0:
            return 0.0
        return min(2.0 * self.scale * np.sqrt(abs(work_rate) / momentum_norm), 1.9)
