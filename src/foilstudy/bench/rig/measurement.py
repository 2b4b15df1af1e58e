"""Signals of a rig in its periodic steady state, with noise, as a recording.

A linear rig answers a periodic force line by line, so that a record of it is exact at any length
and starts without transient. A nonlinear axial force is brought in by alternating between time and
frequency until the motion repeats itself: the steady state again, with its harmonics.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number
from foilstudy.bench.recording import Channel
from foilstudy.bench.rig.rig import LinearResponse, Rig
from foilstudy.bench.rig.specimens.nonlinear import NonlinearAxial
from foilstudy.bench.signals import PeriodicSignal
from foilstudy.bench.signals.periodic import line_samples

__all__ = ["Measurement", "measured"]

_PIECE = 1 << 12
"""Samples whose noise is drawn together, so that it is the same however a record is read."""
_TOLERANCE = 1e-9
"""Change of the motion, over itself, at which the steady state is found."""
_ROUNDS = 200
_HARMONICS = 3
"""Multiples of the highest excited line up to which distortion is followed."""


@dataclass(frozen=True, eq=False)
class Measurement:
    """A recording made on the spot: a period repeated, with noise of its own in every piece.

    Attributes
    ----------
    channels : tuple of Channel
    rate_hz : float
    samples : int
    period : ndarray, shape (channels, samples of a period)
    noise : ndarray, shape (channels,)
        Standard deviation of a sample.
    seed : int
    rounds : int
        Between time and frequency until the steady state was found; 0 for a linear rig.
    """

    channels: tuple[Channel, ...]
    rate_hz: float
    samples: int
    period: np.ndarray
    noise: np.ndarray
    seed: int
    rounds: int = 0

    def read(self, start: int, stop: int) -> np.ndarray:
        """See `Recording`."""
        length = self.period.shape[1]
        values = self.period[:, np.arange(start, stop) % length]
        if self.noise.any():
            for piece in range(start // _PIECE, -(-stop // _PIECE)):
                first = piece * _PIECE
                drawn = np.random.default_rng([self.seed, piece]).standard_normal(
                    (len(self.channels), _PIECE)
                )
                low, high = max(start, first), min(stop, first + _PIECE)
                values[:, low - start : high - start] += (
                    self.noise[:, None] * drawn[:, low - first : high - first]
                )
        scales = np.array([each.full_scale for each in self.channels])[:, None]
        return np.clip(values, -scales, scales, out=values)


def measured(
    rig: Rig, excitation: PeriodicSignal, rate_hz: float, duration_s: float, seed: int = 0
) -> Measurement:
    """What the sensors of a rig show when the shaker has driven it for long.

    Parameters
    ----------
    rig : Rig
    excitation : PeriodicSignal
        Force of the shaker, N.
    rate_hz, duration_s : float
        Of the record.
    seed : int
        Of the noise.

    Raises
    ------
    Refusal
        If the excitation cannot be sampled at this rate, or no steady state is found.
    """
    require_number("duration of a record", duration_s, "s", above=0)
    if isinstance(rig.specimen, NonlinearAxial):
        lines, amplitudes, rounds = _nonlinear(rig, excitation)
    else:
        response = rig.response(excitation.frequencies)
        lines, rounds = excitation.lines, 0
        amplitudes = response.channels[:, :, 0].T * excitation.amplitudes
    period = line_samples(lines, amplitudes, excitation.period_s, rate_hz)
    channels = rig.channels
    noise = np.array([rig.sensors.noise(each) for each in channels]) * np.sqrt(rate_hz / 2)
    return Measurement(channels, rate_hz, round(duration_s * rate_hz), period, noise, seed, rounds)


def _nonlinear(rig: Rig, excitation: PeriodicSignal) -> tuple[np.ndarray, np.ndarray, int]:
    """Lines, amplitudes of the channels on them, and rounds to the steady state."""
    lines = np.arange(1, _HARMONICS * excitation.lines[-1] + 1)
    period = excitation.period_s
    response: LinearResponse = rig.response(lines / period)
    drive = np.zeros(lines.size, dtype=complex)
    drive[excitation.lines - 1] = excitation.amplitudes
    tangent = _tangent(rig)
    rate = 8 * lines[-1] / period  # fine enough that what is cut off does not fold back
    count = round(rate * period)
    extra, motion = np.zeros(lines.size, dtype=complex), response.axial[:, 0] * drive
    for rounds in range(1, _ROUNDS + 1):
        samples = line_samples(lines, motion, period, rate)
        force = rig.specimen.excess(samples, tangent)
        extra = 2 / count * np.fft.rfft(force)[lines]
        fresh = response.axial[:, 0] * drive + response.axial[:, 1] * extra
        change = np.linalg.norm(fresh - motion) / np.linalg.norm(fresh)
        motion = fresh
        if change < _TOLERANCE:
            amplitudes = response.channels[:, :, 0].T * drive + response.channels[:, :, 1].T * extra
            return lines, amplitudes, rounds
    raise Refusal(
        f"no steady state of the nonlinear specimen was found in {_ROUNDS} rounds (the last "
        f"changed the motion by {change:.1e}); excite less."
    )


def _tangent(rig: Rig) -> float:
    """Axial stiffness of the linear part near rest, N/m."""
    lowest = np.array([1e-3])
    return float(-rig.specimen.dynamic_stiffness(lowest)[0, 8, 2].real)
