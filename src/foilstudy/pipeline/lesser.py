"""Crumples of models that are too little, and of any element that is not a configuration's."""

from __future__ import annotations

from dataclasses import replace

from foilstudy.base.errors import Refusal
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.imperfections.cylinder import deviation
from foilstudy.model.shell.elements import LESSER_MODELS
from foilstudy.model.shell.elements.mass_spring import lattice_cylinder, lattice_patch
from foilstudy.pipeline.crumple import refuse_removal, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method


def lesser_cylinder(
    model: str,
    foil: Foil,
    mesh: Mesh | None = None,
    imperfection: Imperfection | None = None,
    method: Method | None = None,
) -> Crumpled:
    """The imperfect cylinder as one of `LESSER_MODELS` has it, as yet uncrumpled.

    The recipe keeps the element of the mesh, from which this model departs: a record of such a
    crumple cannot be read back.

    Raises
    ------
    Refusal
        As `uncrumpled`; if there is no such model.
    """
    foil.specimen.require_even(f"the model {model}")
    if foil.specimen.clamps.slip:
        raise Refusal(f"the model {model} knows no clamps that let it slip; leave out their slip.")
    start = replace(uncrumpled(foil, mesh, imperfection, method), element=LESSER_MODELS[model]())
    if model != "mass_spring":
        return start
    patch = lattice_patch(foil.diameter, foil.reference_height, start.recipe.mesh.element_size)
    points = lattice_cylinder(patch, foil.diameter)
    points += deviation(patch, foil, start.recipe.imperfection)
    return replace(start, patch=patch, points=points, reference=points)


def crumple_lesser(
    model: str,
    foil: Foil,
    mesh: Mesh | None = None,
    imperfection: Imperfection | None = None,
    method: Method | None = None,
) -> Crumpled:
    """Push a cylinder together that one of `LESSER_MODELS` stands for; see `crumple`."""
    refuse_removal(imperfection, "a model that is too little")
    start = lesser_cylinder(model, foil, mesh, imperfection, method)
    arrival = start.method.path.follow(start.problem(), foil.shortening)
    return replace(start, points=arrival.points, arrival=arrival)
