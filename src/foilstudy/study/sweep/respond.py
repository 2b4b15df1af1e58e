"""Static and dynamic stiffness of one crumpled realisation."""

from __future__ import annotations

import resource
import sys
import time
import traceback
from dataclasses import replace
from pathlib import Path

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.base.record import MACHINE_FAULTS, Quantity, read_record, write_record
from foilstudy.config import ResponseTask
from foilstudy.config.scene import foil_of
from foilstudy.measure.stiffness import (
    InterfaceSystem,
    Rings,
    StaticCondensation,
    condense,
    fixed_stiffness,
    free_stiffness,
    mesh_limit,
    prestressed_stiffness,
)
from foilstudy.model.shell.elements.sampled import STAGGERED
from foilstudy.pipeline.crumpled import Crumple
from foilstudy.pipeline.structures import stress_free_structure
from foilstudy.pipeline.vibration import dynamic_quantities


def respond(task: ResponseTask, crumple_path: Path, path: Path) -> None:
    """Measure the crumple in `crumple_path` and write `path`, whatever happens.

    A crumple without a shape passes its status on; a failed measurement becomes a record whose
    ``status`` and ``message`` say so.
    """
    values, attributes = read_record(crumple_path)
    status, message = attributes["status"], attributes["message"]
    quantities: dict[str, Quantity] = {}
    if status in USABLE:
        try:
            quantities = _measure(task, values, attributes)
            message = "; ".join(filter(None, (message, _beyond_validity(task, quantities))))
        except MACHINE_FAULTS:
            raise
        except Exception as error:  # a study must survive any one realisation
            traceback.print_exc()
            status, message = "failed", f"{type(error).__name__}: {error}"
    quantities["peak_memory"] = Quantity(_peak_memory_mb(), "MB", "peak memory of the job")
    write_record(path, quantities, {"status": status, "message": message})
    print(_summary(quantities) if "static_stiffness" in quantities else f"{status}: {message}")


def _beyond_validity(task: ResponseTask, quantities: dict[str, Quantity]) -> str:
    """What to say of a reduced model that does not reach to the end of the band."""
    error, options = quantities["reduction_error"].values, task.dynamics
    if error <= options.tolerance:
        return ""
    valid_to = quantities["valid_to_frequency"].values
    remedy = "lower dynamics.shown_max_hz or raise dynamics.tolerance"
    if options.reduction != "rational_krylov":
        remedy = f"set dynamics.reduction: rational_krylov, or {remedy}"
    return (
        f"dynamic stiffness only to {valid_to:.0f} Hz, as the {options.reduction} model is wrong "
        f"by about {100 * error:.2g} % in the shown band: {remedy}"
    )


def _summary(quantities: dict[str, Quantity]) -> str:
    axial, radial = quantities["static_stiffness"].values
    seconds = sum(quantities[name].values for name in ("seconds_static", "seconds_dynamic"))
    return f"axial {axial:.4g} N/m, radial {radial:.4g} N/m ({seconds:.1f} s)"


def _measure(task: ResponseTask, values: dict, attributes: dict) -> dict[str, Quantity]:
    crumple = Crumple.recorded(foil_of(task), values, attributes)
    clock = time.perf_counter()
    structure = stress_free_structure(crumple)
    limit = _mesh_limit(task, crumple, fixed_stiffness(structure.static.stiffness))
    quantities = _static_quantities(structure.static, limit) | {
        "prestressed_stiffness": Quantity(
            prestressed_stiffness(crumple.sheet(crumple.reference), crumple.points),
            "N/m",
            "tangent stiffness at the stressed equilibrium",
            ("direction",),
        ),
    }
    seconds_static = time.perf_counter() - clock
    clock = time.perf_counter()
    quantities |= dynamic_quantities(task.dynamics, structure, crumple.patch)
    seconds_dynamic = time.perf_counter() - clock
    return quantities | {
        "seconds_static": Quantity(seconds_static, "s", "time of the static stiffness"),
        "seconds_dynamic": Quantity(seconds_dynamic, "s", "time of the dynamic stiffness"),
    }


def _stress_free_stiffness(crumple: Crumple) -> np.ndarray:
    """Axial and radial, N/m."""
    rings = Rings.of(crumple.patch, crumple.points)
    matrix = crumple.sheet(crumple.points).tangent()
    return fixed_stiffness(condense(InterfaceSystem.split(matrix, rings)).stiffness)


def _mesh_limit(
    task: ResponseTask, crumple: Crumple, coarsest: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness of the same shape at element size zero and its error, NaN without refinement."""
    levels, fine = [coarsest], crumple
    staggered = np.full(2, np.nan)
    for level in range(task.refinements):
        fine = fine.refined()
        levels.append(_stress_free_stiffness(fine))
        if level == 0:
            staggered = _stress_free_stiffness(replace(fine, element=STAGGERED))
    if len(levels) == 1:
        return np.full(2, np.nan), np.full(2, np.nan)
    return mesh_limit(levels, staggered)


def _static_quantities(static: StaticCondensation, limit: tuple) -> dict[str, Quantity]:
    directional = {
        "static_stiffness": (
            fixed_stiffness(static.stiffness),
            "stress-free static stiffness, other motions held",
        ),
        "static_stiffness_free": (
            free_stiffness(static.stiffness),
            "stress-free static stiffness, other motions free",
        ),
        "static_stiffness_converged": (
            limit[0],
            "stress-free static stiffness of the same shape, extrapolated to element size zero",
        ),
        "static_stiffness_mesh_error": (
            limit[1],
            "estimated mesh error of static_stiffness_converged",
        ),
    }
    quantities = {
        name: Quantity(values, "N/m", text, ("direction",))
        for name, (values, text) in directional.items()
    }
    quantities["interface_stiffness"] = Quantity(
        static.stiffness,
        "N/m, N, N m",
        "stress-free interface stiffness",
        ("interface_dof", "interface_dof_in"),
    )
    return quantities


def _peak_memory_mb() -> float:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 1024 if sys.platform != "darwin" else peak / 1024**2
