"""The third ladder: ensembles of crumples, whose means are what a study reports."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.crumpled import Crumpled, Recipe
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.study.published import foil
from foilstudy.study.tradeoff.settings import Point

QUANTITIES = ("energy", "axial", "radial")
_PACE_SEED = 0
"""Of the default beside every setting: it crumples before and after."""
_WARM_UP = Mesh(15e-3)


def measure(point: Point) -> dict:
    """Crumple by every seed with one setting changed.

    Returns
    -------
    dict
        By seed: ``energy`` (J), ``axial``, ``radial`` (stress-free stiffness on the mesh of the
        crumple, N/m), NaN where a crumple did not come to rest; ``steps``, ``hessians``;
        ``seconds``, of the processor, from the cylinder to the equilibrium. ``pace``: the same of
        one crumple by the default in this job, the least of two times.
    """
    sheet = foil(point.thickness_um, point.height_mm)
    crumple(sheet, _WARM_UP)  # what is loaded once is no cost of a setting
    default = recipe(point)
    own = point.applied(default)
    before = _seconds(_crumple(sheet, default, _PACE_SEED))
    found: dict[str, list] = {key: [] for key in (*QUANTITIES, "steps", "hessians", "seconds")}
    for seed in range(point.seeds):
        crumpled = _crumple(sheet, own, seed)
        for key, value in zip(QUANTITIES, _measured(crumpled), strict=True):
            found[key].append(value)
        found["steps"].append(crumpled.arrival.steps)
        found["hessians"].append(crumpled.arrival.hessians)
        found["seconds"].append(_seconds(crumpled))
    after = _seconds(_crumple(sheet, default, _PACE_SEED))
    return found | {"pace": min(before, after)}


def recipe(point: Point) -> Recipe:
    """What a study would take on this mesh: a ramp by R/t."""
    method = method_for(foil(point.thickness_um, point.height_mm))
    return Recipe(Mesh(point.size_mm * 1e-3), Imperfection(), method)


def method_for(sheet: Foil) -> Method:
    """That of the standard accuracy."""
    return Method.following(sheet)


def _crumple(sheet: Foil, recipe: Recipe, seed: int) -> Crumpled:
    imperfection = replace(recipe.imperfection, seed=seed)
    return crumple(sheet, recipe.mesh, imperfection, recipe.method)


def _seconds(crumpled: Crumpled) -> float:
    return sum(cost.cpu_seconds for cost in crumpled.arrival.costs.values())


def _measured(crumpled: Crumpled) -> tuple[float, float, float]:
    if crumpled.status != "converged":
        return np.nan, np.nan, np.nan
    try:
        axial, radial = crumpled.stiffness()
    except SolveError:
        axial, radial = np.nan, np.nan
    return float(crumpled.energies().total), float(axial), float(radial)
