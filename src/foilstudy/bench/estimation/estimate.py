"""What every way of estimation returns."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number

__all__ = ["Estimate"]

COHERENT = 0.95
"""Coherence below which a value is not trusted."""


@dataclass(frozen=True, eq=False)
class Estimate:
    """A dynamic stiffness with what is known of its quality.

    Attributes
    ----------
    frequencies : ndarray, shape (f,)
        Hz, rising.
    values : ndarray of complex, shape (f,)
        N/m.
    deviation : ndarray, shape (f,)
        Standard deviation of the complex value, sqrt(E|error|^2), N/m; NaN where unknown. What
        errs the same way all the time, as a bypass does, is not in it.
    coherence : ndarray, shape (f,)
        Share of the force that goes with the motion; NaN where unknown.
    """

    frequencies: np.ndarray
    values: np.ndarray
    deviation: np.ndarray
    coherence: np.ndarray

    def __repr__(self) -> str:
        low, high = self.frequencies[[0, -1]]
        return f"<Estimate: {self.frequencies.size} frequencies, {low:g} to {high:g} Hz>"

    @property
    def trusted(self) -> np.ndarray:
        """Where the coherence is not below `COHERENT`; unknown counts as trusted."""
        return ~(self.coherence < COHERENT)

    def within(self, low_hz: float, high_hz: float) -> Self:
        """The part in a band, ends included.

        Raises
        ------
        Refusal
            If it holds no frequency.
        """
        slack = 1e-9 * max(high_hz, 1.0)
        kept = (self.frequencies >= low_hz - slack) & (self.frequencies <= high_hz + slack)
        if not kept.any():
            low, high = self.frequencies[[0, -1]]
            raise Refusal(
                f"there is no frequency from {low_hz:g} to {high_hz:g} Hz in an estimate from "
                f"{low:g} to {high:g} Hz; choose a band inside."
            )
        return self.at(kept)

    def at(self, places: np.ndarray) -> Self:
        """Some of the frequencies."""
        return replace(
            self,
            frequencies=self.frequencies[places],
            values=self.values[places],
            deviation=self.deviation[places],
            coherence=self.coherence[places],
        )

    def require_coherence(self, low_hz: float, high_hz: float) -> None:
        """Refuse a band in which no frequency is trusted.

        Raises
        ------
        Refusal
        """
        require_number("lower end of a band", low_hz, "Hz", least=0, below=high_hz)
        if not self.within(low_hz, high_hz).trusted.any():
            raise Refusal(
                f"the coherence is below {COHERENT:g} everywhere from {low_hz:g} to {high_hz:g} "
                "Hz; excite this band more strongly or read the stiffness from another."
            )
