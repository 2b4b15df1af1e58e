"""Multisine with random phases."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_count, require_number
from foilstudy.base.registry import UnknownChoice, did_you_mean
from foilstudy.bench.signals.periodic import PeriodicSignal

__all__ = ["GRIDS", "Multisine"]

DETECTION = 4
"""Of so many consecutive odd lines one, drawn at random, is left out as a detection line."""


def _all(lines: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    return lines


def _odd(lines: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    return lines[lines % 2 == 1]


def _odd_skipped(lines: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    odd = _odd(lines, rng)
    kept = np.ones(odd.size, dtype=bool)
    groups = odd.size // DETECTION
    kept[np.arange(groups) * DETECTION + rng.integers(0, DETECTION, groups)] = False
    return odd[kept]


GRIDS: dict[str, Callable[[np.ndarray, np.random.Generator], np.ndarray]] = {
    "all": _all,
    "odd": _odd,
    "odd_skipped": _odd_skipped,
}
"""Which lines of the band are excited. Odd ones leave the even lines to show even distortion; the
odd ones left out at random show odd distortion (R. Pintelon and J. Schoukens, System
Identification: A Frequency Domain Approach, 2nd ed., 2012, chapter 4)."""


@dataclass(frozen=True)
class Multisine:
    """Sum of harmonics of 1/period with random phases.

    Attributes
    ----------
    low_hz, high_hz : float
        Band; its ends count if they are lines.
    rms : float
        In the unit of the signal.
    period_s : float
    lines : str
        A name of `GRIDS`.
    slope : float
        Amplitude follows frequency to this power.
    seed, realisation : int
        Another realisation has the same lines and other phases.
    """

    kind = "multisine"
    low_hz: float
    high_hz: float
    rms: float
    period_s: float = 8.0
    lines: str = "all"
    slope: float = 0.0
    seed: int = 0
    realisation: int = 0

    def __post_init__(self) -> None:
        require_number("lower end of a multisine", self.low_hz, "Hz", least=0)
        require_number("upper end of a multisine", self.high_hz, "Hz", above=self.low_hz)
        require_number("rms of a multisine", self.rms, above=0)
        require_number("period of a multisine", self.period_s, "s", above=0)
        require_number("slope of a multisine", self.slope)
        require_count("seed of a multisine", self.seed, 0)
        require_count("realisation of a multisine", self.realisation, 0)
        if self.lines not in GRIDS:
            hint = did_you_mean(self.lines, GRIDS)
            known = ", ".join(GRIDS)
            raise UnknownChoice(f"{self.lines!r} is no grid of lines; {hint}use one of {known}.")

    @classmethod
    def published(cls, rms: float, seed: int = 0) -> tuple[Self, Self]:
        """The two bands of the published work: 0 to 150 and 100 to 500 Hz, 0.125 Hz apart."""
        return cls(0.0, 150.0, rms, seed=seed), cls(100.0, 500.0, rms, seed=seed)

    def signal(self) -> PeriodicSignal:
        """See `Excitation`.

        Raises
        ------
        Refusal
            If no line lies in the band.
        """
        first = max(1, int(np.ceil(self.low_hz * self.period_s - 1e-9)))
        last = int(np.floor(self.high_hz * self.period_s + 1e-9))
        # a stream of its own for the lines, as realisations share them
        grid = np.random.default_rng([self.seed, 0])
        lines = GRIDS[self.lines](np.arange(first, last + 1), grid)
        if not lines.size:
            raise Refusal(
                f"a period of {self.period_s:g} s has no line to excite from {self.low_hz:g} to "
                f"{self.high_hz:g} Hz; lengthen the period or widen the band."
            )
        phases = np.random.default_rng([self.seed, 1, self.realisation])
        amplitudes = (lines / lines[-1]) ** self.slope * np.exp(
            2j * np.pi * phases.random(lines.size)
        )
        amplitudes *= self.rms / np.sqrt(0.5 * np.sum(np.abs(amplitudes) ** 2))
        return PeriodicSignal(self.period_s, lines, amplitudes)
