"""No damping."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.relaxation.damping import Damper
from foilstudy.solve.relaxation.damping.fixed_viscous import Fixed


@dataclass(frozen=True)
class NoDamping:
    """The motion keeps its energy; rest is left to the minimisation."""

    kind = "none"

    @classmethod
    def for_ramp(cls) -> NoDamping:
        """See `Damping`."""
        return cls()

    @classmethod
    def for_relaxation(cls) -> NoDamping:
        """See `Damping`."""
        return cls()

    def start(self) -> Damper:
        """See `Damping`."""
        return Fixed(0.0)
