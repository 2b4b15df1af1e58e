"""A foil that has stood in its shape and let go of a part of its stress."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.measure.stiffness.stress_removal import Reset
from foilstudy.model.foil import Foil
from foilstudy.model.patch import refine
from foilstudy.model.shell.material.elastic import Elastic
from foilstudy.model.shell.renewed import Renewed
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.shape import Shape
from foilstudy.solve.problem import Problem, Term

STRESS_KEPT_MIN = 1e-9
"""So little of the stress counts as none, and leaves a problem its first term."""
_OWN = [0, 1, 5]
"""Coefficients 11-11, 22-22 and 12-12 of a section's stiffness."""


@dataclass(frozen=True, eq=False)
class Rest:
    """What waiting has done to a foil.

    Attributes
    ----------
    stress_kept : float
        Share of its stress that is left.
    points : ndarray, shape (3, rows, columns)
        Control points of the shape in which it waited, m.
    """

    stress_kept: float
    points: np.ndarray

    def __repr__(self) -> str:
        return f"<Rest: {self.stress_kept:.3g} of the stress kept>"

    def refined(self) -> Self:
        """With every element split in four."""
        return replace(self, points=refine(self.points))

    def weakened(self, foil: Foil) -> Foil:
        """The foil with moduli and yield stress scaled to what is left: so are its forces."""
        kept, made = self.stress_kept, foil.material
        material = replace(
            made,
            youngs_modulus=kept * made.youngs_modulus,
            yield_stress=kept * made.yield_stress,
            hardening=None if made.hardening is None else kept * made.hardening,
        )
        return replace(foil, material=material)

    def problem(self, shape: Shape, left: Shell, terms: tuple[Term, ...]) -> Problem:
        """The potential energy of a shape: what is left of it, and what has let go.

        Parameters
        ----------
        shape : Shape
            With all its strength.
        left : Shell
            Of the weakened foil.
        terms : tuple of Term
            Of that foil beside it, and what acts on it.
        """
        fresh = Reset().relieved(shape.stressed, self.points)
        # elements that crumpling has made shorter are stiffer where they begin anew
        stiffer = fresh.section.stiffness[:, _OWN] / shape.stressed.section.stiffness[:, _OWN]
        made = shape.foil.material
        bound = replace(made, youngs_modulus=max(1.0, stiffer.max()) * made.youngs_modulus)
        whole = Shell(replace(shape.stressed.section, law=Elastic(bound)), shape.element)
        renewed = Renewed(fresh, 1 - self.stress_kept)
        return Problem(left, *terms, renewed, whole=whole)


def refuse_rest(foil: Foil) -> None:
    """See that no weight pulls at a foil that is to wait in its shape.

    Raises
    ------
    Refusal
    """
    if foil.specimen.gravity:
        raise Refusal(
            "stress that relaxes would no longer carry the weight of the foil; leave out the "
            "waiting or the gravity."
        )
