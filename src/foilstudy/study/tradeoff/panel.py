"""The first ladder: a panel that buckles without chance."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from foilstudy.model.patch import knot_points
from foilstudy.study.elements.buckled import SHORTENING, Panel, Way, buckled, refined_panels
from foilstudy.study.elements.plan import DEFAULT
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.tradeoff.pace import in_turns
from foilstudy.study.tradeoff.settings import Point

_KNOTS = (16, 10)
"""Elements around and along between the points that are compared; every mesh has these knots."""


@dataclass(frozen=True)
class Followed:
    """What is changed: the element, by its name among the variants, and the way."""

    element: str = DEFAULT
    way: Way = field(default_factory=Way)


def measure(point: Point) -> dict:
    """The panel with one setting changed, and its time beside that of the default.

    Elements are compared by the general kernel, in which operations cost alike for all of them.
    """
    general = point.change == "element"
    panel, times = in_turns(
        lambda: _follow(point.applied(Followed()), general), lambda: _follow(Followed(), general)
    )
    return times | {"energy": panel.energy, "surface": _surface(panel)}


def _follow(what: Followed, general: bool) -> Panel:
    variant = VARIANTS[what.element]
    return buckled(variant.general_kernel() if general else variant.element, what.way)


def truth(_: str) -> dict:
    """Energy (J) at element size zero, extrapolated at second order, and the finest surface (m)."""
    coarse, fine = refined_panels(VARIANTS[DEFAULT].element)[-2:]
    step = (fine.energy - coarse.energy) / 3
    return {"energy": fine.energy + step, "energy_error": abs(step), "surface": _surface(fine)}


def _surface(panel: Panel) -> np.ndarray:
    """Points of the surface that all meshes share, shape (3, 11, 17), m."""
    knots = knot_points(panel.points, periodic=False)
    steps = (knots.shape[2] - 1) // _KNOTS[0], (knots.shape[1] - 1) // _KNOTS[1]
    return knots[:, :: steps[1], :: steps[0]]


def errors(found: dict, true: dict) -> dict[str, float]:
    """Of the energy, relative; of the shape, mean distance over the shortening."""
    apart = np.asarray(found["surface"], float) - np.asarray(true["surface"], float)
    distance = np.sqrt((apart**2).sum(axis=0).mean())
    energy = np.nan if found["energy"] is None else found["energy"] / true["energy"] - 1
    shape = np.nan if np.isnan(energy) else float(distance / SHORTENING)
    return {"energy": energy, "shape": shape}
