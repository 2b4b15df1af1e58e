"""Which crumples the convergence study makes: plain data, cheap to import by the workflow."""

from __future__ import annotations

from dataclasses import dataclass

SIZES_MM = (7.0, 5.0, 4.0, 2.5, 1.25)
THICKNESSES_UM = (500, 50)
HEIGHT_MM = 170
SEEDS, FINEST_SEEDS = (0, 1, 2), (0, 1)
DIAMETER_MM, GAP_HEIGHT_MM = 200, 130
ONE_POINT_SIZE_MIN_MM = 2.5
"""The published kind of element, for comparison, is left out on the finest mesh."""
TALL_HEIGHT_MM = 250
"""The case of which the published study could not compute the stiffness at 1.25 mm."""
FINEST_MM = min(SIZES_MM)


@dataclass(frozen=True)
class Case:
    """One crumple of the study.

    Attributes
    ----------
    element : str
        Key of `foilstudy.model.shell.elements.ELEMENTS`.
    thickness_um, height_mm : int
        Of the foil and of the uncrumpled cylinder.
    size_mm : float
        Element size asked for.
    seed : int
    """

    element: str
    thickness_um: int
    height_mm: int
    size_mm: float
    seed: int

    @property
    def name(self) -> str:
        """For example ``corner_t50um_h170mm_1.25mm_0``."""
        return (
            f"{self.element}_t{self.thickness_um}um_h{self.height_mm}mm_{self.size_mm:g}mm"
            f"_{self.seed}"
        )

    @classmethod
    def named(cls, name: str) -> Case:
        """The case of a name."""
        element, thickness, height, size, seed = name.rsplit("_", 4)
        return cls(
            element,
            int(thickness[1:-2]),
            int(height[1:-2]),
            float(size.removesuffix("mm")),
            int(seed),
        )


def crumples() -> tuple[Case, ...]:
    """Every crumple on a mesh of its own."""
    cases = [
        Case(element, thickness, HEIGHT_MM, size, seed)
        for element in ("corner", "one_point")
        for thickness in THICKNESSES_UM
        for size in SIZES_MM
        for seed in (SEEDS if size > FINEST_MM else FINEST_SEEDS)
        if element == "corner" or size >= ONE_POINT_SIZE_MIN_MM
    ]
    return (*cases, Case("corner", 50, TALL_HEIGHT_MM, FINEST_MM, 0))


MULTILEVEL = tuple(Case("corner", t, HEIGHT_MM, 5.0, 0) for t in THICKNESSES_UM)
"""Crumpled at 5 mm, then refined and relaxed again down to 1.25 mm."""

STOPPED = tuple(
    Case("corner", t, height, 5.0, seed)
    for t in THICKNESSES_UM
    for height in (150, 200)
    for seed in (0, 1)
)
"""Crumples stopped at falling residuals."""
STOPS = tuple(10.0**-k for k in range(1, 11))
