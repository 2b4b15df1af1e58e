"""Adaptive viscous damping without its average, as published."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.relaxation.damping import Damper
from foilstudy.solve.relaxation.damping.adaptive_viscous import AdaptiveViscousDamping


@dataclass(frozen=True)
class PlainAdaptiveViscousDamping:
    """Damping in proportion to the Rayleigh quotient of the last step alone (Underwood 1983).

    See `AdaptiveViscousDamping`: the coefficient jumps from step to step.

    Attributes
    ----------
    scale : float
        1 damps a single mode critically.
    """

    kind = "adaptive_viscous_plain"
    scale: float = 1.0

    @classmethod
    def for_ramp(cls) -> PlainAdaptiveViscousDamping:
        """See `Damping`; the share that the averaged one takes."""
        return cls(AdaptiveViscousDamping.for_ramp().scale)

    @classmethod
    def for_relaxation(cls) -> PlainAdaptiveViscousDamping:
        """See `Damping`; the share that the averaged one takes."""
        return cls(AdaptiveViscousDamping.for_relaxation().scale)

    def start(self) -> Damper:
        """See `Damping`."""
        return AdaptiveViscousDamping(self.scale, memory=1.0).start()
