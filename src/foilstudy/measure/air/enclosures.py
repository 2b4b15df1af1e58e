"""What happens to the air that foil, rings and end plates enclose."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Self

from foilstudy.base.ranges import require_number


@dataclass(frozen=True)
class Vented:
    """It passes an opening, without resistance and without inertia."""

    kind: ClassVar[str] = "vented"

    @classmethod
    def under(cls, pressure: float) -> Self:
        """Whatever the pressure, Pa."""
        return cls()

    def stiffness(self, volume: float) -> float:
        """Pressure per volume that is taken from it, Pa/m3."""
        return 0.0


@dataclass(frozen=True)
class _Sealed:
    """It is compressed.

    Attributes
    ----------
    pressure : float
        Pa, inside as outside.
    """

    exponent: ClassVar[float]
    pressure: float = 101_325.0

    def __post_init__(self):
        require_number("pressure of the air", self.pressure, "Pa", least=0)

    @classmethod
    def under(cls, pressure: float) -> Self:
        """At a pressure, Pa."""
        return cls(pressure)

    def stiffness(self, volume: float) -> float:
        """Pressure per volume that is taken from it, Pa/m3."""
        return self.exponent * self.pressure / volume


@dataclass(frozen=True)
class SealedIsothermal(_Sealed):
    """So slowly that it keeps its temperature."""

    kind: ClassVar[str] = "sealed_isothermal"
    exponent: ClassVar[float] = 1.0


@dataclass(frozen=True)
class SealedAdiabatic(_Sealed):
    """So fast that it keeps its heat."""

    kind: ClassVar[str] = "sealed_adiabatic"
    exponent: ClassVar[float] = 1.4
