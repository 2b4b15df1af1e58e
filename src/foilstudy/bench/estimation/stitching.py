"""Two estimates of neighbouring bands joined at a frequency."""

from __future__ import annotations

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.estimate import Estimate

__all__ = ["stitched"]


def stitched(low: Estimate, high: Estimate, at_hz: float) -> Estimate:
    """The lower estimate below a frequency, the upper one from there on.

    Raises
    ------
    Refusal
        If the two do not reach the frequency from both sides.
    """
    if not (low.frequencies[0] < at_hz <= high.frequencies[-1]):
        raise Refusal(f"{at_hz:g} Hz lies in none of the two bands; stitch where they overlap.")
    if low.frequencies[-1] < at_hz * (1 - 1e-9) or high.frequencies[0] > at_hz * (1 + 1e-9):
        raise Refusal(
            f"bands to {low.frequencies[-1]:g} Hz and from {high.frequencies[0]:g} Hz cannot be "
            f"stitched at {at_hz:g} Hz; stitch where they overlap."
        )
    below, above = low.at(low.frequencies < at_hz), high.at(high.frequencies >= at_hz)
    return Estimate(
        *(
            np.concatenate([getattr(part, name) for part in (below, above)])
            for name in ("frequencies", "values", "deviation", "coherence")
        )
    )
