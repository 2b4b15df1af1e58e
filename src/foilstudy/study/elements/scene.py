"""The foil that the element study crumples: that of the default configuration, h_ref = 170 mm."""

from __future__ import annotations

import numpy as np

from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.imperfection import imperfect_cylinder
from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.scheme import crumpling_scheme
from foilstudy.solve.relaxation import Ramp, RelaxationResult, StoppingRule, relax
from foilstudy.study.verification.frequencies import FOIL

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


def crumple(
    element: Element, size: float, thickness: float, seed: int, steps_max: int = _STEPS_MAX
) -> tuple[Shell, RelaxationResult]:
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
    foil = Foil(DIAMETER, REFERENCE_HEIGHT, GAP_HEIGHT, thickness, FOIL)
    patch = Patch.for_cylinder(DIAMETER, REFERENCE_HEIGHT, size)
    stream = (seed, 1000 * micrometres(thickness), round(REFERENCE_HEIGHT * 1e6))
    imperfection = Imperfection("gaussian", _AMPLITUDE, 0.0, stream)
    reference = imperfect_cylinder(
        patch, cylinder_control_points(patch, DIAMETER), foil, imperfection
    )
    sheet = Shell.elastic(patch, reference, FOIL, thickness, element)
    ramp = Ramp(REFERENCE_HEIGHT - GAP_HEIGHT, _RAMP_STEPS)
    rule = StoppingRule(_RESIDUAL, np.inf, steps_max)
    return sheet, relax(sheet, crumpling_scheme(sheet), ramp, rule)
