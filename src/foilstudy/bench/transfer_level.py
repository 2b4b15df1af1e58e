"""Transfer stiffness in the form of ISO 10846: levels re 1 N/m, in one-third octaves.

Limits are those by which the standard is usually cited; they were not checked against its text.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal

__all__ = [
    "ThirdOctave",
    "band_levels",
    "blocked",
    "level",
    "linear",
    "nominal_hz",
    "third_octaves",
]

REFERENCE = 1.0
"""N/m."""
LEAST_LINES = 5
"""Frequencies in a band that make a mean of it."""
BLOCKING_DB = 20.0
"""By how much the acceleration of the output has to stay below that of the input, for the force
on the output to be the blocking force."""
_PREFERRED = (1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0)
"""Of ISO 266."""
LINEAR_DB = 1.5
"""By how much the levels of two excitations may differ that are 10 dB apart."""


@dataclass(frozen=True)
class ThirdOctave:
    """A band of a transfer stiffness.

    Attributes
    ----------
    centre_hz : float
        Exact midband frequency 10^(n/10).
    level_db : float
        10 lg of the mean of |k|^2 over the frequencies in the band, re 1 N/m; NaN where they are
        fewer than `LEAST_LINES`.
    lines : int
    """

    centre_hz: float
    level_db: float
    lines: int


def level(stiffness: np.ndarray) -> np.ndarray:
    """20 lg |k| re 1 N/m, dB."""
    return 20 * np.log10(np.abs(stiffness) / REFERENCE)


def third_octaves(frequencies: np.ndarray, stiffness: np.ndarray) -> list[ThirdOctave]:
    """Levels of all bands that hold a frequency.

    Parameters
    ----------
    frequencies : ndarray, shape (f,)
        Hz, positive, evenly spaced: the mean counts each alike.
    stiffness : ndarray of complex, shape (f,)
        N/m.

    Raises
    ------
    Refusal
        If the frequencies are not positive and evenly spaced.
    """
    frequencies = np.asarray(frequencies, float)
    steps = np.diff(frequencies)
    even = frequencies.size > 1 and np.allclose(steps, steps[0], rtol=1e-6)
    if not even or frequencies[0] <= 0 or steps[0] <= 0:
        raise Refusal(
            "means over one-third octaves need positive, evenly spaced frequencies; interpolate "
            "the response to such."
        )
    numbers = np.floor(10 * np.log10(frequencies) + 0.5 + 1e-9).astype(int)
    found = []
    for number in np.unique(numbers):
        inside = numbers == number
        mean = np.mean(np.abs(stiffness[inside]) ** 2) / REFERENCE**2
        count = int(inside.sum())
        value = float(10 * np.log10(mean)) if count >= LEAST_LINES else np.nan
        found.append(ThirdOctave(float(10 ** (number / 10)), value, count))
    return found


def band_levels(frequencies: np.ndarray, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Levels of one-third octaves from any rising grid, such as a logarithmic one.

    The mean of |k|^2 over the frequency, which is taken as straight between the frequencies of the
    grid. Bands that the grid covers whole, with at least `LEAST_LINES` frequencies in them.

    Parameters
    ----------
    frequencies : ndarray, shape (f,)
        Hz, positive.
    stiffness : ndarray of complex, shape (..., f)
        N/m; NaN where it is not known.

    Returns
    -------
    centres : ndarray, shape (bands,)
        Hz.
    levels : ndarray, shape (..., bands)
        dB re 1 N/m; NaN where a value in the band is not known.
    """
    frequencies = np.asarray(frequencies, float)
    tenths = 10 * np.log10(frequencies[[0, -1]])
    numbers = np.arange(np.ceil(tenths[0]), np.floor(tenths[1]) + 1)
    ends = 10 ** ((numbers[:, None] + [-0.5, 0.5]) / 10)
    inside = (frequencies >= ends[:, :1]) & (frequencies <= ends[:, 1:])
    whole = (ends[:, 0] >= frequencies[0]) & (ends[:, 1] <= frequencies[-1])
    kept = whole & (inside.sum(axis=1) >= LEAST_LINES)
    power = np.abs(np.asarray(stiffness)) ** 2 / REFERENCE**2
    levels = np.empty((*power.shape[:-1], int(kept.sum())))
    for k, (low, high) in enumerate(ends[kept]):
        levels[..., k] = _mean_level(frequencies, power, low, high)
    return 10 ** (numbers[kept] / 10), levels


def _mean_level(frequencies: np.ndarray, power: np.ndarray, low: float, high: float) -> np.ndarray:
    between = (frequencies > low) & (frequencies < high)
    grid = np.concatenate([[low], frequencies[between], [high]])
    flat = power.reshape(-1, frequencies.size)
    values = np.array([np.interp(grid, frequencies, each) for each in flat])
    return 10 * np.log10(np.trapezoid(values, grid) / (high - low)).reshape(power.shape[:-1])


def nominal_hz(centre_hz: float) -> float:
    """Name of a band: its midband frequency in the preferred steps 1, 1.25, 1.6, ... 8."""
    number = round(10 * np.log10(centre_hz))
    return float(f"{_PREFERRED[number % 10] * 10.0 ** (number // 10):.4g}")


def blocked(transmissibility: np.ndarray, least_db: float = BLOCKING_DB) -> np.ndarray:
    """Where the output moves so little that its force is the blocking force.

    Parameters
    ----------
    transmissibility : ndarray
        Motion of the output per motion of the input.
    """
    return -20 * np.log10(np.abs(transmissibility)) >= least_db


def linear(weak: np.ndarray, strong: np.ndarray, most_db: float = LINEAR_DB) -> np.ndarray:
    """Where the stiffness under two excitations, 10 dB apart or more, has the same level."""
    return np.abs(level(weak) - level(strong)) <= most_db
