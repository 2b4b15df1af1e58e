"""Error and cost of reductions of one model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from foilstudy.base.costs import measured
from foilstudy.linalg import SolveError
from foilstudy.measure.dynamics import (
    Damping,
    ModalDamping,
    ReducedModel,
    Reduction,
    StructuralDamping,
    Structure,
    Wanted,
    directional_stiffness,
    dynamic_stiffness,
    frequency_grid,
    full_order,
    relative_error,
)
from foilstudy.measure.dynamics.mac import mac
from foilstudy.measure.dynamics.reductions.craig_bampton import CraigBampton
from foilstudy.measure.dynamics.reductions.guyan import Guyan
from foilstudy.measure.dynamics.reductions.hintz_herting import HintzHerting
from foilstudy.measure.dynamics.reductions.rational_krylov import RationalKrylov
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.structures import prestressed_structure, stress_free_structure
from foilstudy.pipeline.vibration import surface_modes
from foilstudy.study.convergence.crumpling import imperfect, settled
from foilstudy.study.dynamics.plan import (
    CUTOFFS_HZ,
    HIGHEST_HZ,
    MODAL_REFINEMENTS_MAX,
    MODES,
    RATIO,
    TOLERANCES,
    Model,
)
from foilstudy.study.kernel.plan import Record
from foilstudy.study.published import CrumpleCase

_FREQUENCIES = np.array([3.0, 10.0, 30.0, 100.0, 200.0, 300.0, 400.0, 500.0, 600.0, 700.0, 800.0])
_ON_FINE_MESHES = np.array([30.0, 100.0, 300.0, 600.0, 800.0])


def crumple_shape(case: CrumpleCase) -> dict:
    """Crumple a foil: its control points, and how they were reached.

    Raises
    ------
    RuntimeError
        If it does not come to a stable equilibrium.
    """
    crumple, numbers = settled(case)
    if numbers["status"] != "converged":
        raise RuntimeError(f"{case} did not settle: {numbers['message']}")
    return numbers | {"points": crumple.points}


def crumple_of(model: Model, shapes: Mapping[CrumpleCase, Record]) -> Crumpled:
    """The crumple of a model on the mesh of that model."""
    points = shapes[model.crumple].result["points"]
    crumple = replace(imperfect(model.crumple), points=points)
    for _ in range(model.refinements):
        crumple = crumple.refined()
    return crumple


def _structure(model: Model, crumple: Crumpled) -> Structure:
    return (prestressed_structure if model.prestressed else stress_free_structure)(crumple)


def chart(model: Model, shapes: Mapping[CrumpleCase, Record]) -> dict:
    """Every reduction of a model at every order of the plan."""
    crumple = crumple_of(model, shapes)
    with measured() as static:
        structure = _structure(model, crumple)
    # modal damping needs 34 real factorisations more, and a stress-free structure
    fine = model.refinements == 2
    by_modes = not (model.prestressed or fine)
    damping = ModalDamping(RATIO) if by_modes else StructuralDamping(2 * RATIO)
    frequencies = _ON_FINE_MESHES if fine else _FREQUENCIES
    truth = directional_stiffness(full_order(structure, frequencies, damping))
    rows, modes = [], {}
    for method, order, reduction in _reductions(model, damping):
        row, reduced = _judged(structure, reduction, truth, frequencies, damping)
        rows.append({"method": method, "order": order} | row)
        if reduced is not None and method not in modes and order in (1000.0, 1e-3):
            modes[method] = _modes(reduced, crumple, model)
    return {
        "damping": type(damping).__name__,
        "unknowns": structure.mass.interior.shape[0],
        "frequencies": frequencies,
        "seconds_static": static.cpu_seconds,
        "rows": rows,
        "modes": modes,
    }


def _reductions(model: Model, damping: Damping) -> Iterator[tuple[str, float, Reduction]]:
    wanted = Wanted(highest_hz=HIGHEST_HZ, damping=damping)
    yield "guyan", 0.0, Guyan(wanted)
    for tolerance in TOLERANCES[model.refinements]:
        yield (
            "rational_krylov",
            tolerance,
            RationalKrylov(Wanted(tolerance, highest_hz=HIGHEST_HZ, damping=damping)),
        )
    if model.refinements > MODAL_REFINEMENTS_MAX[model.thickness_um]:
        return
    for cutoff in CUTOFFS_HZ[model.refinements]:
        yield "craig_bampton", cutoff, CraigBampton(cutoff, wanted)
        yield "hintz_herting", cutoff, HintzHerting(cutoff, wanted)


def _judged(
    structure: Structure,
    reduction: Reduction,
    truth: np.ndarray,
    frequencies: np.ndarray,
    damping: Damping,
) -> tuple[dict, ReducedModel | None]:
    try:
        with measured() as cost:
            model = reduction.reduce(structure)
    except SolveError as error:
        return {"failed": str(error)}, None
    everywhere = replace(model, valid_to_hz=np.nan)
    error = relative_error(dynamic_stiffness(everywhere, frequencies, damping), truth)
    return {
        "size": model.size,
        "seconds": cost.cpu_seconds,
        "peak_memory_mb": cost.peak_memory_mb,
        "estimate": model.error_estimate,
        "valid_to_hz": model.valid_to_hz,
        "errors": error.max(axis=1),  # transfer, driving, relative by frequency
    }, model


def _modes(reduced: ReducedModel, crumple, model: Model) -> dict:
    """First clamped modes on the knots of the mesh of 5 mm."""
    frequencies, shapes = reduced.clamped_modes(MODES)
    step = 2**model.refinements
    surface = surface_modes(crumple.patch, shapes)[:, :, ::step, ::step]
    scale = np.abs(surface).max(axis=(1, 2, 3), keepdims=True)
    # four digits are plenty for a correlation
    integers = np.round(1e4 * surface / scale).astype(int).reshape(len(surface), -1)
    return {"frequencies": frequencies, "shapes": integers}


def mode_correlation(first: dict, second: dict) -> np.ndarray:
    """MAC between the modes of two records of `chart`."""
    return mac(*(np.array(modes["shapes"], float).T for modes in (first, second)))


def check(model: Model, shapes: Mapping[CrumpleCase, Record]) -> dict:
    """The default reduction of a model against the full order, with its cost."""
    crumple = crumple_of(model, shapes)
    damping, wanted = ModalDamping(RATIO), Wanted()
    with measured() as cost:
        structure = _structure(model, crumple)
        reduced = RationalKrylov(wanted).reduce(structure)
        grid = frequency_grid(wanted.lowest_hz, wanted.highest_hz, 200)
        dynamic_stiffness(reduced, grid, damping)
    truth = directional_stiffness(full_order(structure, _FREQUENCIES, damping))
    error = relative_error(dynamic_stiffness(reduced, _FREQUENCIES, damping), truth)
    with measured() as direct:
        full_order(structure, _FREQUENCIES[-3:], StructuralDamping(2 * RATIO))
    return {
        "size": reduced.size,
        "modes_below": int((reduced.clamped_eigenfrequencies() < HIGHEST_HZ).sum()),
        "estimate": reduced.error_estimate,
        "error": float(error.max()),
        "seconds": cost.cpu_seconds,
        "seconds_per_direct_frequency": direct.cpu_seconds / 3,
    }
