"""Crumples of the dynamics study, and the linear systems made of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from foilstudy.base.files import written_whole
from foilstudy.measure.dynamics import Structure
from foilstudy.pipeline.crumpled import Crumple
from foilstudy.pipeline.structures import prestressed_structure, stress_free_structure
from foilstudy.study.convergence.crumpling import imperfect, settled
from foilstudy.study.convergence.plan import Case
from foilstudy.study.dynamics.plan import CRUMPLED_MM, Model


def crumple_shape(name: str, path: str | Path) -> None:
    """Crumple the foil of a model on 5 mm and write its control points.

    Raises
    ------
    RuntimeError
        If it does not come to a stable equilibrium.
    """
    crumple, numbers = settled(_case(Model.named(name)))
    if numbers["status"] != "converged":
        raise RuntimeError(f"{name} did not settle: {numbers['message']}")
    with written_whole(path) as partial, partial.open("wb") as file:
        np.savez_compressed(file, points=crumple.points)


def read_crumple(model: Model, path: str | Path) -> Crumple:
    """The crumple of a model on the mesh of that model."""
    with np.load(path) as values:
        crumple = replace(imperfect(_case(model)), points=values["points"])
    for _ in range(model.refinements):
        crumple = crumple.refined()
    return crumple


def structure_of(model: Model, crumple: Crumple) -> Structure:
    """Stress-free or stressed, as the model says."""
    return (prestressed_structure if model.prestressed else stress_free_structure)(crumple)


def _case(model: Model) -> Case:
    return Case("corner", model.thickness_um, model.height_mm, CRUMPLED_MM, 0)
