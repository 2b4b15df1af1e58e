"""Estimators of a frequency response from averaged spectra."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from foilstudy.base.registry import Choice, Registry

__all__ = ["ESTIMATORS", "Estimator"]


class Estimator(Protocol):
    """Output per input from three averaged spectra.

    Parameters
    ----------
    inputs, outputs : ndarray, shape (f,)
        Power spectra S_xx and S_yy.
    cross : ndarray of complex, shape (f,)
        S_xy, mean of conj(x) y.

    Returns
    -------
    ndarray of complex, shape (f,)
    """

    def __call__(
        self, inputs: np.ndarray, outputs: np.ndarray, cross: np.ndarray
    ) -> np.ndarray: ...


ESTIMATORS = Registry(
    "estimator",
    {
        "h1": Choice(
            "bench.estimation.estimators.h1:response",
            "S_xy / S_xx, without bias from noise at the output, too low with noise at the input",
        ),
        "h2": Choice(
            "bench.estimation.estimators.h2:response",
            "S_yy / S_yx, without bias from noise at the input, too high with noise at the output",
        ),
        "hv": Choice(
            "bench.estimation.estimators.hv:response",
            "geometric mean of h1 and h2, for equal shares of noise at both",
        ),
    },
)
