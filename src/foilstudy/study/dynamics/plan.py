"""Which models the dynamics study reduces: plain data, cheap to import by the workflow."""

from __future__ import annotations

from dataclasses import dataclass

THICKNESSES_UM = (500, 50)
HEIGHT_MM = 170
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
    thickness_um, height_mm : int
    refinements : int
        Exact refinements of the mesh of 5 mm that was crumpled.
    prestressed : bool
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
    def name(self) -> str:
        """For example ``t50um_h170mm_r2_stressed``."""
        stressed = "_stressed" if self.prestressed else ""
        return f"t{self.thickness_um}um_h{self.height_mm}mm_r{self.refinements}{stressed}"

    @classmethod
    def named(cls, name: str) -> Model:
        """The model of a name."""
        thickness, height, refinements, *stressed = name.split("_")
        return cls(int(thickness[1:-2]), int(height[1:-2]), int(refinements[1:]), bool(stressed))


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
