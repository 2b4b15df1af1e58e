"""Auto and cross spectra averaged over overlapping blocks (P. D. Welch, IEEE Trans. Audio
Electroacoust. 15 (1967) 70-73)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number
from foilstudy.bench.signals.periodic import samples_of_period

if TYPE_CHECKING:
    from foilstudy.bench.estimation.channels import Combination
    from foilstudy.bench.recording import Recording

__all__ = ["Blocks", "Spectra", "averaged"]


@dataclass(frozen=True)
class Blocks:
    """Hann-windowed blocks of a record.

    Attributes
    ----------
    length_s : float
    overlap : float
        Share of a block that the next one has in common with it.
    """

    length_s: float = 2.0
    overlap: float = 0.5

    def __post_init__(self) -> None:
        require_number("length of a block", self.length_s, "s", above=0)
        require_number("overlap of blocks", self.overlap, least=0, below=1)


@dataclass(frozen=True, eq=False)
class Spectra:
    """One-sided densities of all pairs of signals.

    Attributes
    ----------
    frequencies : ndarray, shape (f,)
        Hz, without zero.
    matrix : ndarray of complex, shape (f, n, n)
        Mean of conj(X_i) X_j, in the product of the units per Hz.
    blocks : int
    averages : float
        Independent blocks that would leave the same scatter; less than `blocks` when they overlap.
    """

    frequencies: np.ndarray
    matrix: np.ndarray
    blocks: int
    averages: float

    def combined(self, combination: Combination) -> Self:
        """Spectra of signals that are combinations of these."""
        weights = combination.at(self.frequencies)
        matrix = weights.conj() @ self.matrix @ weights.swapaxes(1, 2)
        return replace(self, matrix=matrix)

    def of(self, source: int, sink: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """S_xx, S_yy and S_xy of two of the signals."""
        inputs, outputs = self.matrix[:, source, source].real, self.matrix[:, sink, sink].real
        return inputs, outputs, self.matrix[:, source, sink]

    def coherence(self, source: int, sink: int) -> np.ndarray:
        """|S_xy|^2 / (S_xx S_yy)."""
        inputs, outputs, cross = self.of(source, sink)
        return np.abs(cross) ** 2 / (inputs * outputs)


def averaged(recording: Recording, blocks: Blocks, highest_hz: float) -> Spectra:
    """Spectra of all channels up to a frequency, one block in memory at a time.

    The mean of each block is taken off before it is windowed.

    Raises
    ------
    Refusal
        If there are fewer than two blocks, or the frequency cannot be had at this rate.
    """
    length = samples_of_period(blocks.length_s, recording.rate_hz)
    hop = max(1, round(length * (1 - blocks.overlap)))
    starts = range(0, recording.samples - length + 1, hop)
    if len(starts) < 2:
        raise Refusal(
            f"a record of {recording.samples / recording.rate_hz:g} s gives {len(starts)} blocks "
            f"of {blocks.length_s:g} s, and averages need two; record longer or shorten the blocks."
        )
    if not 1 / blocks.length_s <= highest_hz <= recording.rate_hz / 2:
        raise Refusal(
            f"spectra up to {highest_hz:g} Hz cannot be had from blocks of {blocks.length_s:g} s "
            f"at {recording.rate_hz:g} Hz; choose between {1 / blocks.length_s:g} and "
            f"{recording.rate_hz / 2:g} Hz."
        )
    window = hann(length)
    last = int(np.floor(highest_hz * blocks.length_s + 1e-9))
    channels = len(recording.channels)
    total = np.zeros((last, channels, channels), dtype=complex)
    for values in overlapping(recording, starts, length):
        values = values - values.mean(axis=1, keepdims=True)
        lines = np.fft.rfft(values * window)[:, 1 : last + 1].T
        total += lines.conj()[:, :, None] * lines[:, None, :]
    scale = 2 / (recording.rate_hz * np.sum(window**2) * len(starts))
    frequencies = np.arange(1, last + 1) / blocks.length_s
    return Spectra(frequencies, total * scale, len(starts), independent(window, hop, len(starts)))


def overlapping(recording: Recording, starts: Sequence[int], length: int) -> Iterator[np.ndarray]:
    """Blocks that overlap, each sample read once."""
    kept = recording.read(starts[0], starts[0] + length)
    yield kept
    for last, start in pairwise(starts):
        end = last + length
        fresh = recording.read(max(end, start), start + length)
        kept = np.concatenate([kept[:, min(start - last, length) :], fresh], axis=1)
        yield kept


def hann(length: int) -> np.ndarray:
    """Periodic Hann window."""
    return 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(length) / length)


def independent(window: np.ndarray, hop: int, count: int) -> float:
    """Independent blocks with the same variance of their mean as overlapping ones of white noise.

    With r_k, the correlation of the powers of blocks k hops apart, (sum_i w_i w_{i+k hop} /
    sum w^2)^2: n / (1 + 2 sum_k (1 - k/n) r_k), Welch's formula.
    """
    correlated, power = 0.0, np.sum(window**2)
    for k in range(1, min(count, -(-window.size // hop))):
        shared = np.sum(window[k * hop :] * window[: window.size - k * hop]) / power
        correlated += (1 - k / count) * shared**2
    return count / (1 + 2 * correlated)
