"""Nodal mass scaling: every control point as heavy as a demanded step asks of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.mass.physical import LumpedMass, PhysicalSheet


@dataclass(frozen=True)
class NodalMassScaling:
    """Lumped mass, raised at each control point until it is stable by itself.

    A control point gets at least s/4 of the sum of the absolute values in each of its rows of the
    stiffness (Gershgorin), times the square of the demanded step. All translations of the sheet
    become heavier, rigid and long ones as much as the shortest, which alone would need it.

    Once every point is raised, longer steps raise the mass with their square and M is the same: the
    factor then says how much mass that is (`LumpedMass.added`), the ramp how fast the heavy sheet
    is pushed.

    Attributes
    ----------
    step_factor : float
        Demanded step over the Courant step of the undeformed sheet.
    safety : float
        The factor s; 1 is enough for the undeformed sheet.
    """

    kind = "nodal"
    step_factor: float = 100.0
    safety: float = 1.5

    def __post_init__(self):
        require_number("step factor of nodal masses", self.step_factor, above=0)
        require_number("safety of nodal masses", self.safety, above=0)

    def start(self, problem: Problem) -> LumpedMass:
        """See `MassScaling`; of the terms it knows the shell alone."""
        sheet = PhysicalSheet(problem)
        step, physical = self.step_factor * sheet.courant_step, sheet.masses
        sums = np.asarray(abs(sheet.stiffness).sum(axis=1)).reshape(*physical.shape, 3).max(axis=2)
        masses = np.maximum(physical, 0.25 * self.safety * step**2 * sums)
        return LumpedMass(masses, step, float(masses.sum() / physical.sum()) - 1.0)
