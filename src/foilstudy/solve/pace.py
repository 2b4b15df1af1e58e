"""How many steps a foil is given: for the ramp, and to come to rest after it.

In the metric of the spectral mass the bending waves on which all waits have a frequency of the
thickness, so that both go with R/t.
"""

from __future__ import annotations

SLOWNESS = 40.0
"""Steps of the ramp for each unit of R/t; in fewer, foil lags behind the ring (docs/method.md)."""
REST_STEPS_MIN = 14_000
_REST_OF_RAMP, _REST_SLOWNESS = 7, 70.0
"""Steps that may follow each one of the ramp, and at most for each unit of R/t. Thin foil that
still snaps after 14 000 of them comes to rest sooner by more steps than by tangents
(docs/tradeoff.md); a slow ramp leaves no more to come to rest than a fast one."""


def ramp_steps(slenderness: float, slowness: float = SLOWNESS) -> int:
    """Steps of the ramp of a foil of one R/t."""
    return round(slowness * slenderness)


def rest_steps(ramp: int, slenderness: float) -> int:
    """Most steps after a ramp of so many, of a foil of one R/t."""
    return max(REST_STEPS_MIN, min(_REST_OF_RAMP * ramp, round(_REST_SLOWNESS * slenderness)))


RAMP_STEPS = ramp_steps(200.0)
"""Of 500 um in the published case."""
