"""What the relaxation asks of a mass scaling."""

from __future__ import annotations

from typing import Protocol

import numpy as np


class MassScaling(Protocol):
    """A fictitious mass matrix of the free control points, for a pseudo-time step of 1."""

    def velocity(self, momentum: np.ndarray) -> np.ndarray:
        """Solve M v = momentum; arrays of shape (3, free rows, columns)."""
        ...
