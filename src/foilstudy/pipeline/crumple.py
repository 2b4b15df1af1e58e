"""The central act: crumple a foil."""

from __future__ import annotations

from dataclasses import replace
from math import sqrt

from foilstudy.base.errors import Refusal
from foilstudy.base.outcome import USABLE
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.imperfections.cylinder import imperfect_cylinder
from foilstudy.model.patch import RING_ROWS
from foilstudy.pipeline.crumpled import Crumpled, Recipe
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.rest import refuse_rest
from foilstudy.solve.paths import Arrival
from foilstudy.solve.paths.installation import InstallationPath
from foilstudy.solve.paths.relaxation import RelaxationPath

_BUCKLED = 2.0
"""Shortening at which an imperfection is removed, over the classical one of buckling."""
_STEPS_MIN = 200
"""Of the ramp up to there."""


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
        By default `Method.following` the foil; `Method()` is that of 500 um in the published case.

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
    go = path.push if coarsenings else path.follow
    if not start.recipe.imperfection.removed:
        crumpled = _arrived(start, go(start.problem(), foil.shortening))
    else:
        start = without_imperfection(start)
        if start.status not in USABLE:
            return start
        left = start.points[2, -RING_ROWS:].mean() - foil.gap_height
        arrival = go(start.problem(), left, start.points)
        arrival = replace(arrival, steps=start.arrival.steps + arrival.steps)
        crumpled = _arrived(start, arrival)
    for finer in range(1, coarsenings + 1):
        if crumpled.status not in USABLE:
            break
        before, crumpled = crumpled.arrival, crumpled.refined()
        relax = path.settle if finer == coarsenings else path.relax
        crumpled = _arrived(crumpled, relax(crumpled.problem(), crumpled.points).after(before))
    return _at_rest(crumpled)


def _at_rest(crumpled: Crumpled) -> Crumpled:
    """After the time that it stands before it is measured."""
    return crumpled.waited(crumpled.method.waiting) if crumpled.status in USABLE else crumpled


def without_imperfection(start: Crumpled) -> Crumpled:
    """A cylinder pushed until it has buckled, and then free of stress where it is perfect.

    Raises
    ------
    Refusal
        If the path does not move, or the material has a memory, which belongs to its first shape.
    """
    foil, path = start.foil, start.method.path
    moves = isinstance(path, RelaxationPath) and not isinstance(path, InstallationPath)
    if not moves or start.problem().has_memory:
        raise Refusal(
            "imperfection.removal: after_buckling needs a foil that is elastic and relaxed, in "
            "clamps that hold; set method.path: relaxation and material.law: elastic, and no "
            "slip, or leave it out."
        )
    strain = foil.thickness / (foil.diameter / 2) / sqrt(3 * (1 - foil.material.poisson_ratio**2))
    first = min(_BUCKLED * strain * foil.reference_height, foil.shortening / 2)
    steps = max(_STEPS_MIN, round(path.ramp_steps * first / foil.shortening))
    ring = RelaxationPath(steps, path.scheme, path.settling, path.check_interval)
    buckled = _arrived(start, ring.push(start.problem(), first))
    perfect = imperfect_cylinder(
        start.patch, foil, replace(start.recipe.imperfection, amplitude=0.0)
    )
    return replace(buckled, reference=perfect)


def refuse_removal(imperfection: Imperfection | None, what: str) -> None:
    """See that no imperfection is to be removed where nobody would do it.

    Raises
    ------
    Refusal
    """
    if imperfection and imperfection.removed:
        raise Refusal(f"imperfection.removal: after_buckling is not for {what}; set it to never.")


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
        mesh or Mesh.resolving(foil),
        imperfection or Imperfection(),
        method or Method.following(foil),
    )
    clamps, path = foil.specimen.clamps, recipe.method.path
    if not (clamps.true or isinstance(path, RelaxationPath)):
        raise Refusal(
            f"the path {path.kind} begins in equilibrium, between true rings; use relaxation, or "
            "leave out ellipticity and tilt."
        )
    if clamps.slip and not isinstance(path, RelaxationPath):
        raise Refusal(
            f"the path {path.kind} holds the edges of the foil; use relaxation, or leave out the "
            "slip of the clamps."
        )
    if reason := clamps.beyond(foil.diameter / 2, foil.gap_height):
        raise Refusal(f"the clamping {reason}.")
    if recipe.method.waiting:
        refuse_rest(foil)
    if recipe.method.touches:
        _see_that_contact_is_kept(foil, recipe)
    patch = recipe.mesh.of_ramp().patch(foil)
    reference = imperfect_cylinder(patch, foil, recipe.imperfection)
    element = recipe.mesh.element_at_work()
    return Crumpled(foil, patch, reference, reference, element, recipe)


def _see_that_contact_is_kept(foil: Foil, recipe: Recipe) -> None:
    path = recipe.method.path
    if foil.specimen.clamps.slip and getattr(recipe.method.contact, "ring_planes", False):
        raise Refusal(
            "the planes of the rings go through three points of the foil's edge, which a clamp "
            "that lets it slip moves; leave out contact.ring_planes or the slip of the clamps."
        )
    refuse_removal(recipe.imperfection, "a foil whose parts touch")
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
