"""Foils of a cube that yield beyond what thin shells cover."""

from __future__ import annotations

import numpy as np
import xarray as xr

from foilstudy.base.numerals import plural
from foilstudy.present.statistics.cells import measured

__all__ = ["PLASTIC_STRAIN_MAX", "strain_findings"]

PLASTIC_STRAIN_MAX = 0.1
"""Bent to a radius of five thicknesses, strain at the surface departs by a tenth from the linear
course through the thickness (Winkler's curved beam)."""


def strain_findings(cube: xr.Dataset) -> list[str]:
    """Say in how many foils plastic strain is beyond what thin shells cover, if in any."""
    if "plastic_strain_max" not in cube:
        return []
    strains = measured(cube, "plastic_strain_max").values
    known = strains[np.isfinite(strains)]
    beyond = known[known > PLASTIC_STRAIN_MAX]
    if not beyond.size:
        return []
    ends = dict.fromkeys(f"{end:.2g}" for end in (beyond.min(), beyond.max()))
    return [
        f"In {beyond.size} of {plural(known.size, 'foil')} the plastic strain comes to "
        f"{' to '.join(ends)} at its worst point, beyond the {PLASTIC_STRAIN_MAX:g} that thin "
        "shells cover (a crease of five thicknesses in radius): there the sharpest creases are "
        "those of the model."
    ]
