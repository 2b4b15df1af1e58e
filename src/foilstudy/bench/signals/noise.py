"""Coloured noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_count, require_number
from foilstudy.bench.signals.periodic import PeriodicSignal

__all__ = ["ColouredNoise"]


@dataclass(frozen=True)
class ColouredNoise:
    """Normal noise of one record: power density follows frequency to a power within a band.

    Made line by line over the whole record, so that a record is one period of it.

    Attributes
    ----------
    low_hz, high_hz : float
        Band.
    rms : float
        Expected root of the mean square, in the unit of the signal; that of one record scatters.
    duration_s : float
        Of the record.
    exponent : float
        Of the power density: 0 white, -1 pink, -2 brown.
    seed, realisation : int
    """

    kind = "noise"
    low_hz: float
    high_hz: float
    rms: float
    duration_s: float = 60.0
    exponent: float = 0.0
    seed: int = 0
    realisation: int = 0

    def __post_init__(self) -> None:
        require_number("lower end of a noise", self.low_hz, "Hz", least=0)
        require_number("upper end of a noise", self.high_hz, "Hz", above=self.low_hz)
        require_number("rms of a noise", self.rms, above=0)
        require_number("duration of a noise", self.duration_s, "s", above=0)
        require_number("exponent of a noise", self.exponent)
        require_count("seed of a noise", self.seed, 0)
        require_count("realisation of a noise", self.realisation, 0)

    def signal(self) -> PeriodicSignal:
        """See `Excitation`.

        Raises
        ------
        Refusal
            If the record is too short for its band.
        """
        first = max(1, int(np.ceil(self.low_hz * self.duration_s - 1e-9)))
        lines = np.arange(first, int(np.floor(self.high_hz * self.duration_s + 1e-9)) + 1)
        if not lines.size:
            raise Refusal(
                f"{self.duration_s:g} s hold no line from {self.low_hz:g} to {self.high_hz:g} Hz; "
                "lengthen the record or widen the band."
            )
        rng = np.random.default_rng([self.seed, 2, self.realisation])
        power = (lines / lines[-1]) ** self.exponent
        power *= self.rms**2 / power.sum()  # a line of amplitude A has the mean square |A|^2/2
        normal = rng.standard_normal((2, lines.size))
        return PeriodicSignal(self.duration_s, lines, np.sqrt(power) * (normal[0] + 1j * normal[1]))
