"""The path of explicit finite elements: a ramp in which the ring moves alone, then settling.

The sheet learns of the ring's motion by waves. Where the ring is fast against them, as on many
small elements with lumped masses in few steps, the sheet folds beside it before the rest is loaded.
"""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.relaxation.loop import Ramp


@dataclass(frozen=True)
class RingAlonePath(RelaxationPath):
    """See `RelaxationPath`; no increment of the ring's motion is spread over the height."""

    kind = "ring_alone"

    def _ramp(self, shortening: float) -> Ramp:
        return Ramp(shortening, self.ramp_steps, spread=False)
