"""Models whose trials are realisations of studies: foil on the meshes that resolve it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from foilstudy.base.cube import open_cube
from foilstudy.base.errors import Refusal
from foilstudy.base.outcome import NOT_NEEDED, USABLE
from foilstudy.measure.verdicts import FAULTS
from foilstudy.study.real.plan import NAME
from foilstudy.study.real.settings import Studied, Trial, cube_of, ladder

_QUANTITIES = (
    "static_stiffness",
    "stiffness_contacts_stuck",
    "true_stiffness",
    "prestressed_stiffness",
)
"""All on the mesh of the crumple, as those of the other models."""


def realisations(model: Studied) -> dict[Trial, dict]:
    """Stiffness of the foils that the other models have, as trials have it.

    Of a realisation without a shape, or with a fault among its verdicts, it is NaN.

    Raises
    ------
    Refusal
        If a study has no cube.
    """
    return dict(pair for study in model.studies for pair in _of_study(model.name, study))


def _of_study(name: str, study: str) -> Iterator[tuple[Trial, dict]]:
    if not cube_of(study).is_file():
        raise Refusal(
            f"results/{study}/cube.nc is missing, and {name!r} of config/{NAME}.yaml stands on it; "
            "run that study, or remove it there."
        )
    cube, models = open_cube(cube_of(study)), ladder(NAME)
    flags = cube["verdict"].attrs
    bits = dict(zip(flags["flag_meanings"].split(), flags["flag_masks"], strict=True))
    at_fault = (cube["verdict"] & sum(int(bits[fault]) for fault in FAULTS)) != 0
    cube = cube.where(cube["status"].isin(USABLE) & ~at_fault).assign(status=cube["status"])
    known = [quantity for quantity in _QUANTITIES if quantity in cube]
    for place in np.ndindex(*cube["status"].shape):
        cell = cube.isel(dict(zip(cube["status"].dims, place, strict=True)))
        foil = round(float(cell["thickness"])), round(float(cell["reference_height"]))
        wanted = foil[0] in models.thickness_um and foil[1] in models.reference_height_mm
        if wanted and str(cell["status"].values) != NOT_NEEDED:
            trial = Trial(name, study, *foil, int(cell["seed"]))
            yield trial, {each: cell[each].values.tolist() for each in known}
