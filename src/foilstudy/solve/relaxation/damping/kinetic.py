"""Kinetic damping: an undamped motion that is stopped wherever its kinetic energy peaks.

After Cundall (1976) and Barnes (1988). A single mode has its peak at equilibrium, so that it is at
rest there after a quarter of its period. Many modes peak together only by chance, and each stop
ends the slow motion, too, that the sheet needs to fold.
"""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.relaxation.damping import Damper, Halt

_BEFORE_A_PEAK = 0.5
"""Steps from the middle of a step, where its velocity stands, to the shape at its end."""


@dataclass(frozen=True)
class KineticDamping:
    """Stops where the parabola through the last three kinetic energies has its peak."""

    kind = "kinetic"

    @classmethod
    def for_ramp(cls) -> KineticDamping:
        """See `Damping`."""
        return cls()

    @classmethod
    def for_relaxation(cls) -> KineticDamping:
        """See `Damping`."""
        return cls()

    def start(self) -> Damper:
        """See `Damping`."""
        return _Peaks()


class _Peaks(Damper):
    def __init__(self) -> None:
        self._earlier = self._last = 0.0

    def coefficient(self, work_rate: float, momentum_norm: float) -> float:
        return 0.0

    def halt(self, momentum_norm: float) -> Halt | None:
        first, second, third = self._earlier, self._last, momentum_norm
        if not third < second:
            self._earlier, self._last = second, third
            return None
        self._earlier = self._last = 0.0
        # the first is not above the second, or the motion had stopped there
        after = 0.5 * (third - first) / (2 * second - first - third)
        return Halt(_BEFORE_A_PEAK - after)
