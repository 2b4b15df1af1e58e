"""How many steps a foil is given: for the ramp, and to come to rest after it.

In the metric of the spectral mass the bending waves on which all waits have a frequency of the
thickness, so that both go with R/t.
"""

from __future__ import annotations

SLOWNESS = 40.0
"""Steps of the ramp for each unit of R/t; in fewer, foil lags behind the ring (docs/method.md)."""
REST_STEPS_MIN = 14_000
_REST = 7
"""Steps that may follow each one of the ramp. Thin foil that still snaps after 14 000 of them comes
to rest sooner by more steps than by tangents (docs/tradeoff.md)."""


def ramp_steps(slenderness: float, slowness: float = SLOWNESS) -> int:
    """Steps of the ramp of a foil of one R/t."""
    return round(slowness * slenderness)


def rest_steps(ramp: int) -> int:
    """Most steps after a ramp of so many."""
    return max(REST_STEPS_MIN, _REST * ramp)


RAMP_STEPS = ramp_steps(200.0)
REST_STEPS = rest_steps(RAMP_STEPS)
"""Of 500 um in the published case."""
