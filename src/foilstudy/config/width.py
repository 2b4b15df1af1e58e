"""Meshes that follow the folds of a foil, but on which it comes to rest in other shapes."""

from __future__ import annotations

from collections.abc import Mapping

from foilstudy.model.mesh_size import SLENDERNESS_MAX

__all__ = ["SAME_SHAPES_MAX", "wide"]

SAME_SHAPES_MAX = 0.5
"""Size of the elements over sqrt(R t) up to which crumples are those of finer meshes: at 0.46 they
are, at 0.71 not (docs/real-foil.md)."""


def wide(widths: Mapping[float, float], unit: str = "um") -> str | None:
    """Which foils have such elements, and what to do, in sentences; None if none has.

    Parameters
    ----------
    widths : mapping
        Of the elements over sqrt(R t), by thickness in um; NaN where they are not known. What is
        wider than folds has a sentence of its own.
    unit : str
        How micrometres are written.
    """
    found = {t: w for t, w in widths.items() if SAME_SHAPES_MAX < w <= SLENDERNESS_MAX * (1 + 1e-6)}
    if not found:
        return None
    thicknesses = ", ".join(f"{thickness:g}" for thickness in sorted(found))
    ends = dict.fromkeys(f"{end:.2g}" for end in (min(found.values()), max(found.values())))
    return (
        f"The elements of foil of {thicknesses} {unit} are {' to '.join(ends)} times sqrt(R t) "
        f"wide. They follow the folds, but beyond {SAME_SHAPES_MAX:g} foil comes to rest in other "
        f"shapes than on finer ones: at 0.71 foil of 500 {unit} was 1.75 times (1.2 to 2.5) as "
        "stiff axially at 31 % overlength as at 0.46, and 0.93 times (0.84 to 1.02) radially "
        "(docs/real-foil.md). Where an axial stiffness counts, set mesh.energy_error_percent: 10, "
        "and no mesh.element_size_mm."
    )
