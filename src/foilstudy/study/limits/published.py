"""What the published work and its review saw of methods that are on the map.

M. Bader, Structural Dynamics of Crumpled Thin Sheets, TU Delft, 2026; docs/limits.md says what was
found of each here.
"""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.study.limits.settings import Setting


@dataclass(frozen=True)
class Observation:
    """A published observation and where on the map it is.

    Attributes
    ----------
    words : str
        What was seen, in a few words.
    rows : tuple of str
        `Setting.words`, or the `Setting.method` of several.
    thicknesses_um : tuple of int
        Those that it speaks of; all if there are none.
    """

    words: str
    rows: tuple[str, ...]
    thicknesses_um: tuple[int, ...] = ()

    def marks(self, setting: Setting, thickness_um: int) -> bool:
        """Whether it is about this cell."""
        of_foil = not self.thicknesses_um or thickness_um in self.thicknesses_um
        return self.names(setting) and of_foil

    def names(self, setting: Setting) -> bool:
        """Whether it is about this row."""
        return setting.words in self.rows or setting.method in self.rows


OBSERVATIONS = (
    Observation("energy visibly other, stiffness little", ("nodal mass, 750",)),
    Observation(
        "tears thin foil, works on thick",
        ("kinetic", "kinetic, plain reset", "ring alone, no scaling, kinetic, ramp"),
        (100, 500),
    ),
    Observation("folds the cylinder", ("ring alone, nodal mass, ramp",)),
    Observation("fragile at the first bifurcation", ("Newton",)),
    Observation("follows further", ("arc length, sphere", "arc length, cylinder")),
    Observation(
        "size does not matter",
        tuple(f"Gaussian, of the thickness, {size}" for size in ("0.01", "0.1", "1")),
    ),
    Observation("may be taken out again", ("Gaussian, removed after buckling",)),
    Observation(
        "negative stiffness", tuple(f"element size (mm), {size}" for size in (4, 7)), (50,)
    ),
)
"""In the order of the rows; each is known by its number from 1."""
