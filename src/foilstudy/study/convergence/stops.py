"""What is measured of a crumple depends on the residual at which its relaxation is stopped."""

from __future__ import annotations

import numpy as np

from foilstudy.linalg import SolveError, factorise
from foilstudy.measure.stiffness import prestressed_stiffness
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumpled import Crumple
from foilstudy.pipeline.scheme import crumpling_scheme
from foilstudy.solve.equilibrium.settle import HeldSheet, stopped_at
from foilstudy.solve.relaxation import Ramp, StoppingRule, relax
from foilstudy.study.convergence.crumpling import RAMP_STEPS, STEPS_MAX, imperfect, stress_free
from foilstudy.study.convergence.plan import STOPS, Case


def run_stops(name: str) -> list[dict]:
    """Crumple the case of a name and measure it at every residual of the plan that it reaches."""
    crumple = imperfect(Case.named(name))
    foil, sheet = crumple.foil, crumple.sheet(crumple.reference)
    scheme = crumpling_scheme(sheet)
    ramp = Ramp(foil.reference_height - foil.gap_height, RAMP_STEPS)
    points = relax(sheet, scheme, ramp, StoppingRule(np.inf, np.inf, 0)).points
    return [
        {"name": name, "residual": residual} | _measured(crumple, sheet, shape)
        for residual, shape in stopped_at(sheet, scheme, points, STOPS, STEPS_MAX)
    ]


def _measured(crumple: Crumple, sheet: Shell, points: np.ndarray) -> dict:
    held = HeldSheet(sheet, points)
    tangent = held.hessian(held.unknowns(points))
    try:
        prestressed = prestressed_stiffness(sheet, points)
    except SolveError:
        prestressed = np.full(2, np.nan)
    shape = Crumple(crumple.foil, crumple.patch, points, crumple.reference, crumple.element)
    return {
        "strain_energy": sheet.energies(points).total,
        "negative_eigenvalues": factorise(tangent).negative_eigenvalues,
        "static_stiffness": stress_free(shape).tolist(),
        "prestressed_stiffness": prestressed.tolist(),
    }
