"""The static stiffness read from the low end of a dynamic one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from foilstudy.base.confidence import NORMAL_95
from foilstudy.bench.estimation.estimate import Estimate

__all__ = ["STATIC_BAND_HZ", "Static"]

STATIC_BAND_HZ = (1.0, 10.0)
"""Where the published work takes its mean."""


@dataclass(frozen=True)
class Static:
    """Mean of the magnitude over a band.

    Attributes
    ----------
    value, low, high : float
        N/m; the ends of its 95 % interval by chance errors alone, NaN where they are unknown.
    count : int
        Frequencies in the mean.
    """

    value: float
    low: float
    high: float
    count: int

    @classmethod
    def of(cls, estimate: Estimate, band_hz: tuple[float, float] = STATIC_BAND_HZ) -> Self:
        """Of the values in a band, errors of different frequencies taken as independent.

        A magnitude errs by 1/sqrt(2) of the deviation of the complex value.

        Raises
        ------
        Refusal
            If there is no frequency in the band or none that is coherent.
        """
        estimate.require_coherence(*band_hz)
        inside = estimate.within(*band_hz)
        value, count = float(np.abs(inside.values).mean()), inside.values.size
        half = NORMAL_95 * float(np.sqrt(np.sum(inside.deviation**2) / 2)) / count
        return cls(value, value - half, value + half, count)
