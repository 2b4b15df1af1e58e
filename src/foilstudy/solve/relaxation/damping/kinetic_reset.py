"""Kinetic damping in its plain form: velocities are cleared once the kinetic energy has fallen."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.relaxation.damping import Damper, Halt


@dataclass(frozen=True)
class KineticResetDamping:
    """Stops half a step to one and a half after the peak, at the shape that has been reached.

    The loop then goes on as if nothing had been: the first step from rest takes the whole force,
    twice what leads from rest to the middle of a step, and brings a mode of frequency omega (rad
    per step) from x to (1 - omega^2) x. Beyond omega^2 = 2, a step of 0.71 of the stable one, stop
    after stop drives it.
    """

    kind = "kinetic_reset"

    @classmethod
    def for_ramp(cls) -> KineticResetDamping:
        """See `Damping`."""
        return cls()

    @classmethod
    def for_relaxation(cls) -> KineticResetDamping:
        """See `Damping`."""
        return cls()

    def start(self) -> Damper:
        """See `Damping`."""
        return _Falls()


class _Falls(Damper):
    def __init__(self) -> None:
        self._last = 0.0

    def coefficient(self, work_rate: float, momentum_norm: float) -> float:
        return 0.0

    def halt(self, momentum_norm: float) -> Halt | None:
        fallen = momentum_norm < self._last
        self._last = 0.0 if fallen else momentum_norm
        return Halt(back=0.0, push=1.0) if fallen else None
