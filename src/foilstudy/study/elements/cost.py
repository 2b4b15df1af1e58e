"""Time of one force evaluation per element."""

from __future__ import annotations

import time

import numpy as np

from foilstudy.model.patch import cylinder_control_points
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.method import Mesh
from foilstudy.study.elements.plan import COARSE_MM
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.published import foil

_THICKNESS_UM = 500
_ROUNDS = 15


def costs(baseline: str) -> dict[str, dict[str, float]]:
    """Measure all variants in turns, so that other load on the machine meets all alike.

    Returns
    -------
    dict
        By variant: ``relative``, time of one force evaluation by the general kernel over that of
        the baseline; ``nanoseconds``, per element by the vectorised kernel, where there is one.
    """
    general = {name: _timed(variant.general_kernel()) for name, variant in VARIANTS.items()}
    fast = {name: _timed(v.own_kernel()) for name, v in VARIANTS.items() if v.own_kernel}
    seconds: dict[str, list[float]] = {name: [] for name in general}
    ratios: dict[str, list[float]] = {name: [] for name in general}
    fast_seconds: dict[str, list[float]] = {name: [] for name in fast}
    for _ in range(_ROUNDS):
        for name, once in general.items():
            seconds[name].append(once())
        for name, once in fast.items():
            fast_seconds[name].append(min(once() for _ in range(20)))
        for name in general:
            ratios[name].append(seconds[name][-1] / seconds[baseline][-1])
    return {
        "relative": {name: float(np.median(values)) for name, values in ratios.items()},
        "nanoseconds": {name: 1e9 * float(np.median(v)) for name, v in fast_seconds.items()},
    }


def _timed(element: Element):
    """A function that returns the seconds per element of one force evaluation."""
    cylinder = foil(_THICKNESS_UM)
    patch = Mesh(COARSE_MM * 1e-3).patch(cylinder)
    points = cylinder_control_points(patch, cylinder.diameter)
    sheet = Shell.elastic(patch, points, cylinder.material, cylinder.thickness, element)
    force = np.empty_like(points)
    elements = patch.elements_around * patch.elements_along

    def once() -> float:
        started = time.perf_counter()
        sheet.force(points, force)
        return (time.perf_counter() - started) / elements

    once()  # compiles
    return once
