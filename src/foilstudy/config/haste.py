"""Ramps in which the foil lags behind the ring, and what that does to its stiffness."""

from __future__ import annotations

from collections.abc import Mapping

from foilstudy.base.numerals import number_range
from foilstudy.solve.pace import SLOWNESS

__all__ = ["RAMPED", "haste"]

RAMPED = ("relaxation", "installation", "ring_alone")
"""Paths of which the ring moves in the steps of a ramp."""
_ROUNDING = 1e-3
"""Of a number of steps."""


def haste(steps: Mapping[float, float], radius_mm: float, unit: str = "um") -> str | None:
    """Which foils a ramp hurries, in a sentence; None if it hurries none.

    Parameters
    ----------
    steps : mapping
        Of the ramp, by thickness in um; NaN where they are not known.
    radius_mm : float
        Of the cylinder.
    unit : str
        How micrometres are written.
    """
    slowness = {t: n * t / (1e3 * radius_mm) for t, n in steps.items()}
    fast = {t: each for t, each in slowness.items() if each < SLOWNESS * (1 - _ROUNDING)}
    if not fast:
        return None
    thicknesses = ", ".join(f"{thickness:g}" for thickness in sorted(fast))
    return (
        f"The ramp hurries foil of {thicknesses} {unit}: "
        f"{number_range(min(fast.values()), max(fast.values()))} steps for each unit of R/t, where "
        f"{SLOWNESS:g} are the standard. In 10 of them, on a mesh that resolves it, foil of 500 "
        f"{unit} came out 1.3 to 2.6 times as stiff axially at 31 % overlength and scattered by "
        "half, and a tenth softer radially (docs/method.md)."
    )
