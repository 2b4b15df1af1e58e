"""Crumples of specimens, and of foils that shorten in a part of their height."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.linalg import SolveError
from foilstudy.measure.localisation import localisation
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.specimen import Clamps, Seam, Specimen, Unevenness
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths.ring_alone import RingAlonePath
from foilstudy.study.published import GAP_HEIGHT, foil
from foilstudy.study.specimen.plan import HEIGHT_MM, SIZE_MM, THICKNESS_UM, Scene, Shared
from foilstudy.study.specimen.release import joined

_MESH = Mesh(SIZE_MM * 1e-3)
_METHOD = Method.following(foil(THICKNESS_UM, HEIGHT_MM), slowness=10.0)
"""On 5 mm seeds scatter as much in slower ramps (docs/method.md, section 5)."""
_HEIGHT_SHARE = {"half": 1 / 2, "third": 1 / 3}


def specimen_of(scene: str, seed: int) -> Specimen:
    """The specimen of a scene."""
    return {
        "plain": Specimen(),
        "seam": Specimen(seam=Seam(5e-3, 2.0)),
        "heavy_seam": Specimen(seam=Seam(10e-3, 3.0)),
        "uneven": Specimen(unevenness=Unevenness(0.1, 0.03, seed)),
        "oval": Specimen(clamps=Clamps(ellipticity=2e-3)),
        "tilt": Specimen(clamps=Clamps(tilt=np.radians(1.0))),
        "slip": Specimen(clamps=Clamps(slip=1e-3, grip=1000.0)),
        "loose": Specimen(clamps=Clamps(slip=2e-3, grip=200.0)),
        "weight": Specimen(gravity=9.81),
    }[scene]


def scene(case: Scene) -> dict:
    """Crumple a specimen."""
    sheet = foil(THICKNESS_UM, HEIGHT_MM)
    sheet = replace(sheet, specimen=specimen_of(case.scene, case.seed))
    return _measured(crumple(sheet, _MESH, Imperfection(seed=case.seed), _METHOD))


def shared(case: Shared) -> dict:
    """Crumple a foil, all of it or a band between clamped ends, and let the band go.

    The rest of the foil, straight, is then joined to the band, without a clamp in between.
    """
    method = _METHOD
    if case.share == "ring_alone":
        path = method.path
        method = replace(method, path=RingAlonePath(path.ramp_steps, settling=path.settling))
    whole = whole_foil(case)
    crumpled = crumple(shortened(whole, case), _MESH, Imperfection(seed=case.seed), method)
    result = _measured(crumpled)
    if case.share not in _HEIGHT_SHARE or crumpled.status not in USABLE:
        return result
    shape = joined(crumpled, whole)
    let_go = {f"released_{name}": value for name, value in _measured(shape.settled()).items()}
    return result | {"joined_stiffness": _stiffness(shape.stiffness)} | let_go


def whole_foil(case: Shared) -> Foil:
    """The foil of a case, all of it."""
    whole = foil(THICKNESS_UM, 1e3 * GAP_HEIGHT * (1 + case.overlength_percent / 100))
    return replace(whole, material=replace(whole.material, law=case.law))


def shortened(whole: Foil, case: Shared) -> Foil:
    """What of it shortens, by as much as the whole has to."""
    share = _HEIGHT_SHARE.get(case.share, 1.0)
    height = share * whole.reference_height
    return replace(
        whole,
        reference_height=height,
        gap_height=height - whole.shortening,
    )


def _measured(crumpled: Crumpled) -> dict:
    """Stiffness, energies and localisation of a crumple, as far as it has come."""
    arrival = crumpled.arrival
    result = {"status": arrival.status, "message": arrival.message, "steps": arrival.steps}
    if arrival.status not in USABLE:
        return result
    problem, points, force = crumpled.problem(), crumpled.points, np.empty_like(crumpled.points)
    energies = dict(zip(problem.energy_names, problem.force(points, force), strict=True))
    energies.pop("load", None)
    return {
        **result,
        "stiffness": _stiffness(crumpled.stiffness),
        "prestressed_stiffness": _stiffness(crumpled.prestressed_stiffness),
        "energy": float(sum(energies.values())),
        "membrane_energy": float(energies["membrane"]),
        "bending_energy": float(energies["bending"]),
        "dissipated_work": problem.numbers().get("dissipated_work", 0.0),
        "reaction": -float(force[2, -2:].sum()),
        **localisation(crumpled.patch, points),
    }


def _stiffness(measure) -> list[float]:
    """Axial and radial, N/m; NaN where it is not defined."""
    try:
        return [float(value) for value in measure()]
    except SolveError:
        return [np.nan, np.nan]
