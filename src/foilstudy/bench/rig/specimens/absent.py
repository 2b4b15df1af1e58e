"""A run without specimen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

__all__ = ["Absent"]


@dataclass(frozen=True)
class Absent:
    """Nothing between the frames."""

    kind = "absent"

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """See `Specimen`."""
        return np.zeros((len(frequencies), 12, 12), dtype=complex)
