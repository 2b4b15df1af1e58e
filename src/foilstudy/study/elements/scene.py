"""The foil that the element study crumples: that of the default configuration, h_ref = 170 mm."""

from __future__ import annotations

from dataclasses import replace

from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.pipeline.shape import Shape
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, RelaxationResult, Scheme, StoppingRule, relax
from foilstudy.study.foils import FEP

DIAMETER, REFERENCE_HEIGHT, GAP_HEIGHT = 0.2, 0.17, 0.13
COARSE = 5e-3
"""Element size on which elements are compared, m."""

_RAMP_STEPS = 2000
_RESIDUAL = 1e-3
_STEPS_MAX = 5000
_AMPLITUDE = 10e-6


def micrometres(thickness: float) -> int:
    """Thickness in whole micrometres, for names."""
    return round(thickness * 1e6)


def foil_of(thickness: float) -> Foil:
    """The foil of a thickness, m."""
    return Foil(DIAMETER, REFERENCE_HEIGHT, GAP_HEIGHT, thickness, FEP)


def crumple(
    element: Element, size: float, thickness: float, seed: int, steps_max: int = _STEPS_MAX
) -> tuple[Shape, RelaxationResult]:
    """Crumple the foil on a mesh and relax it to a residual of 1e-3.

    Parameters
    ----------
    element : Element
    size : float
        Element size, m.
    thickness : float
        m.
    seed : int
        Of the imperfection, 10 um of noise; another mesh has another imperfection.
    steps_max : int
        After the ramp of 2000 steps.
    """
    foil = foil_of(thickness)
    start = uncrumpled(foil, Mesh(size), Imperfection(amplitude=_AMPLITUDE, seed=seed))
    start = replace(start, element=element)
    problem = Problem(start.stressed)
    rule = StoppingRule(_RESIDUAL, steps_max)
    result = relax(problem, Scheme().start(problem), Ramp(foil.shortening, _RAMP_STEPS), rule)
    return replace(start, points=result.points), result
