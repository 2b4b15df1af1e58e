"""Crumples whose parts touch instead of passing through each other."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Self

from foilstudy.base.errors import Refusal
from foilstudy.measure.stiffness.contacts import ContactBracket, contact_bracket
from foilstudy.model.contact import Contact, SelfContact
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import knot_points
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.pipeline.crumple import refuse_removal, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths import Path
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.mass.touching import TouchingMassScaling


@dataclass(frozen=True, eq=False, repr=False)
class Touching(Crumpled):
    """A crumple with contact.

    Attributes
    ----------
    contact : Contact
    """

    contact: Contact | None = None

    @property
    def term(self) -> SelfContact:
        """The barrier, fresh."""
        return SelfContact(self.stressed.section, self.contact)

    def problem(self) -> Problem:
        """Foil and contact, at the state in which it has arrived."""
        bare = super().problem()
        problem = Problem(bare.shell, *bare.terms[1:], self.term)
        problem.state = (*bare.state[: len(bare.terms)], None)
        return problem

    def settled(self, method: Method | None = None) -> Self:
        """See `Crumpled.settled`; contact is kept."""
        path = _keeping_contact((method or self.method).path)
        arrival = path.settle(self.problem(), self.points)
        return replace(self, points=arrival.points, arrival=arrival)

    def crossing_share(self) -> float:
        """Share of the area that crosses the rest: zero."""
        return self_crossing_share(knot_points(self.points))

    def bracket(self) -> ContactBracket:
        """Stress-free stiffness between what contacts may do, see `ContactBracket`.

        Raises
        ------
        SolveError
            If a stiffness is singular.
        """
        return contact_bracket(self.relieved(), self.term, self.points)


def crumple_touching(
    foil: Foil,
    mesh: Mesh | None = None,
    imperfection: Imperfection | None = None,
    method: Method | None = None,
    contact: Contact | None = None,
) -> Touching:
    """Push a foil cylinder together whose parts touch; see `crumple`.

    Where nothing comes near anything the crumple is the one of `crumple`, to the last bit.

    Parameters
    ----------
    foil, mesh, imperfection, method
        See `crumple`. The mesh may not be coarsened for the ramp, and the path is relaxation with
        viscous damping.
    contact : Contact, optional

    Raises
    ------
    Refusal
        As `crumple`; if the mesh is too fine for the reach, or the method cannot keep contact.
    """
    refuse_removal(imperfection, "a foil whose parts touch")
    start = uncrumpled(foil, mesh, imperfection, method)
    if start.recipe.mesh.ramp_coarsenings:
        raise Refusal(
            "a crumple with contact cannot be pushed together on a coarser mesh, as it may cross "
            "itself on the finer one; set the coarsenings of the ramp to 0."
        )
    path = _keeping_contact(start.method.path)
    touching = Touching(
        foil, start.patch, start.points, start.reference, start.element, start.recipe,
        contact=contact,
    )  # fmt: skip
    arrival = path.follow(touching.problem(), foil.shortening)
    return replace(touching, points=arrival.points, arrival=arrival)


def _keeping_contact(path: Path) -> RelaxationPath:
    """The path with a mass that minds contact."""
    if not isinstance(path, RelaxationPath):
        raise Refusal(
            f"contact is kept by relaxation, not by the path {path.kind}; use relaxation."
        )
    for damping in (path.scheme.ramp_damping, path.scheme.relaxation_damping):
        if damping.kind.startswith("kinetic"):
            raise Refusal(
                f"a damping of kind {damping.kind} steps back without regard to contact; use "
                "adaptive_viscous."
            )
    return replace(path, scheme=replace(path.scheme, mass=TouchingMassScaling(path.scheme.mass)))
