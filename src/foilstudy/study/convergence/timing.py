"""Time of a pseudo-time step against element size."""

from __future__ import annotations

import time

import numpy as np

from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.study.convergence.crumpling import imperfect
from foilstudy.study.convergence.plan import SIZES_MM
from foilstudy.study.published import HEIGHT_MM, THICKNESSES_UM, CrumpleCase

_STEPS, _REPEATS = 100, 7


def run_timing(_: str) -> list[dict]:
    """Seconds per step of a ramp, the least of several, as a busy machine only adds."""
    return [
        {"thickness_um": thickness, "size_mm": size} | _timed(thickness, size)
        for thickness in THICKNESSES_UM
        for size in SIZES_MM
    ]


def _timed(thickness_um: int, size_mm: float) -> dict:
    start = imperfect(CrumpleCase("corner", thickness_um, HEIGHT_MM, size_mm, 0))
    problem, scheme, patch = Problem(start.stressed), Scheme(), start.patch
    # as far as the sheet buckles, lest numbers too small for normal floats slow the first steps
    ramp = Ramp(0.1 * start.foil.shortening, _STEPS)
    rule = StoppingRule(np.inf, 0, check_interval=_STEPS)
    seconds = []
    for _ in range(_REPEATS + 1):  # the first one compiles
        motion = scheme.start(problem)
        clock = time.process_time()
        relax(problem, motion, ramp, rule)
        seconds.append((time.process_time() - clock) / _STEPS)
    return {
        "elements": patch.elements_around * patch.elements_along,
        "seconds_per_step": min(seconds[1:]),
    }
