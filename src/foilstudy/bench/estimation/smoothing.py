"""Symmetric moving average over frequency."""

from __future__ import annotations

import numpy as np

from foilstudy.base.ranges import require_number

__all__ = ["moving_average"]


def moving_average(frequencies: np.ndarray, values: np.ndarray, width_hz: float) -> np.ndarray:
    """Mean of all values within half a width of each frequency.

    At the ends the window is cut off and no longer symmetric: with 30 Hz the value at 10 Hz is a
    mean from the lowest frequency to 25 Hz.

    Parameters
    ----------
    frequencies : ndarray, shape (f,)
        Hz, rising.
    values : ndarray, shape (f,)
        Real or complex.
    width_hz : float
        0 leaves all as it is.
    """
    require_number("width of a moving average", width_hz, "Hz", least=0)
    slack = 1e-9 * frequencies[-1]
    first = np.searchsorted(frequencies, frequencies - width_hz / 2 - slack, side="left")
    after = np.searchsorted(frequencies, frequencies + width_hz / 2 + slack, side="right")
    sums = np.concatenate([[0], np.cumsum(values)])
    return (sums[after] - sums[first]) / (after - first)
