"""No mass scaling: the physical mass, all steps as short as the stiffest wave demands."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.ranges import require_number
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.mass.physical import LumpedMass, PhysicalSheet


@dataclass(frozen=True)
class CourantMass:
    """Lumped physical mass and steps in proportion to the Courant step.

    M = m/(F dt)^2 with dt the largest stable step of the undeformed sheet. Elements as small as
    foil needs make the step short against the time in which the sheet bends, so that a ramp takes
    many steps. With a uniform mass scaling by f^2 and steps f times as long M stays what it is;
    what is called a multiple of the Courant step there is a ramp of that many times fewer steps.

    Attributes
    ----------
    step_factor : float
        The factor F: 1 is the limit of the undeformed sheet, which folds lower; beyond it the
        highest waves grow.
    """

    kind = "courant"
    step_factor: float = 0.8

    def __post_init__(self):
        require_number("step factor of the Courant mass", self.step_factor, above=0)

    def start(self, problem: Problem) -> LumpedMass:
        """See `MassScaling`; of the terms it knows the shell alone."""
        sheet = PhysicalSheet(problem)
        return LumpedMass(sheet.masses, self.step_factor * sheet.courant_step)
