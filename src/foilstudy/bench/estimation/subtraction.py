"""What reaches the force cells past the specimen, taken off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.estimate import Estimate

__all__ = ["without_bypass"]


def without_bypass(with_specimen: Estimate, without: Estimate) -> Estimate:
    """Complex difference of a run with the specimen and one without it.

    Exact where the path past the specimen moves with the base alike in both. Deviations add in
    the mean square; the coherence is that of the difference, with the noise of both runs.

    Raises
    ------
    Refusal
        If the two do not share their frequencies.
    """
    if not np.array_equal(with_specimen.frequencies, without.frequencies):
        raise Refusal(
            "the runs with and without specimen have other frequencies; process both alike."
        )
    values = with_specimen.values - without.values
    noise = _noise(with_specimen) + _noise(without)
    return replace(
        with_specimen,
        values=values,
        deviation=np.hypot(with_specimen.deviation, without.deviation),
        coherence=1 / (1 + noise / np.abs(values) ** 2),
    )


def _noise(estimate: Estimate) -> np.ndarray:
    """Power of the force that does not go with the motion, per power of the motion."""
    return (1 / estimate.coherence - 1) * np.abs(estimate.values) ** 2
