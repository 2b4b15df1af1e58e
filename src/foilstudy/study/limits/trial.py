"""One foil crumpled by one method, and what its verdicts rest on."""

from __future__ import annotations

from dataclasses import asdict, replace

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.linalg import SolveError
from foilstudy.measure.verdicts import Evidence, verdicts
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.crumpled import Crumpled, Recipe
from foilstudy.pipeline.evidence import evidence_of
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.study.changes import Value, changed
from foilstudy.study.limits.plan import LIMITS, Trial, setting_of
from foilstudy.study.published import foil

_OVER_THICKNESS = "_over_t"


def measure(trial: Trial) -> dict:
    """Crumple and judge.

    Returns
    -------
    dict
        ``status``, ``message``, ``verdicts`` (names), the numbers of the evidence, ``seconds`` of
        the processor, ``steps``, ``hessians``, ``residual``, ``reached`` (share of the shortening),
        and ``points``: the shape, empty where there is none.
    """
    sheet = foil(trial.thickness_um, trial.height_mm)
    recipe = recipe_of(trial, sheet)
    imperfection = replace(recipe.imperfection, seed=trial.seed)
    try:
        crumpled = crumple(sheet, recipe.mesh, imperfection, recipe.method)
    except (Refusal, SolveError, ArithmeticError, ValueError) as error:
        return _nothing("failed", f"{type(error).__name__}: {error}")
    return _judged(crumpled)


def baseline(sheet: Foil) -> Method:
    """That of a study, in the ramp of the map."""
    return Method.following(sheet, LIMITS.ramp_slowness)


def recipe_of(trial: Trial, sheet: Foil) -> Recipe:
    """The baseline, changed as the method says."""
    recipe = Recipe(Mesh(trial.size_mm * 1e-3), Imperfection(), baseline(sheet))
    for place, value in setting_of(trial).changes:
        recipe = changed(recipe, *_in_metres(place, value, sheet))
    return recipe


def _in_metres(place: str, value: Value, sheet: Foil) -> tuple[str, Value]:
    if place.endswith(_OVER_THICKNESS):
        return place.removesuffix(_OVER_THICKNESS), value * sheet.thickness
    return place, value


def _judged(crumpled: Crumpled) -> dict:
    arrival = crumpled.arrival
    if not np.isfinite(crumpled.points).all() or arrival.status in ("diverged", "failed"):
        nothing = _nothing(arrival.status, arrival.message, arrival.budget_spent)
        return nothing | _costs(crumpled)
    evidence = evidence_of(crumpled, arrival)
    return {
        **asdict(evidence),
        "message": arrival.message,
        "verdicts": [verdict.name for verdict in verdicts(evidence)],
        "points": crumpled.points.astype(np.float32),
        **_costs(crumpled),
    }


def _costs(crumpled: Crumpled) -> dict:
    arrival = crumpled.arrival
    return {
        "seconds": sum(cost.cpu_seconds for cost in arrival.costs.values()),
        "steps": arrival.steps,
        "hessians": arrival.hessians,
        "residual": arrival.residual,
        "reached": arrival.reached,
    }


def _nothing(status: str, message: str, budget_spent: bool = False) -> dict:
    evidence = Evidence(status, budget_spent=budget_spent)
    return {
        "status": status,
        "message": message,
        "verdicts": [verdict.name for verdict in verdicts(evidence)],
        "points": np.empty(0, np.float32),
    }
