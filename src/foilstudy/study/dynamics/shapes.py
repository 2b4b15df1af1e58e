"""Crumples of the dynamics study, and the linear systems made of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from foilstudy.measure.dynamics import Structure
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.structures import prestressed_structure, stress_free_structure
from foilstudy.study.convergence.crumpling import imperfect, settled
from foilstudy.study.convergence.plan import Case
from foilstudy.study.dynamics.plan import CRUMPLED_MM, Model, Shape
from foilstudy.study.kernel import Record


def crumple_shape(shape: Shape) -> dict:
    """Crumple a foil on 5 mm: its control points.

    Raises
    ------
    RuntimeError
        If it does not come to a stable equilibrium.
    """
    crumple, numbers = settled(_case(shape))
    if numbers["status"] != "converged":
        raise RuntimeError(f"{shape} did not settle: {numbers['message']}")
    return numbers | {"points": crumple.points}


def crumple_of(model: Model, shapes: Mapping[Shape, Record]) -> Crumpled:
    """The crumple of a model on the mesh of that model."""
    points = shapes[model.shape].result["points"]
    crumple = replace(imperfect(_case(model.shape)), points=points)
    for _ in range(model.refinements):
        crumple = crumple.refined()
    return crumple


def structure_of(model: Model, crumple: Crumpled) -> Structure:
    """Stress-free or stressed, as the model says."""
    return (prestressed_structure if model.prestressed else stress_free_structure)(crumple)


def _case(shape: Shape) -> Case:
    return Case("corner", shape.thickness_um, shape.height_mm, CRUMPLED_MM, 0)
