"""What a file of time signals holds, before it is known what the sensors are fixed to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.recording import ACCELERATION, FORCE, GRAVITY

__all__ = ["SignalFormat", "Signals", "even_rate", "sized"]

_UNITS = {
    "m/s^2": (ACCELERATION, 1.0),
    "mm/s^2": (ACCELERATION, 1e-3),
    "g": (ACCELERATION, GRAVITY),
    "N": (FORCE, 1.0),
    "kN": (FORCE, 1e3),
    "mN": (FORCE, 1e-3),
}
"""Units as they are written in a file: what they become, and their size in that."""

_UNEVEN = 1e-2
"""Largest departure of a time from even steps, in steps."""


@dataclass(frozen=True, eq=False)
class Signals:
    """Signals that were sampled together.

    Attributes
    ----------
    names, units : tuple of str
        As they stand in the file.
    rate_hz : float
    values : ndarray, shape (signals, samples)
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    rate_hz: float
    values: np.ndarray


class SignalFormat(Protocol):
    """Reads and writes all signals of a file; refuses in a sentence what it cannot read."""

    def read(self, path: Path) -> Signals: ...

    def write(self, signals: Signals, path: Path) -> None: ...


def sized(path: Path, name: str, unit: str) -> tuple[str, float]:
    """Unit of a channel of a recording, and the size of the file's unit in it.

    Raises
    ------
    Refusal
        If it is no unit of acceleration or force.
    """
    plain = unit.strip().replace("²", "^2").replace("s2", "s^2").replace("**", "^")
    if plain not in _UNITS:
        raise Refusal(
            f"{path}: channel {name} is in {unit.strip() or 'no unit'!r}, which is no unit of "
            f"acceleration or force known here; convert it to one of {', '.join(_UNITS)}."
        )
    return _UNITS[plain]


def even_rate(path: Path, times: np.ndarray) -> float:
    """Sampling rate from times, Hz; the nearest whole number where they cannot tell it from that.

    Raises
    ------
    Refusal
        If they are fewer than two or not evenly spaced.
    """
    times = np.asarray(times, float)
    step = (times[-1] - times[0]) / (times.size - 1) if times.size > 1 else 0.0
    if not step > 0:
        raise Refusal(f"{path}: the times do not rise; give one for each sample, in s.")
    off = np.abs(times - times[0] - step * np.arange(times.size)).max() / step
    if not off < _UNEVEN:
        raise Refusal(
            f"{path}: the times are not evenly spaced (off by {off:.2g} steps), so that the "
            "samples were not taken in step; record with a fixed rate."
        )
    return whole_rate(1 / step, 1e-6)


def whole_rate(rate_hz: float, digits: float) -> float:
    """The whole number of hertz that a rate is within its digits, else the rate."""
    nearest = round(rate_hz)
    return float(nearest) if nearest and abs(rate_hz / nearest - 1) < digits else rate_hz
