"""Viscous damping of one coefficient."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.ranges import require_number
from foilstudy.solve.relaxation.damping import Damper


@dataclass(frozen=True)
class FixedViscousDamping:
    """The same coefficient in every step.

    A mode of frequency omega (rad per step) decays as exp(-c t/2) where it oscillates, c < 2 omega,
    which is critical. No coefficient suits both the motion of the whole sheet and that of a fold.

    Attributes
    ----------
    coefficient : float
        The c, mass proportional, per step; below 2, at which the motion would stop within a step.
    """

    kind = "fixed_viscous"
    coefficient: float = 0.02

    def __post_init__(self):
        require_number("coefficient of fixed viscous damping", self.coefficient, least=0, below=2)

    @classmethod
    def for_ramp(cls) -> FixedViscousDamping:
        """See `Damping`."""
        return cls()

    @classmethod
    def for_relaxation(cls) -> FixedViscousDamping:
        """See `Damping`."""
        return cls()

    def start(self) -> Damper:
        """See `Damping`."""
        return Fixed(self.coefficient)


class Fixed(Damper):
    """A coefficient that nothing changes."""

    def __init__(self, coefficient: float):
        self._coefficient = coefficient

    def coefficient(self, work_rate: float, momentum_norm: float) -> float:
        """See `Damper`."""
        return self._coefficient
