"""The relative residual by which every solver judges an equilibrium."""

from __future__ import annotations

import numpy as np


def relative_residual(norm: float, scale: float) -> float:
    """Norm of the free forces relative to a scale, such as the force on the rings.

    Zero where nothing acts at all, infinite where a force has no scale; what is not a number stays
    so, and meets no tolerance.
    """
    if scale == 0:
        return 0.0 if norm == 0 else np.inf
    return norm / scale
