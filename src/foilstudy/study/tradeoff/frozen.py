"""The second ladder: stiffness of given shapes, which are refined exactly."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from foilstudy.config.accuracy import STANDARD
from foilstudy.linalg import SolveError
from foilstudy.measure.dynamics import (
    DynamicsOptions,
    directional_stiffness,
    dynamic_stiffness,
    full_order,
    relative_error,
)
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.shell.elements.sampled import STAGGERED
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.static import mesh_limit_within, stress_free_stiffness
from foilstudy.pipeline.structures import stress_free_structure
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.elements.plan import DEFAULT
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel.plan import Record
from foilstudy.study.published import CrumpleCase, foil
from foilstudy.study.tradeoff.pace import in_turns
from foilstudy.study.tradeoff.plan import shape_of
from foilstudy.study.tradeoff.settings import Point

_REFINEMENTS = 2
"""Of the mesh on which the truth is computed."""
_FREQUENCIES = np.array([3.0, 10.0, 30.0, 100.0, 200.0, 300.0, 400.0, 500.0, 600.0, 700.0, 800.0])
_DENSE = 10_000
"""Frequencies between which nothing happens any more."""


@dataclass(frozen=True)
class Static:
    """How the stress-free stiffness is measured.

    Attributes
    ----------
    element : str
        By its name among the variants.
    error_percent, refinements
        As in the section `stiffness` of a configuration: the demanded error, and how often the
        elements are halved at most to meet it.
    """

    element: str = DEFAULT
    error_percent: float = STANDARD.stiffness_error_percent
    refinements: int = 2


def shape(case: CrumpleCase) -> dict:
    """Crumple a foil, and measure its shape as exactly as can be.

    Returns
    -------
    dict
        ``points``, control points, m; ``static``, axial and radial stiffness at element size zero,
        N/m, the mean of two discretisations extrapolated from the finest meshes, and
        ``static_error``, half of what is between them; ``dynamic``, of the whole order on the mesh
        of the crumple, N/m, real and imaginary part by definition, direction and frequency.

    Raises
    ------
    SolveError
        If it does not come to rest, or a stiffness is singular.
    """
    crumpled = crumple(*_recipe(case))
    if crumpled.status != "converged":
        raise SolveError(f"the crumple whose shape is measured failed: {crumpled.message}")
    limits, fine = [], [crumpled]
    for _ in range(_REFINEMENTS):
        fine.append(fine[-1].refined())
    for element in (crumpled.element, STAGGERED):
        coarser, finest = (
            stress_free_stiffness(replace(each, element=element)) for each in fine[-2:]
        )
        limits.append(finest + (finest - coarser) / 3)
    whole = full_order(stress_free_structure(crumpled), _FREQUENCIES, DynamicsOptions().damping)
    stiffness = directional_stiffness(whole)
    return {
        "points": crumpled.points,
        "static": np.mean(limits, axis=0),
        "static_error": np.abs(limits[0] - limits[1]) / 2,
        "dynamic": np.array([stiffness.real, stiffness.imag]),
    }


def _crumpled(point: Point, shapes: Mapping[CrumpleCase, Record]) -> Crumpled:
    start = uncrumpled(*_recipe(shape_of(point)))
    return replace(start, points=_found(point, shapes)["points"])


def _recipe(case: CrumpleCase) -> tuple[Foil, Mesh, Imperfection, Method]:
    """With one ramp for all: any shape will do, and what is charted is measured on the same."""
    sheet = foil(case.thickness_um, case.height_mm)
    mesh = Mesh(case.size_mm * 1e-3, case.element)
    return sheet, mesh, Imperfection(seed=case.seed), Method(RelaxationPath(ramp_steps=2000))


def _found(point: Point, shapes: Mapping[CrumpleCase, Record]) -> dict:
    return shapes[shape_of(point)].result


def static(point: Point, shapes: Mapping[CrumpleCase, Record]) -> dict:
    """Relative errors of axial and radial stiffness, and the time of it beside the default's."""
    crumpled = _crumpled(point, shapes)

    def measured(what: Static) -> np.ndarray:
        variant = VARIANTS[what.element]
        element = variant.general_kernel() if point.change == "element" else variant.element
        try:
            given = replace(crumpled, element=element)
            return mesh_limit_within(given, what.error_percent / 100, what.refinements).stiffness
        except SolveError:
            return np.full(2, np.nan)

    found, times = in_turns(lambda: measured(point.applied(Static())), lambda: measured(Static()))
    axial, radial = found / _found(point, shapes)["static"] - 1
    return times | {"axial": float(axial), "radial": float(radial)}


def dynamic(point: Point, shapes: Mapping[CrumpleCase, Record]) -> dict:
    """Largest relative error of the dynamic stiffness, and the time of it beside the default's.

    Returns
    -------
    dict
        ``reduction``: error against the whole order in the band, time of the reduction.
        ``grid``: error of the magnitude between the frequencies, interpolated in logarithms, and
        time of the evaluation on them.
    """
    structure = stress_free_structure(_crumpled(point, shapes))
    truth = np.array(_found(point, shapes)["dynamic"], float)
    own, default = point.applied(DynamicsOptions()), DynamicsOptions()
    try:
        model, reducing = in_turns(
            lambda: own.reduced(structure), lambda: default.reduced(structure)
        )
    except SolveError as problem:
        return {"reduction": {"failed": str(problem)}, "grid": {"failed": str(problem)}}
    everywhere = replace(model, valid_to_hz=np.nan)
    found = dynamic_stiffness(everywhere, _FREQUENCIES, own.damping)
    error = relative_error(found, truth[0] + 1j * truth[1]).max()

    def evaluated(options: DynamicsOptions) -> np.ndarray:
        return np.log(np.abs(dynamic_stiffness(everywhere, options.grid, options.damping)))

    values, evaluating = in_turns(lambda: evaluated(own), lambda: evaluated(default))
    dense = replace(own, frequencies=_DENSE)
    exact, at = evaluated(dense), np.log(dense.grid)
    between = [
        np.interp(at, np.log(own.grid), line) - true
        for line, true in zip(
            values.reshape(-1, own.frequencies), exact.reshape(-1, _DENSE), strict=True
        )
    ]
    return {
        "reduction": reducing | {"error": float(error), "size": model.size},
        "grid": evaluating | {"error": float(np.abs(np.expm1(between)).max())},
    }
