"""Best linear approximation from periods and realisations of a multisine, with what is noise and
what is distortion (R. Pintelon, J. Schoukens, System Identification: A Frequency Domain Approach,
2nd ed., 2012, section 4.3)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.channels import MOTION, REACTION, along
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.periods import (
    PeriodMeans,
    Periods,
    period_means,
    require_synchronous,
)
from foilstudy.bench.recording import Recording, Watched

__all__ = ["BestLinear", "best_linear", "excited_lines", "measured_lines"]


@dataclass(frozen=True, eq=False)
class BestLinear:
    """The linear response that comes closest for this kind and strength of excitation.

    Attributes
    ----------
    frequencies : ndarray, shape (f,)
        Hz, those that were excited.
    values : ndarray of complex, shape (f,)
        N/m.
    noise : ndarray, shape (f,)
        Standard deviation of the values by what does not repeat, N/m.
    total : ndarray, shape (f,)
        The same by all that changes from one realisation to another, distortion included; NaN
        from a single realisation, which cannot tell.
    realisations, periods : int
    """

    frequencies: np.ndarray
    values: np.ndarray
    noise: np.ndarray
    total: np.ndarray
    realisations: int
    periods: int

    @property
    def distortion(self) -> np.ndarray:
        """Standard deviation by nonlinear distortion of one realisation, N/m; NaN from one."""
        extra = self.realisations * (self.total**2 - self.noise**2)
        return np.sqrt(np.maximum(extra, 0.0))

    @property
    def estimate(self) -> Estimate:
        """With the larger of the two deviations, and the coherence that they make."""
        scatter = np.fmax(self.total, self.noise)
        count = self.realisations * self.periods
        share = count * scatter**2 / np.abs(self.values) ** 2
        return Estimate(self.frequencies, self.values, scatter, 1 / (1 + share))


def measured_lines(
    recording: Recording, periods: Periods, motion: int, gap_m: float, highest_hz: float
) -> PeriodMeans:
    """Lines of motion and force of one recording.

    Raises
    ------
    Refusal
        If a channel is unsound, or the record does not repeat with the period.
    """
    return sound_means(recording, periods, highest_hz).combined(
        along(recording.channels, motion, gap_m)
    )


def sound_means(recording: Recording, periods: Periods, highest_hz: float) -> PeriodMeans:
    """Lines of all channels of one recording.

    Raises
    ------
    Refusal
        If a channel is unsound, or the record does not repeat with the period.
    """
    watched = Watched(recording)
    means = period_means(watched, periods, highest_hz)
    watched.require_sound()
    require_synchronous(means)
    return means


def excited_lines(means: PeriodMeans, lines: np.ndarray) -> np.ndarray:
    """Where lines of a multisine are among those measured."""
    spacing = means.frequencies[0]
    numbers = np.rint(means.frequencies / spacing).astype(int)
    return np.isin(numbers, lines)


def best_linear(realisations: Sequence[PeriodMeans], lines: np.ndarray) -> BestLinear:
    """From the lines of motion and force of one or several realisations.

    Parameters
    ----------
    realisations : sequence of PeriodMeans
        As `measured_lines` gives them, all of the same periods.
    lines : ndarray of int
        Those that were excited.

    Raises
    ------
    Refusal
        If there is none, or they do not share their frequencies.
    """
    if not realisations:
        raise Refusal("a best linear approximation needs at least one realisation; give one.")
    first = realisations[0]
    if any(not np.array_equal(first.frequencies, each.frequencies) for each in realisations):
        raise Refusal("the realisations have other frequencies; cut them into the same periods.")
    kept = [each.at(excited_lines(each, lines)) for each in realisations]
    if not kept[0].frequencies.size:
        raise Refusal("none of the excited lines was measured; give those of this period.")
    responses = np.array([each.response(MOTION, REACTION) for each in kept])
    noise = np.array([each.variance(MOTION, REACTION) for each in kept]).mean(axis=0)
    count = len(kept)
    total = np.full(noise.shape, np.nan)
    if count > 1:
        total = np.sqrt(responses.var(axis=0, ddof=1) / count)
    values = responses.mean(axis=0)
    return BestLinear(
        kept[0].frequencies, values, np.sqrt(noise / count), total, count, first.periods
    )
