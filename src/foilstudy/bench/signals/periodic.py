"""A periodic signal as its lines."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal

__all__ = ["PeriodicSignal", "samples_of_period"]


@dataclass(frozen=True, eq=False)
class PeriodicSignal:
    """x(t) = Re sum_k A_k exp(2 pi i l_k t / T).

    Attributes
    ----------
    period_s : float
        T.
    lines : ndarray of int
        l_k, rising, from 1 on: the multiples of 1/T that are not zero.
    amplitudes : ndarray of complex
        A_k, peak values in the unit of the signal.
    """

    period_s: float
    lines: np.ndarray
    amplitudes: np.ndarray

    def __repr__(self) -> str:
        low, high = self.frequencies[[0, -1]]
        return (
            f"<PeriodicSignal: {self.lines.size} lines, {low:g} to {high:g} Hz, period "
            f"{self.period_s:g} s, rms {self.rms:.3g}>"
        )

    @property
    def frequencies(self) -> np.ndarray:
        """Of the lines, Hz."""
        return self.lines / self.period_s

    @property
    def rms(self) -> float:
        """Root of the mean square over a period."""
        return float(np.sqrt(0.5 * np.sum(np.abs(self.amplitudes) ** 2)))

    def samples(self, rate_hz: float) -> np.ndarray:
        """One period.

        Raises
        ------
        Refusal
            If a period is no whole number of samples, or a line lies at half of the rate or above.
        """
        return line_samples(self.lines, self.amplitudes, self.period_s, rate_hz)


def line_samples(
    lines: np.ndarray, amplitudes: np.ndarray, period_s: float, rate_hz: float
) -> np.ndarray:
    """One period of the signals with these amplitudes, shape (..., lines), sampled.

    Raises
    ------
    Refusal
        As `PeriodicSignal.samples`.
    """
    count = samples_of_period(period_s, rate_hz)
    if 2 * lines[-1] >= count:
        raise Refusal(
            f"a line of {lines[-1] / period_s:g} Hz cannot be sampled at {rate_hz:g} Hz; sample "
            f"at more than {2 * lines[-1] / period_s:g} Hz."
        )
    spectrum = np.zeros((*amplitudes.shape[:-1], count // 2 + 1), dtype=complex)
    spectrum[..., lines] = 0.5 * count * amplitudes
    return np.fft.irfft(spectrum, count)


def samples_of_period(period_s: float, rate_hz: float) -> int:
    """Samples in a period.

    Raises
    ------
    Refusal
        If that is no whole number.
    """
    exact = period_s * rate_hz
    count = round(exact)
    if count < 2 or abs(exact - count) > 1e-6:
        raise Refusal(
            f"a period of {period_s:g} s is {exact:g} samples at {rate_hz:g} Hz; choose the two "
            "so that it is a whole number of at least two."
        )
    return count
