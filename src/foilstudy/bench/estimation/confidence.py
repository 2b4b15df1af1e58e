"""How far a response may err by chance (J. S. Bendat, A. G. Piersol, Random Data, 4th ed., 2010,
section 9.2)."""

from __future__ import annotations

import numpy as np

from foilstudy.base.confidence import CONFIDENCE

__all__ = ["deviation", "radius"]


def deviation(response: np.ndarray, coherence: np.ndarray, averages: float) -> np.ndarray:
    """Standard deviation sqrt(E|error|^2) of a response estimated by averages of blocks.

    |H| sqrt((1 - coherence) / (averages coherence)); of the magnitude, and of the phase times
    |H|, it is 1/sqrt(2) of that. For noise at the output, or little at the input.
    """
    share = np.maximum(1 - coherence, 0.0) / (averages * coherence)
    return np.abs(response) * np.sqrt(share)


def radius(
    response: np.ndarray, coherence: np.ndarray, averages: float, confidence: float = CONFIDENCE
) -> np.ndarray:
    """Radius of the circle about a response in which the true one lies with some confidence.

    |error|^2 <= |H|^2 (1 - coherence)/coherence F / (averages - 1), F the quantile of Fisher's
    distribution with 2 and 2 averages - 2 degrees of freedom; infinite with one average.
    """
    if averages <= 1:
        return np.full(np.shape(response), np.inf)
    freedom = 2 * averages - 2
    # quantile with 2 degrees of freedom above, in closed form
    quantile = 0.5 * freedom * ((1 - confidence) ** (-2 / freedom) - 1)
    share = np.maximum(1 - coherence, 0.0) / coherence * quantile / (averages - 1)
    return np.abs(response) * np.sqrt(share)
