"""The central act: crumple a foil."""

from __future__ import annotations

from dataclasses import replace

from foilstudy.base.errors import Refusal
from foilstudy.base.outcome import USABLE
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.imperfections.cylinder import imperfect_cylinder
from foilstudy.pipeline.crumpled import Crumpled, Recipe
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths import Arrival
from foilstudy.solve.paths.relaxation import RelaxationPath


def crumple(
    foil: Foil,
    mesh: Mesh | None = None,
    imperfection: Imperfection | None = None,
    method: Method | None = None,
) -> Crumpled:
    """Push a foil cylinder together until it fits its gap.

    Parameters
    ----------
    foil : Foil
    mesh : Mesh, optional
        By default `Mesh.resolving` the foil.
    imperfection : Imperfection, optional
        Its seed chooses the realisation.
    method : Method, optional

    Returns
    -------
    Crumpled
        Never raises for a foil that does not come to rest: its status says so.

    Raises
    ------
    Refusal
        If the foil fits its gap as it is, the mesh cannot follow the imperfection, a name is
        unknown, or contact cannot be kept.
    """
    start = uncrumpled(foil, mesh, imperfection, method)
    path, coarsenings = start.method.path, start.recipe.mesh.ramp_coarsenings
    if not coarsenings:
        return _arrived(start, path.follow(start.problem(), foil.shortening))
    crumpled = _arrived(start, path.push(start.problem(), foil.shortening))
    for finer in range(1, coarsenings + 1):
        if crumpled.status not in USABLE:
            break
        before, crumpled = crumpled.arrival, crumpled.refined()
        relax = path.settle if finer == coarsenings else path.relax
        crumpled = _arrived(crumpled, relax(crumpled.problem(), crumpled.points).after(before))
    return crumpled


def _arrived(crumpled: Crumpled, arrival: Arrival) -> Crumpled:
    return replace(crumpled, points=arrival.points, arrival=arrival)


def uncrumpled(
    foil: Foil,
    mesh: Mesh | None = None,
    imperfection: Imperfection | None = None,
    method: Method | None = None,
) -> Crumpled:
    """The imperfect cylinder from which `crumple` starts, on the mesh of the ramp."""
    if foil.shortening <= 0:
        raise Refusal(
            f"the reference height of a foil is {foil.reference_height:g} m, in a gap of "
            f"{foil.gap_height:g} m; give one above the gap height."
        )
    recipe = Recipe(
        mesh or Mesh.resolving(foil), imperfection or Imperfection(), method or Method()
    )
    if recipe.method.touches:
        _see_that_contact_is_kept(recipe)
    patch = recipe.mesh.of_ramp().patch(foil)
    reference = imperfect_cylinder(patch, foil, recipe.imperfection)
    element = recipe.mesh.element_at_work()
    return Crumpled(foil, patch, reference, reference, element, recipe)


def _see_that_contact_is_kept(recipe: Recipe) -> None:
    path = recipe.method.path
    if recipe.mesh.ramp_coarsenings:
        raise Refusal(
            "a crumple with contact cannot be pushed together on a coarser mesh, as it may cross "
            "itself on the finer one; set the coarsenings of the ramp to 0."
        )
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
