"""Error and cost of reductions of one model."""

from __future__ import annotations

import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.measure.dynamics import (
    CraigBampton,
    Damping,
    Guyan,
    HintzHerting,
    ModalDamping,
    RationalKrylov,
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
from foilstudy.pipeline.vibration import surface_modes
from foilstudy.study.convergence.crumpling import peak_memory_mb
from foilstudy.study.dynamics.plan import (
    CUTOFFS_HZ,
    HIGHEST_HZ,
    MODAL_REFINEMENTS_MAX,
    MODES,
    RATIO,
    TOLERANCES,
    Model,
)
from foilstudy.study.dynamics.shapes import read_crumple, structure_of

_FREQUENCIES = np.array([3.0, 10.0, 30.0, 100.0, 200.0, 300.0, 400.0, 500.0, 600.0, 700.0, 800.0])
_ON_FINE_MESHES = np.array([30.0, 100.0, 300.0, 600.0, 800.0])


def chart(name: str, shape_path: str | Path) -> dict:
    """Every reduction of a model at every order of the plan, fit for JSON."""
    model = Model.named(name)
    crumple = read_crumple(model, shape_path)
    clock = time.process_time()
    structure = structure_of(model, crumple)
    seconds_static = time.process_time() - clock
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
        "name": name,
        "damping": type(damping).__name__,
        "unknowns": structure.mass.interior.shape[0],
        "frequencies": frequencies.tolist(),
        "seconds_static": seconds_static,
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
    clock = time.process_time()
    try:
        model = reduction.reduce(structure)
    except SolveError as error:
        return {"failed": str(error)}, None
    seconds = time.process_time() - clock
    everywhere = replace(model, valid_to_hz=np.nan)
    error = relative_error(dynamic_stiffness(everywhere, frequencies, damping), truth)
    return {
        "size": model.size,
        "seconds": seconds,
        "peak_memory_mb": peak_memory_mb(),
        "estimate": model.error_estimate,
        "valid_to_hz": model.valid_to_hz,
        "errors": error.max(axis=1).tolist(),  # transfer, driving, relative by frequency
    }, model


def _modes(reduced: ReducedModel, crumple, model: Model) -> dict:
    """First clamped modes on the knots of the mesh of 5 mm."""
    frequencies, shapes = reduced.clamped_modes(MODES)
    step = 2**model.refinements
    surface = surface_modes(crumple.patch, shapes)[:, :, ::step, ::step]
    scale = np.abs(surface).max(axis=(1, 2, 3), keepdims=True)
    # four digits are plenty for a correlation
    integers = np.round(1e4 * surface / scale).astype(int).reshape(len(surface), -1)
    return {"frequencies": frequencies.tolist(), "shapes": integers.tolist()}


def mode_correlation(first: dict, second: dict) -> np.ndarray:
    """MAC between the modes of two records of `chart`."""
    return mac(*(np.array(modes["shapes"], float).T for modes in (first, second)))


def check(name: str, shape_path: str | Path) -> dict:
    """The default reduction of a model against the full order, with its cost, fit for JSON."""
    crumple = read_crumple(Model.named(name), shape_path)
    damping, wanted = ModalDamping(RATIO), Wanted()
    clock = time.process_time()
    structure = structure_of(Model.named(name), crumple)
    model = RationalKrylov(wanted).reduce(structure)
    grid = frequency_grid(wanted.lowest_hz, wanted.highest_hz, 200)
    dynamic_stiffness(model, grid, damping)
    seconds = time.process_time() - clock
    truth = directional_stiffness(full_order(structure, _FREQUENCIES, damping))
    error = relative_error(dynamic_stiffness(model, _FREQUENCIES, damping), truth)
    clock = time.process_time()
    full_order(structure, _FREQUENCIES[-3:], StructuralDamping(2 * RATIO))
    direct = (time.process_time() - clock) / 3
    return {
        "name": name,
        "size": model.size,
        "modes_below": int((model.clamped_eigenfrequencies() < HIGHEST_HZ).sum()),
        "estimate": model.error_estimate,
        "error": float(error.max()),
        "seconds": seconds,
        "seconds_per_direct_frequency": direct,
    }
