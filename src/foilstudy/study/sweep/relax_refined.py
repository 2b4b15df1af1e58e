"""Relax a crumpled realisation again on refined meshes."""

from __future__ import annotations

import time
import traceback
from dataclasses import replace
from pathlib import Path

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.base.record import MACHINE_FAULTS, Quantity, read_record, write_record
from foilstudy.config import RefineTask
from foilstudy.config.scene import foil_of
from foilstudy.measure.stiffness import (
    InterfaceSystem,
    Rings,
    condense,
    fixed_stiffness,
    prestressed_stiffness,
)
from foilstudy.pipeline.crumpled import Crumple
from foilstudy.pipeline.scheme import crumpling_scheme
from foilstudy.solve.equilibrium.settle import SettleOptions, settle

_DIRECTION = ("direction",)


def relax_refined(task: RefineTask, crumple_path: Path, path: Path) -> None:
    """Refine the crumple in `crumple_path`, let it settle level by level and write `path`.

    Whatever happens is a record: its ``status`` and ``message`` are those of this relaxation, and
    say nothing against the crumple it began with.
    """
    values, attributes = read_record(crumple_path)
    status, message = attributes["status"], attributes["message"]
    quantities: dict[str, Quantity] = {}
    if status in USABLE:
        try:
            crumple = Crumple.recorded(foil_of(task), values, attributes)
            quantities, status, message = _relaxed_levels(task, crumple)
        except MACHINE_FAULTS:
            raise
        except Exception as error:  # a study must survive any one realisation
            traceback.print_exc()
            status, message = "failed", f"{type(error).__name__}: {error}"
    write_record(path, quantities, {"status": status, "message": message})
    print(f"{status}: {message}")


def _relaxed_levels(task: RefineTask, crumple: Crumple) -> tuple[dict[str, Quantity], str, str]:
    clock = time.perf_counter()
    options = SettleOptions(
        task.relaxation.residual_tolerance,
        relaxation_steps_max=task.relaxation.relaxation_steps_max,
    )
    coarser = prestressed_stiffness(crumple.sheet(crumple.reference), crumple.points)
    for level in range(task.refinements):
        crumple = crumple.refined()
        sheet = crumple.sheet(crumple.reference)
        settled = settle(sheet, crumpling_scheme(sheet), crumple.points, options)
        crumple = replace(crumple, points=settled.points)
        if settled.status != "converged":
            return {}, settled.status, f"refinement {level + 1}: {settled.message}"
        prestressed = prestressed_stiffness(sheet, crumple.points)
        step, coarser = np.abs(prestressed - coarser), prestressed
    stress_free = crumple.sheet(crumple.points)
    rings = Rings.of(crumple.patch, crumple.points)
    system = InterfaceSystem.split(stress_free.tangent(), rings)
    numbers = {
        "refined_strain_energy": (sheet.energies(crumple.points).total, "J", "strain energy"),
        "refined_element_size": (
            max(crumple.patch.size_around, crumple.patch.size_along), "m", "element length"
        ),
        "refined_residual": (settled.residual, "1", "free force norm over ring force norm"),
        "refined_negative_eigenvalues": (
            float(settled.negative_eigenvalues), "1", "negative eigenvalues of the tangent"
        ),
        "refined_steps": (float(settled.relaxation_steps), "1", "pseudo-time steps"),
        "seconds_refined": (time.perf_counter() - clock, "s", "time of refining"),
    }  # fmt: skip
    stiffnesses = {
        "prestressed_stiffness_converged": (
            prestressed, "pre-stressed stiffness, relaxed again on the finest mesh"
        ),
        "prestressed_stiffness_mesh_error": (step, "its step from the next coarser mesh"),
        "refined_static_stiffness": (
            fixed_stiffness(condense(system).stiffness),
            "stress-free stiffness of the shape relaxed again on the finest mesh",
        ),
    }  # fmt: skip
    quantities = {
        name: Quantity(value, units, text) for name, (value, units, text) in numbers.items()
    }
    for name, (value, text) in stiffnesses.items():
        quantities[name] = Quantity(value, "N/m", text, _DIRECTION)
    return quantities, settled.status, settled.message
