"""How a ring stands: tilt, twist and shift."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Attitude:
    """How the top ring stands, apart from its height.

    Attributes
    ----------
    tilt : float
        About the x axis through its centre, rad.
    twist : float
        About its own axis, before it is tilted, rad.
    shift : float
        Of its centre along x, m.
    """

    tilt: float = 0.0
    twist: float = 0.0
    shift: float = 0.0

    @property
    def rotation(self) -> np.ndarray:
        """Matrix, shape (3, 3)."""
        (c, s), (p, q) = ((np.cos(a), np.sin(a)) for a in (self.tilt, self.twist))
        tilted = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        twisted = np.array([[p, -q, 0.0], [q, p, 0.0], [0.0, 0.0, 1.0]])
        return tilted @ twisted

    def placed(self, arms: np.ndarray) -> np.ndarray:
        """Where points of the straight ring come to, from its centre on the axis, m."""
        placed = np.einsum("ij,j...->i...", self.rotation, arms)
        placed[0] += self.shift
        return placed

    def straightened(self, places: np.ndarray) -> np.ndarray:
        """The inverse of `placed`."""
        places = places.copy()
        places[0] -= self.shift
        return np.einsum("ji,j...->i...", self.rotation, places)

    def towards(self, other: Attitude, progress: float) -> Attitude:
        """On the way to another one: each angle and the shift in proportion."""
        pairs = zip(self._values, other._values, strict=True)
        return Attitude(*(a + progress * (b - a) for a, b in pairs))

    def way(self, other: Attitude, radius: float) -> float:
        """The longest way that a point of the rim has to another one, roughly, m."""
        tilt, twist, shift = (abs(b - a) for a, b in zip(self._values, other._values, strict=True))
        return max(radius * tilt, radius * twist, shift)

    @property
    def _values(self) -> tuple[float, float, float]:
        return self.tilt, self.twist, self.shift
