"""Crumple one realisation and record the shape."""

from __future__ import annotations

import time
import traceback
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from foilstudy.base.record import MACHINE_FAULTS, Quantity, write_record
from foilstudy.config import CrumpleTask
from foilstudy.config.scene import foil_of, imperfection_of, patch_of
from foilstudy.model.imperfection import imperfect_cylinder
from foilstudy.model.patch import RING_ROWS, Patch, cylinder_control_points, knot_points
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.model.shell.shell import Energies, Shell
from foilstudy.model.shell.yielding import beyond_yield_share
from foilstudy.pipeline.scheme import crumpling_scheme
from foilstudy.solve.equilibrium.settle import SettleOptions, SettleResult, settle
from foilstudy.solve.relaxation import Ramp, RelaxationResult, StoppingRule, relax


def crumple(task: CrumpleTask, path: Path) -> None:
    """Crumple the foil of a task and write `path`, whatever happens.

    A realisation that diverges, or whose computation fails, becomes a record whose ``status``
    and ``message`` say so.
    """
    attributes = {
        "thickness_um": task.thickness_um,
        "reference_height_mm": task.reference_height_mm,
        "overlength_percent": task.overlength_percent,
        "seed": task.seed,
        "element": task.mesh.element,
    }
    started = time.perf_counter()
    try:
        sheet, outcome = _crumpled(task)
        result = outcome.last
        quantities = _quantities(sheet, outcome)
        attributes |= {"status": result.status, "message": result.message}
    except MACHINE_FAULTS:
        raise
    except Exception as error:  # a study must survive any one realisation
        traceback.print_exc()
        quantities = {}
        attributes |= {"status": "failed", "message": f"{type(error).__name__}: {error}"}
    seconds = time.perf_counter() - started
    quantities["seconds_crumple"] = Quantity(seconds, "s", "time of crumpling")
    write_record(path, quantities, attributes)
    print(f"{attributes['status']}: {attributes['message']} ({seconds:.1f} s)")


@dataclass(frozen=True)
class _Outcome:
    """How far a realisation came: through the ramp and the first relaxation, then to equilibrium.

    `settled` is None where the first relaxation diverged.
    """

    relaxed: RelaxationResult
    settled: SettleResult | None

    @property
    def last(self) -> RelaxationResult | SettleResult:
        return self.settled or self.relaxed


def _crumpled(task: CrumpleTask) -> tuple[Shell, _Outcome]:
    foil, patch, options = foil_of(task), patch_of(task), task.relaxation
    perfect = cylinder_control_points(patch, foil.diameter)
    reference = imperfect_cylinder(patch, perfect, foil, imperfection_of(task))
    element = ELEMENTS[task.mesh.element]()
    sheet = Shell.elastic(patch, reference, foil.material, foil.thickness, element)
    scheme = crumpling_scheme(sheet)
    settling = SettleOptions(
        options.residual_tolerance, relaxation_steps_max=options.relaxation_steps_max
    )
    # the motion goes on from the ramp into the relaxation: stopping in between would lead elsewhere
    rule = StoppingRule(
        settling.switch_residual, np.inf, options.relaxation_steps_max, options.check_interval
    )
    ramp = Ramp(foil.reference_height - foil.gap_height, options.ramp_steps)
    relaxed = relax(sheet, scheme, ramp, rule)
    if relaxed.status == "diverged":
        return sheet, _Outcome(relaxed, None)
    left = options.relaxation_steps_max - (relaxed.steps - ramp.steps)
    settling = replace(settling, relaxation_steps_max=left)
    return sheet, _Outcome(relaxed, settle(sheet, scheme, relaxed.points, settling))


def _quantities(sheet: Shell, outcome: _Outcome) -> dict[str, Quantity]:
    history = {
        "step": ("1", "pseudo-time step"),
        "height": ("m", "height between the rings"),
        "reaction_force": ("N", "axial force of the foil on the top ring"),
        "membrane_energy": ("J", "membrane energy"),
        "bending_energy": ("J", "bending energy"),
        "stabilisation_energy": ("J", "stabilisation energy"),
        "kinetic_energy": ("J", "kinetic energy of the fictitious mass"),
        "residual": ("1", "norm of the force on the free foil over that on the rings"),
    }
    tables = {name: getattr(outcome.relaxed.history, name) for name in history}
    scalars: dict[str, Quantity] = {}
    if outcome.last.status != "diverged":
        scalars = _shape(sheet, outcome.last.points) | _scalars(sheet, outcome)
    if scalars and outcome.settled:
        end = _end_of_history(scalars, tables["height"][-1])
        tables = {name: np.append(values, end[name]) for name, values in tables.items()}
    return scalars | {
        f"history_{name}": Quantity(tables[name], units, text, ("history",))
        for name, (units, text) in history.items()
    }


def _end_of_history(scalars: dict[str, Quantity], height: float) -> dict[str, float]:
    """The equilibrium as last entry of the history; quasi-Newton steps count like the others."""
    names = ("reaction_force", "membrane_energy", "bending_energy", "stabilisation_energy")
    steps = scalars["steps"].values + scalars["newton_steps"].values
    return {
        "step": int(steps),
        "height": height,
        "kinetic_energy": 0.0,
        "residual": scalars["equilibrium_residual"].values,
        **{name: scalars[name].values for name in names},
    }


def _shape(sheet: Shell, points: np.ndarray) -> dict[str, Quantity]:
    control, node = ("component", "row", "column"), ("component", "node_row", "node_column")
    surface, reference = knot_points(points), knot_points(sheet.reference)
    return {
        "control_points": Quantity(points, "m", "control points, crumpled", control),
        "reference_control_points": Quantity(
            sheet.reference, "m", "control points, stress-free", control
        ),
        "surface": Quantity(surface, "m", "surface points at the knots, crumpled", node),
        "reference_surface": Quantity(
            reference, "m", "surface points at the knots, stress-free", node
        ),
        "radial_displacement": Quantity(
            _radial_displacement(surface, reference), "m", "radial displacement", node[1:]
        ),
    }


def _radial_displacement(surface: np.ndarray, reference: np.ndarray) -> np.ndarray:
    return np.hypot(surface[0], surface[1]) - np.hypot(reference[0], reference[1])


def _scalars(sheet: Shell, outcome: _Outcome) -> dict[str, Quantity]:
    result, settled = outcome.last, outcome.settled
    points = result.points
    force = np.empty_like(points)
    energies = Energies(*sheet.force(points, force))
    surface = knot_points(points)
    radial = _radial_displacement(surface, knot_points(sheet.reference))
    return {
        "membrane_energy": Quantity(energies.membrane, "J", "membrane energy"),
        "bending_energy": Quantity(energies.bending, "J", "bending energy"),
        "stabilisation_energy": Quantity(energies.stabilisation, "J", "stabilisation energy"),
        "reaction_force": Quantity(
            -float(force[2, -RING_ROWS:].sum()), "N", "axial force of the foil on the top ring"
        ),
        "equilibrium_residual": Quantity(
            result.residual, "1", "norm of the force on the free foil over that on the rings"
        ),
        "negative_eigenvalues": Quantity(
            _count(settled.negative_eigenvalues if settled else None),
            "1",
            "negative eigenvalues of the tangent, rings held",
        ),
        "steps": Quantity(
            float(outcome.relaxed.steps + (settled.relaxation_steps if settled else 0)),
            "1",
            "pseudo-time steps, ramp included",
        ),
        "newton_steps": Quantity(
            float(settled.newton_steps if settled else 0), "1", "quasi-Newton steps after them"
        ),
        "element_size": Quantity(_element_size(sheet.patch), "m", "element length"),
        "radial_displacement_min": Quantity(radial.min(), "m", "smallest radial displacement"),
        "radial_displacement_max": Quantity(radial.max(), "m", "largest radial displacement"),
        "radial_displacement_rms": Quantity(
            np.sqrt(np.mean(radial**2)), "m", "root mean square radial displacement"
        ),
        "beyond_yield_share": Quantity(
            beyond_yield_share(sheet, points), "1", "share of the surface beyond the yield stress"
        ),
        "self_crossing_share": Quantity(
            self_crossing_share(surface), "1", "share of the surface crossed by another part"
        ),
    }


def _count(number: int | None) -> float:
    return np.nan if number is None else float(number)


def _element_size(patch: Patch) -> float:
    return max(patch.size_around, patch.size_along)
