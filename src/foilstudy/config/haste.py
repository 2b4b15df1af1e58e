"""Ramps in which the foil lags behind the ring, and what that does to its stiffness."""

from __future__ import annotations

from collections.abc import Mapping

from foilstudy.solve.pace import SLOWNESS, ramp_steps

__all__ = ["RAMPED", "haste"]

RAMPED = ("relaxation", "installation", "ring_alone")
"""Paths of which the ring moves in the steps of a ramp."""
_ENOUGH = 0.95
"""Share of the steps of the standard ramp in which no foil is hurried."""


def haste(steps: Mapping[float, float], radius_mm: float, unit: str = "um") -> str | None:
    """Which foils a ramp hurries, and what to do, in sentences; None if it hurries none.

    Parameters
    ----------
    steps : mapping
        Of the ramp, by thickness in um; NaN where they are not known.
    radius_mm : float
        Of the cylinder.
    unit : str
        How micrometres are written.
    """
    slenderness = {thickness: 1e3 * radius_mm / thickness for thickness in steps}
    fast = {
        thickness: each / slenderness[thickness]
        for thickness, each in steps.items()
        if each < _ENOUGH * ramp_steps(slenderness[thickness])
    }
    if not fast:
        return None
    thicknesses = ", ".join(f"{thickness:g}" for thickness in sorted(fast))
    ends = dict.fromkeys(f"{end:.2g}" for end in (min(fast.values()), max(fast.values())))
    return (
        f"The ramp hurries foil of {thicknesses} {unit}: {' to '.join(ends)} steps for each unit "
        f"of R/t, where {SLOWNESS:g} are the standard. In 10, foil of 500 {unit} was 1.85 times "
        "(1.3 to 2.6) as stiff axially at 31 % overlength, with a scatter of 48 % in place of 8, "
        "and a tenth softer radially (docs/method.md). Where an axial stiffness counts, set "
        f"relaxation.ramp_slowness: {SLOWNESS:g}, and no ramp_steps."
    )
