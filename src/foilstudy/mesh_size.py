"""The element size that an error of the crumple's strain energy asks for.

A ridge of a crumpled sheet is as wide as sqrt(R t) to within a power of its length, so that the
error of the strain energy is expected to be a function of h / sqrt(R t) alone, whatever the foil.
The convergence study (`snakemake convergence`, docs/convergence.md) measures it.
"""

from __future__ import annotations

import math

ERROR_COEFFICIENT, ERROR_ORDER = 0.35, 1.5
"""Relative error of the strain energy by the default element: coefficient (h / sqrt(R t))^order."""

SIZE_MAX = 7e-3
"""The coarsest mesh of the study, m."""


def expected_energy_error(size: float, radius: float, thickness: float) -> float:
    """Relative error of the strain energy of a crumple, lengths in m."""
    return ERROR_COEFFICIENT * (size / math.sqrt(radius * thickness)) ** ERROR_ORDER


def element_size_for(error: float, radius: float, thickness: float) -> float:
    """Largest element size whose expected error is at most `error` (relative); lengths in m.

    Rounded down to three digits, and never above `SIZE_MAX`.
    """
    size = math.sqrt(radius * thickness) * (error / ERROR_COEFFICIENT) ** (1 / ERROR_ORDER)
    size = min(size, SIZE_MAX)
    step = 10.0 ** (math.floor(math.log10(size)) - 2)
    return math.floor(size / step * (1 + 1e-12)) * step
