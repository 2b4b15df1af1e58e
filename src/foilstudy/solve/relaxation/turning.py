"""Motions of the top ring beside that along the axis: tilt, twist and shift."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from foilstudy.model.patch import RING_ROWS
from foilstudy.model.supports.attitude import Attitude

_TOP = slice(-RING_ROWS, None)
_FREE = slice(RING_ROWS, -RING_ROWS)


@dataclass(frozen=True)
class Turning:
    """From one attitude of the top ring to another, while it moves along the axis or not.

    Attributes
    ----------
    start, end : Attitude
    """

    start: Attitude
    end: Attitude

    def begun(
        self, points: np.ndarray, share: np.ndarray, height: Callable[[np.ndarray], float]
    ) -> Turned:
        """At work on a sheet whose ring stands as at the start, at a height that points tell of."""
        return Turned(self, points, share, height)


class Turned:
    """A `Turning` at work: the ring rigidly, the sheet by each row's share of its motion."""

    def __init__(
        self,
        turning: Turning,
        points: np.ndarray,
        share: np.ndarray,
        height: Callable[[np.ndarray], float],
    ):
        self._turning, self._share, self._height = turning, share[_FREE, None], height
        self.renew(points, 0.0)

    def _centre(self, points: np.ndarray) -> np.ndarray:
        return np.array([0.0, 0.0, self._height(points)]).reshape(3, 1, 1)

    def renew(self, points: np.ndarray, progress: float) -> None:
        """Take the ring as it is at a progress of the way, where its clamp has let it slip."""
        ring = points[:, _TOP]
        attitude = self._turning.start.towards(self._turning.end, progress)
        self._arms = attitude.straightened(ring - self._centre(points))

    def move(self, points: np.ndarray, before: float, after: float) -> None:
        """From one progress of the way, of 0 to 1, to the next; the axial motion has been made."""
        start, end = self._turning.start, self._turning.end
        first, second = start.towards(end, before), start.towards(end, after)
        sheet, ring = points[:, _FREE], points[:, _TOP]
        # as if each row were a ring of its own that turns by its share
        arms = sheet.copy()
        arms[2] = 0.0
        sheet += self._share * (second.placed(arms) - first.placed(arms))
        ring[:] = second.placed(self._arms) + self._centre(points)
