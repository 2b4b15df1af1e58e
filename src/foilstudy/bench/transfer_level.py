"""Transfer stiffness in the form of ISO 10846: levels re 1 N/m, in one-third octaves.

Limits are those by which the standard is usually cited; they were not checked against its text.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal

__all__ = ["ThirdOctave", "blocked", "level", "linear", "third_octaves"]

REFERENCE = 1.0
"""N/m."""
LEAST_LINES = 5
"""Frequencies in a band that make a mean of it."""
BLOCKING_DB = 20.0
"""By how much the acceleration of the output has to stay below that of the input, for the force
on the output to be the blocking force."""
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
