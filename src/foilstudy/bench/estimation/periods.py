"""Averages over whole periods, in step with the excitation: no leakage, noise told from signal."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_count, require_number
from foilstudy.bench.signals.periodic import samples_of_period

if TYPE_CHECKING:
    from foilstudy.bench.estimation.channels import Combination
    from foilstudy.bench.recording import Recording

__all__ = ["PeriodMeans", "Periods", "period_means"]

_UNSYNCHRONISED = 0.1
"""Share of the power that may be left outside of the mean over periods, all channels considered."""


@dataclass(frozen=True)
class Periods:
    """How a record is cut.

    Attributes
    ----------
    period_s : float
    skipped : int
        Periods at the beginning that are left out, in which the rig comes to its steady state.
    """

    period_s: float
    skipped: int = 1

    def __post_init__(self) -> None:
        require_number("period", self.period_s, "s", above=0)
        require_count("number of periods left out", self.skipped, 0)


@dataclass(frozen=True, eq=False)
class PeriodMeans:
    """Spectral lines of signals: mean over periods and covariance of one period.

    Attributes
    ----------
    frequencies : ndarray, shape (f,)
        Hz.
    means : ndarray of complex, shape (f, n)
        Peak amplitudes.
    covariance : ndarray of complex, shape (f, n, n)
        Of one period, mean of conj(e_i) e_j.
    periods : int
    """

    frequencies: np.ndarray
    means: np.ndarray
    covariance: np.ndarray
    periods: int

    def combined(self, combination: Combination) -> Self:
        """Of signals that are combinations of these."""
        weights = combination.at(self.frequencies)
        return replace(
            self,
            means=(weights @ self.means[:, :, None])[:, :, 0],
            covariance=weights.conj() @ self.covariance @ weights.swapaxes(1, 2),
        )

    def at(self, places: np.ndarray) -> Self:
        """Some of the frequencies."""
        return replace(
            self,
            frequencies=self.frequencies[places],
            means=self.means[places],
            covariance=self.covariance[places],
        )

    def response(self, source: int, sink: int) -> np.ndarray:
        """Output per input: ratio of the means."""
        return self.means[:, sink] / self.means[:, source]

    def variance(self, source: int, sink: int) -> np.ndarray:
        """E|error|^2 of the response by noise that does not repeat, to first order.

        |G|^2 (s_yy/|Y|^2 + s_xx/|X|^2 - 2 Re(s_xy / (conj(X) Y))) / periods.
        """
        x, y = self.means[:, source], self.means[:, sink]
        s = self.covariance
        shares = s[:, sink, sink].real / np.abs(y) ** 2 + s[:, source, source].real / np.abs(x) ** 2
        shares -= 2 * (s[:, source, sink] / (x.conj() * y)).real
        return np.abs(y / x) ** 2 * np.maximum(shares, 0.0) / self.periods


def period_means(recording: Recording, periods: Periods, highest_hz: float) -> PeriodMeans:
    """Mean and covariance of the lines up to a frequency, one period in memory at a time.

    Raises
    ------
    Refusal
        If fewer than two periods are left, or a period is no whole number of samples.
    """
    length = samples_of_period(periods.period_s, recording.rate_hz)
    count = recording.samples // length - periods.skipped
    if count < 2:
        raise Refusal(
            f"a record of {recording.samples / recording.rate_hz:g} s leaves {max(count, 0)} whole "
            f"periods of {periods.period_s:g} s after {periods.skipped} left out, and noise is "
            "told from signal by two; record longer."
        )
    last = min(int(np.floor(highest_hz * periods.period_s + 1e-9)), (length - 1) // 2)
    channels = len(recording.channels)
    mean = np.zeros((last, channels), dtype=complex)
    scatter = np.zeros((last, channels, channels), dtype=complex)
    for k in range(count):
        start = (periods.skipped + k) * length
        values = recording.read(start, start + length)
        lines = 2 / length * np.fft.rfft(values)[:, 1 : last + 1].T
        # running mean and covariance (B. P. Welford, Technometrics 4 (1962) 419-420)
        off = lines - mean
        mean += off / (k + 1)
        scatter += k / (k + 1) * off.conj()[:, :, None] * off[:, None, :]
    frequencies = np.arange(1, last + 1) / periods.period_s
    return PeriodMeans(frequencies, mean, scatter / (count - 1), count)


def require_synchronous(means: PeriodMeans) -> None:
    """Refuse means of a record that does not repeat with its period.

    Raises
    ------
    Refusal
    """
    noise = np.trace(means.covariance, axis1=1, axis2=2).real.sum()
    signal = np.sum(np.abs(means.means) ** 2)
    if noise > _UNSYNCHRONISED * (noise + signal):
        raise Refusal(
            f"{noise / (noise + signal):.0%} of the power does not repeat from period to period; "
            "give the period of the excitation, and let generator and recorder share a clock."
        )
