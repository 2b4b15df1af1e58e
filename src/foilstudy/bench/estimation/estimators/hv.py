"""Hv: total least squares with equal shares of noise at input and output."""

from __future__ import annotations

import numpy as np


def response(inputs: np.ndarray, outputs: np.ndarray, cross: np.ndarray) -> np.ndarray:
    """sqrt(S_yy / S_xx) with the phase of S_xy, see `Estimator`.

    G. T. Rocklin, J. Crowley, H. Vold, A comparison of H1, H2, and Hv frequency response
    functions, Proc. 3rd IMAC (1985) 272-278.
    """
    return np.sqrt(outputs / inputs) * cross / np.abs(cross)
