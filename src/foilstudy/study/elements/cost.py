"""Time of one force evaluation per element."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.shell import Shell
from foilstudy.study.elements.scene import COARSE, DIAMETER, REFERENCE_HEIGHT
from foilstudy.study.elements.variants import BASELINE, VARIANTS
from foilstudy.study.verification.frequencies import FOIL

_THICKNESS = 500e-6
_ROUNDS = 15


@dataclass(frozen=True)
class Costs:
    """Time of one force evaluation.

    Attributes
    ----------
    relative : dict of str to float
        By the general kernel, over that of the baseline, by variant.
    nanoseconds : dict of str to float
        Per element by the vectorised kernel, where there is one.
    """

    relative: dict[str, float]
    nanoseconds: dict[str, float]


def costs() -> Costs:
    """Measure all variants in turns, so that other load on the machine meets all alike."""
    general = {name: _timed(variant.general) for name, variant in VARIANTS.items()}
    fast = {name: _timed(variant.fast) for name, variant in VARIANTS.items() if variant.fast}
    seconds: dict[str, list[float]] = {name: [] for name in general}
    ratios: dict[str, list[float]] = {name: [] for name in general}
    fast_seconds: dict[str, list[float]] = {name: [] for name in fast}
    for _ in range(_ROUNDS):
        for name, once in general.items():
            seconds[name].append(once())
        for name, once in fast.items():
            fast_seconds[name].append(min(once() for _ in range(20)))
        for name in general:
            ratios[name].append(seconds[name][-1] / seconds[BASELINE][-1])
    return Costs(
        {name: float(np.median(values)) for name, values in ratios.items()},
        {name: 1e9 * float(np.median(values)) for name, values in fast_seconds.items()},
    )


def _timed(element: Element):
    """A function that returns the seconds per element of one force evaluation."""
    patch = Patch.for_cylinder(DIAMETER, REFERENCE_HEIGHT, COARSE)
    points = cylinder_control_points(patch, DIAMETER)
    sheet = Shell.elastic(patch, points, FOIL, _THICKNESS, element)
    force = np.empty_like(points)
    elements = patch.elements_around * patch.elements_along

    def once() -> float:
        started = time.perf_counter()
        sheet.force(points, force)
        return (time.perf_counter() - started) / elements

    once()  # compiles
    return once
