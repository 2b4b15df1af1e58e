"""The published procedure, each of its steps a setting."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.bench.estimation.channels import MOTION, REACTION, along
from foilstudy.bench.estimation.confidence import deviation
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.estimators import ESTIMATORS
from foilstudy.bench.estimation.smoothing import moving_average
from foilstudy.bench.estimation.spectra import Blocks, averaged
from foilstudy.bench.estimation.stitching import stitched
from foilstudy.bench.recording import Recording, Watched

__all__ = ["Published"]


@dataclass(frozen=True)
class Published:
    """Blocks, H1 with the motion as input, stitching, smoothing.

    Attributes
    ----------
    blocks : Blocks
    estimator : str
        A name of `ESTIMATORS`.
    bands_hz : tuple of tuple of float
        What is read of each recording, in their order.
    stitch_hz : float
    smooth_hz : float
        Width of the moving average over the magnitude; the phase is that before it. 0: none.
    """

    blocks: Blocks = Blocks()
    estimator: str = "h1"
    bands_hz: tuple[tuple[float, float], ...] = ((0.0, 150.0), (100.0, 500.0))
    stitch_hz: float = 120.0
    smooth_hz: float = 30.0

    def __post_init__(self) -> None:
        ESTIMATORS.choice(self.estimator)
        require_number("frequency of stitching", self.stitch_hz, "Hz", above=0)
        require_number("width of the moving average", self.smooth_hz, "Hz", least=0)

    def estimate(self, recordings: Sequence[Recording], motion: int, gap_m: float) -> Estimate:
        """Dynamic stiffness along a motion from one recording, or from one of each band.

        Parameters
        ----------
        recordings : sequence of Recording
            One, or two in the order of the bands.
        motion : int
            0 to 2, along x, y, z.
        gap_m : float
            Height of the upper ring's centre above the lower one's.

        Raises
        ------
        Refusal
            If a recording is too short, a channel is unsound, or an array too small.
        """
        parts = [
            self._of_one(recording, motion, gap_m).within(*band)
            for recording, band in zip(recordings, self.bands_hz)
        ]
        whole = parts[0] if len(parts) == 1 else stitched(*parts, self.stitch_hz)
        return self.smoothed(whole)

    def smoothed(self, estimate: Estimate) -> Estimate:
        """With the moving average over the magnitude."""
        if not self.smooth_hz:
            return estimate
        magnitude = moving_average(estimate.frequencies, np.abs(estimate.values), self.smooth_hz)
        phase = estimate.values / np.abs(estimate.values)
        return replace(estimate, values=magnitude * phase)

    def _of_one(self, recording: Recording, motion: int, gap_m: float) -> Estimate:
        watched = Watched(recording)
        highest = max(high for _, high in self.bands_hz)
        spectra = averaged(watched, self.blocks, min(highest, recording.rate_hz / 2))
        watched.require_sound()
        signals = spectra.combined(along(recording.channels, motion, gap_m))
        values = ESTIMATORS[self.estimator](*signals.of(MOTION, REACTION))
        coherence = signals.coherence(MOTION, REACTION)
        scatter = deviation(values, coherence, signals.averages)
        return Estimate(signals.frequencies, values, scatter, coherence)
