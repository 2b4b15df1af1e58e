"""Which models the dynamics study reduces, and what is made of them."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study, results
from foilstudy.study.published import HEIGHT_MM, THICKNESSES_UM, CrumpleCase

CRUMPLED_MM = 5.0
HIGHEST_HZ = 800.0
RATIO = 0.05
"""Share of the critical damping, as published."""
MODES = 10
"""Clamped modes that are compared."""


@dataclass(frozen=True)
class Model:
    """One crumple on one mesh, free of stress or stressed.

    Attributes
    ----------
    refinements : int
        Exact refinements of the mesh of 5 mm that was crumpled.
    """

    thickness_um: int
    height_mm: int = HEIGHT_MM
    refinements: int = 0
    prestressed: bool = False

    @property
    def size_mm(self) -> float:
        """Element size."""
        return CRUMPLED_MM / 2**self.refinements

    @property
    def crumple(self) -> CrumpleCase:
        """What it is made of, on the mesh of 5 mm."""
        return CrumpleCase("corner", self.thickness_um, self.height_mm, CRUMPLED_MM, 0)


CHARTED = (
    *(Model(t, refinements=r) for t in THICKNESSES_UM for r in (0, 1, 2)),
    *(Model(t, prestressed=True) for t in THICKNESSES_UM),
)
"""All four methods, at several orders."""

CHECKED = tuple(Model(t, h) for t in (50, 130, 250, 500) for h in (135, 150, 170, 200, 250))
"""The default reduction in every configuration of the published study."""

CUTOFFS_HZ = {
    0: (800.0, 1000.0, 1200.0, 1600.0, 2000.0, 2400.0),
    1: (1000.0, 1600.0),
    2: (1000.0,),
}
TOLERANCES = {0: (1e-1, 1e-2, 1e-3, 1e-4, 1e-5), 1: (1e-1, 1e-3, 1e-5), 2: (1e-3,)}
"""By refinements: the finest mesh with the published cut-off and the default tolerance only."""
MODAL_REFINEMENTS_MAX = {50: 0, 500: 2}
"""By thickness: refinements up to which modes are searched. At 50 um there are so many on finer
meshes that their search took more than ten minutes at 2.5 mm, and 18 GB of memory at 1.25 mm."""

_HERE = "foilstudy.study.dynamics"
_NEEDS = {"shapes": lambda model: [model.crumple]}
# the modes count on the finest mesh
_MEMORY_MB = {0: 1500, 1: 3000, 2: 8000}

STUDY = Study(
    name="dynamics",
    title="reductions held against the full order",
    parts=(
        Part(
            "shapes",
            tuple(dict.fromkeys(model.crumple for model in (*CHARTED, *CHECKED))),
            Lazy(f"{_HERE}.measure:crumple_shape"),
            arrays=("points",),
        ),
        Part(
            "charts",
            CHARTED,
            Lazy(f"{_HERE}.measure:chart"),
            needs=_NEEDS,
            memory_mb=lambda model: _MEMORY_MB[model.refinements],
        ),
        Part("checks", CHECKED, Lazy(f"{_HERE}.measure:check"), needs=_NEEDS, memory_mb=1500),
    ),
    findings=results,
    tables={
        "reductions.csv": Lazy(f"{_HERE}.tables:reductions"),
        "checks.csv": Lazy(f"{_HERE}.tables:checks"),
        "dynamics.md": Lazy(f"{_HERE}.tables:page"),
    },
    figures={
        name: Lazy(f"{_HERE}.figures:{name}") for name in ("cutoff", "cost", "frequency", "mac")
    },
)
