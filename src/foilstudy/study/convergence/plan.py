"""Which crumples the convergence study makes, and what is made of them."""

from __future__ import annotations

from foilstudy.study.kernel.plan import Lazy, Part, Study, results
from foilstudy.study.published import HEIGHT_MM, THICKNESSES_UM, CrumpleCase

SIZES_MM = (7.0, 5.0, 4.0, 2.5, 1.25)
SEEDS, FINEST_SEEDS = (0, 1, 2), (0, 1)
ONE_POINT_SIZE_MIN_MM = 2.5
"""The published kind of element, for comparison, is left out on the finest mesh."""
TALL_HEIGHT_MM = 250
"""The case of which the published study could not compute the stiffness at 1.25 mm."""
FINEST_MM = min(SIZES_MM)


def crumples() -> tuple[CrumpleCase, ...]:
    """Every crumple on a mesh of its own."""
    cases = [
        CrumpleCase(element, thickness, HEIGHT_MM, size, seed)
        for element in ("corner", "one_point")
        for thickness in THICKNESSES_UM
        for size in SIZES_MM
        for seed in (SEEDS if size > FINEST_MM else FINEST_SEEDS)
        if element == "corner" or size >= ONE_POINT_SIZE_MIN_MM
    ]
    return (*cases, CrumpleCase("corner", 50, TALL_HEIGHT_MM, FINEST_MM, 0))


MULTILEVEL = tuple(CrumpleCase("corner", t, HEIGHT_MM, 5.0, 0) for t in THICKNESSES_UM)
"""Crumpled at 5 mm, then refined and relaxed again down to 1.25 mm."""

STOPPED = tuple(
    CrumpleCase("corner", t, height, 5.0, seed)
    for t in THICKNESSES_UM
    for height in (150, 200)
    for seed in (0, 1)
)
"""Crumples stopped at falling residuals."""
STOPS = tuple(10.0**-k for k in range(1, 11))

_HERE = "foilstudy.study.convergence"

STUDY = Study(
    name="convergence",
    title="convergence of the crumple with the mesh and with the residual",
    parts=(
        Part(
            "crumples",
            crumples(),
            Lazy(f"{_HERE}.crumpling:run"),
            # the tangent of the finest mesh is what counts
            memory_mb=lambda case: 6000 if case.size_mm < 2 else 3000,
        ),
        Part(
            "levels", MULTILEVEL, Lazy(f"{_HERE}.crumpling:run_levels"), memory_mb=6000, priority=1
        ),
        Part("stops", STOPPED, Lazy(f"{_HERE}.stops:run_stops")),
        # Last, when the machine is emptier: the least of several times, but shared caches count.
        Part("timing", ("steps",), Lazy(f"{_HERE}.timing:run_timing"), priority=-1),
    ),
    findings=results,
    tables={
        "convergence.csv": Lazy(f"{_HERE}.tables:crumples"),
        "stops.csv": Lazy(f"{_HERE}.tables:stops"),
        "convergence.md": Lazy(f"{_HERE}.tables:page"),
    },
    figures={
        name: Lazy(f"{_HERE}.figures:{name}")
        for name in ("energy", "stiffness", "stabilisation", "run_time", "stops")
    },
)
