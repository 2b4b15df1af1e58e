"""Crumple energy and the steps it takes, per element."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.study.elements.plan import DEFAULT, FINE, Fine
from foilstudy.study.elements.scene import COARSE, crumple
from foilstudy.study.elements.variants import VARIANTS

THICKNESS = 500e-6
SEEDS = (0, 1)
_FINE_STEPS_MAX = 20_000


@dataclass(frozen=True)
class Crumples:
    """Outcome of several seeds; an energy is NaN where the crumple did not come to rest.

    Attributes
    ----------
    size : float
        Element size, m.
    energies : tuple of float
        J.
    steps : tuple of int
        Until the residual of 1e-3, ramp included.
    statuses : tuple of str
    """

    size: float
    energies: tuple[float, ...]
    steps: tuple[int, ...]
    statuses: tuple[str, ...]


def crumples(
    name: str, size: float = COARSE, seeds: tuple[int, ...] = SEEDS, **options: int
) -> Crumples:
    """Crumple with one variant; the first seed only where that takes the general kernel."""
    if not VARIANTS[name].fast:
        seeds = seeds[:1]
    energies, steps, statuses = [], [], []
    for seed in seeds:
        shape, result = crumple(VARIANTS[name].element, size, THICKNESS, seed, **options)
        settled = result.status == "converged"
        energies.append(float(shape.energies().total) if settled else np.nan)
        steps.append(result.steps)
        statuses.append(result.status)
    return Crumples(size, tuple(energies), tuple(steps), tuple(statuses))


def fine_crumples(case: Fine) -> Crumples:
    """By the default on a fine mesh: both seeds on the middle one, the first on the finest."""
    seeds = SEEDS if case.size_mm > FINE[-1].size_mm else SEEDS[:1]
    return crumples(DEFAULT, case.size_mm * 1e-3, seeds, steps_max=_FINE_STEPS_MAX)
