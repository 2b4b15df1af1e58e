"""The relative residual by which every solver judges an equilibrium, and what rounding leaves."""

from __future__ import annotations

import numpy as np

from foilstudy.model.shell.shell import Shell


def relative_residual(norm: float, scale: float) -> float:
    """Norm of the free forces relative to a scale, such as the force on the rings.

    Zero where nothing acts at all, infinite where a force has no scale; what is not a number stays
    so, and meets no tolerance.
    """
    if scale == 0:
        return 0.0 if norm == 0 else np.inf
    return norm / scale


_ROUNDING = 5.0
"""Residual that counts as zero, relative to what rounding leaves of a known zero."""


def least_scale(shell: Shell, residual_tolerance: float) -> float:
    """Scale of residuals below which rounding alone would not meet a tolerance, N.

    Rounding is measured on the stress-free shape after a translation, which in exact arithmetic
    does nothing. On a thin sheet it is far from negligible: membrane stiffness times position
    times machine precision, beside forces of bending.
    """
    size = np.ptp(shell.reference.reshape(3, -1), axis=1).max()
    moved = shell.reference + size * np.array([0.3, 0.7, 0.1])[:, None, None]
    force = np.empty_like(moved)
    shell.force(moved, force)
    return _ROUNDING * float(np.linalg.norm(force)) / residual_tolerance
