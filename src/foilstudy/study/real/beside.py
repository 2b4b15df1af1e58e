"""Studies beside the models: the same foil on the meshes that resolve it, from their cubes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from foilstudy.base.cube import open_cube
from foilstudy.base.errors import Refusal
from foilstudy.base.outcome import USABLE
from foilstudy.measure.verdicts import is_fault
from foilstudy.study.real.settings import Beside, Trial, cube_of

_QUANTITIES = {
    "static_stiffness": "static_stiffness_converged",
    "stiffness_contacts_stuck": "stiffness_contacts_stuck",
    "true_stiffness": "true_stiffness",
    "prestressed_stiffness": "prestressed_stiffness",
}
"""What a record calls it, and what a cube does: the stress-free one in the limit of the mesh."""


def results(entry: Beside) -> dict[Trial, dict]:
    """Stiffness of every realisation that left a shape without a fault, as trials have it.

    Raises
    ------
    Refusal
        If a study has no cube.
    """
    return dict(pair for study in entry.studies for pair in _realisations(entry.name, study))


def _realisations(step: str, study: str) -> Iterator[tuple[Trial, dict]]:
    if not cube_of(study).is_file():
        raise Refusal(
            f"results/{study}/cube.nc is missing, and step {step!r} of config/real.yaml stands on "
            f"it; run that study, or remove the step."
        )
    cube = open_cube(cube_of(study))
    known = {ours: name for ours, name in _QUANTITIES.items() if name in cube}
    for place in np.ndindex(*cube["status"].shape):
        cell = cube.isel(dict(zip(cube["status"].dims, place, strict=True)))
        if str(cell["status"].values) not in USABLE or is_fault(float(cell["verdict"])):
            continue
        foil = round(float(cell["thickness"])), round(float(cell["reference_height"]))
        trial = Trial(step, study, *foil, int(cell["seed"]))
        yield trial, {ours: cell[name].values.tolist() for ours, name in known.items()}
