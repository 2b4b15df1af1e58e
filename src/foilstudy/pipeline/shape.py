"""A foil in some shape on some mesh: what stiffness and dynamics are measured of."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from foilstudy.measure.stiffness.stress_removal import Relieved, Reset, StressRemoval
from foilstudy.model.foil import Foil
from foilstudy.model.patch import Patch, refine
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.model.shell.material import LAWS
from foilstudy.model.shell.section import Section
from foilstudy.model.shell.shell import Energies, Shell
from foilstudy.model.specimen.clamps import clamped_shape
from foilstudy.model.specimen.variation import variation_of
from foilstudy.model.specimen.weight import weight_of
from foilstudy.model.supports.grip import Grip
from foilstudy.model.supports.loads import Loading
from foilstudy.solve.problem import Problem, Term


@dataclass(frozen=True, eq=False, repr=False)
class Shape:
    """A shape of a foil between two rings, SI.

    Attributes
    ----------
    foil : Foil
    patch : Patch
    points, reference : ndarray, shape (3, rows, columns)
        Control points of the shape and of the stress-free shape before it was crumpled, m.
    element : Element
    """

    foil: Foil
    patch: Patch
    points: np.ndarray
    reference: np.ndarray
    element: Element

    def __repr__(self) -> str:
        size = 1e3 * max(self.patch.size_around, self.patch.size_along)
        return f"<{type(self).__name__}: {self.foil}, {size:.3g} mm {self.element.name} elements>"

    @cached_property
    def stressed(self) -> Shell:
        """The shell as it is: stress-free before it was crumpled."""
        material = self.foil.material
        law = LAWS[material.law](material)
        varied = variation_of(self.foil.specimen, self.patch, self.reference)
        section = Section(self.patch, self.reference, self.foil.thickness, law, varied)
        return Shell(section, self.element)

    def terms(self) -> tuple[Term, ...]:
        """What a problem has beside the elastic shell: of its law, its weight, its clamps."""
        section, specimen = self.stressed.section, self.foil.specimen
        terms = section.law.terms(self.stressed)
        if specimen.gravity:
            terms += (Loading(weight_of(section, specimen.gravity)),)
        if (clamps := specimen.clamps).slip:
            terms += (Grip(self.stressed, clamps.slip, clamps.grip),)
        return terms

    def problem(self) -> Problem:
        """The potential energy of the foil."""
        problem = Problem(self.stressed, *self.terms())
        problem.beginning = clamped_shape(self.foil.specimen.clamps, self.reference)
        return problem

    def before_waiting(self) -> Self:
        """The shape as its way has left it."""
        return self

    def relieved(self, removal: StressRemoval | None = None) -> Relieved:
        """The shell that is stress-free in this shape."""
        return (removal or Reset()).relieved(self.stressed, self.points)

    def energies(self) -> Energies:
        """Strain energies of the shape, J."""
        return self.stressed.energies(self.points)

    def refined(self) -> Self:
        """The same shape with every element split in four."""
        return replace(
            self,
            patch=self.patch.refined(),
            points=refine(self.points),
            reference=refine(self.reference),
        )
