"""Crumple energy and the steps it takes, per element."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.model.foil import Imperfection
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, RelaxationResult, Scheme, StoppingRule, relax
from foilstudy.study.elements.plan import COARSE_MM, DEFAULT, FINE, Fine
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.published import foil

_THICKNESS_UM = 500
_SEEDS = (0, 1)
_RAMP_STEPS, _STEPS_MAX, _FINE_STEPS_MAX = 2000, 5000, 20_000
_RESIDUAL = 1e-3
_AMPLITUDE = 10e-6


def crumple(
    element: Element, size_mm: float, thickness_um: float, seed: int, steps_max: int = _STEPS_MAX
) -> tuple[Crumpled, RelaxationResult]:
    """Crumple the foil on a mesh and relax it to a residual of 1e-3.

    Parameters
    ----------
    size_mm, thickness_um : float
        Of the elements and of the foil.
    seed : int
        Of the imperfection, 10 um of noise; another mesh has another imperfection.
    steps_max : int
        After the ramp of 2000 steps.
    """
    imperfection = Imperfection(amplitude=_AMPLITUDE, seed=seed)
    start = uncrumpled(foil(thickness_um), Mesh(size_mm * 1e-3), imperfection)
    start = replace(start, element=element)
    problem = Problem(start.stressed)
    rule, ramp = StoppingRule(_RESIDUAL, steps_max), Ramp(start.foil.shortening, _RAMP_STEPS)
    result = relax(problem, Scheme().start(problem), ramp, rule)
    return replace(start, points=result.points), result


def crumples(
    name: str, size_mm: float = COARSE_MM, seeds: tuple[int, ...] = _SEEDS, **options: int
) -> dict[str, list]:
    """Crumple with one variant; the first seed only where that takes the general kernel.

    Returns
    -------
    dict
        By seed: ``energies`` (J), NaN where the crumple did not come to rest; ``steps`` until the
        residual of 1e-3, ramp included; ``statuses``.
    """
    if not VARIANTS[name].own_kernel:
        seeds = seeds[:1]
    found: dict[str, list] = {"energies": [], "steps": [], "statuses": []}
    for seed in seeds:
        shape, result = crumple(VARIANTS[name].element, size_mm, _THICKNESS_UM, seed, **options)
        settled = result.status == "converged"
        found["energies"].append(float(shape.energies().total) if settled else np.nan)
        found["steps"].append(result.steps)
        found["statuses"].append(result.status)
    return found


def fine_crumples(case: Fine) -> dict[str, list]:
    """By the default on a fine mesh: both seeds on the middle one, the first on the finest."""
    seeds = _SEEDS if case.size_mm > FINE[-1].size_mm else _SEEDS[:1]
    return crumples(DEFAULT, case.size_mm, seeds, steps_max=_FINE_STEPS_MAX)
