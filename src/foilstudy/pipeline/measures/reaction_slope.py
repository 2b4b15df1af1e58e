"""Slope of the force on the ring over its height while the foil is crumpled."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.measures import MeasuredStiffness
from foilstudy.solve.relaxation.loop import History

_LEAST = 3
"""Entries of a history that make a slope."""


@dataclass(frozen=True)
class ReactionSlope:
    """Least-squares slope of the force over the last share of the way, at the rate of the ramp.

    It holds the inertia of the pseudo-dynamics and every snap on the way.

    Attributes
    ----------
    share : float
        Of the shortening.
    """

    kind = "reaction_slope"
    share: float = 0.1

    def __post_init__(self) -> None:
        require_number("share of a reaction slope", self.share, "", above=0, most=1)

    def of(self, crumpled: Crumpled) -> MeasuredStiffness:
        """See `StiffnessMeasure`."""
        none = np.full(2, np.nan)
        history = crumpled.arrival.history if crumpled.arrival else None
        if history is None:
            return MeasuredStiffness(
                none, "there is no history of how this crumple was made; crumple it anew"
            )
        height, force = self._last(history)
        if len(height) < _LEAST:
            return MeasuredStiffness(
                none,
                f"the history has {len(height)} entries in the last {100 * self.share:g} % of the "
                f"way, {_LEAST} are needed; note it more often or take a larger share",
            )
        slope = np.polyfit(height - height.mean(), force, 1)[0]
        return MeasuredStiffness(
            np.array([-slope, np.nan]), "a ring that moves along the axis shows no radial stiffness"
        )

    def _last(self, history: History) -> tuple[np.ndarray, np.ndarray]:
        """Heights and forces of the last share, until the ring stands still."""
        height = history.height
        top, bottom = height[0], height.min()
        moving = np.concatenate([[True], np.diff(height) < 0])
        taken = moving & (height <= bottom + self.share * (top - bottom))
        return height[taken], history.reaction_force[taken]
