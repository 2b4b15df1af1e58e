"""What is measured of a crumple depends on the residual at which its relaxation is stopped."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from foilstudy.linalg import factorise
from foilstudy.model.patch import RING_ROWS
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.solve.equilibrium.settle import stopped_at
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.study.convergence.crumpling import RAMP_STEPS, STEPS_MAX, imperfect, prestressed
from foilstudy.study.convergence.plan import STOPS
from foilstudy.study.published import CrumpleCase


def run_stops(case: CrumpleCase) -> list[dict]:
    """Crumple a case and measure it at every residual of the plan that it reaches."""
    start = imperfect(case)
    problem = Problem(start.stressed)
    motion = Scheme().start(problem)
    ramp = Ramp(start.foil.shortening, RAMP_STEPS)
    points = relax(problem, motion, ramp, StoppingRule(np.inf, 0)).points
    return [
        {"residual": residual} | _measured(replace(start, points=shape), problem)
        for residual, shape in stopped_at(problem, motion, points, STOPS, STEPS_MAX)
    ]


def _measured(crumpled: Crumpled, problem: Problem) -> dict:
    owned = RING_ROWS * 3 * crumpled.patch.columns
    tangent = problem.tangent(crumpled.points)[owned:-owned, owned:-owned].tocsr()
    return {
        "strain_energy": crumpled.energies().total,
        "negative_eigenvalues": factorise(tangent).negative_eigenvalues,
        "static_stiffness": crumpled.stiffness().tolist(),
        "prestressed_stiffness": prestressed(crumpled).tolist(),
    }
