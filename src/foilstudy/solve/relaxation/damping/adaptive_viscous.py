"""Adaptive viscous damping."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.solve.relaxation.damping import Damper

_RAMP, _RELAXATION = 0.5, 0.06
"""Share of the critical damping of the current motion, while the ring moves and after. The Rayleigh
quotient overestimates the slowest mode, so that less damping settles sooner (docs/method.md)."""
_LARGEST = 1.9
"""Of the coefficient; at 2 the motion would stop within a step."""


@dataclass(frozen=True)
class AdaptiveViscousDamping:
    """Damping in proportion to the frequency of the sheet's current motion (after Underwood 1983).

    c = 2 scale omega_0 with the Rayleigh quotient omega_0^2 = |v . (f - f_old)| / (v . M v), its
    numerator and denominator averaged over the last steps. Without the average the coefficient
    jumps from step to step and amplifies rounding errors: a relative perturbation of 1e-15 grew to
    millimetres along a ramp, with it to 1e-9 mm.

    Attributes
    ----------
    scale : float
        1 damps a single mode critically.
    memory : float
        Steps over which the average decays to 1/e.
    """

    kind = "adaptive_viscous"
    scale: float = 1.0
    memory: float = 50.0

    @classmethod
    def for_ramp(cls) -> AdaptiveViscousDamping:
        """See `Damping`."""
        return cls(_RAMP)

    @classmethod
    def for_relaxation(cls) -> AdaptiveViscousDamping:
        """See `Damping`."""
        return cls(_RELAXATION)

    def start(self) -> _Averages:
        """See `Damping`."""
        return _Averages(self)


class _Averages(Damper):
    def __init__(self, damping: AdaptiveViscousDamping):
        self._scale = damping.scale
        self._weight = 1.0 / damping.memory
        self._work_rate = 0.0
        self._momentum_norm = 0.0

    def coefficient(self, work_rate: float, momentum_norm: float) -> float:
        self._work_rate += self._weight * (abs(work_rate) - self._work_rate)
        self._momentum_norm += self._weight * (momentum_norm - self._momentum_norm)
        if self._momentum_norm <= 0.0:
            return 0.0
        return min(2.0 * self._scale * np.sqrt(self._work_rate / self._momentum_norm), _LARGEST)
