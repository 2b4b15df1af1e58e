"""Crumple one realisation and record the shape."""

from __future__ import annotations

import time
import traceback
from pathlib import Path

import numpy as np

from foilstudy.config import CrumpleTask
from foilstudy.imperfection import imperfect_cylinder
from foilstudy.patch import Patch, cylinder_control_points, knot_points
from foilstudy.realisation.record import MACHINE_FAULTS, Quantity, write_record
from foilstudy.realisation.scene import foil_of, imperfection_of, patch_of
from foilstudy.relaxation import Ramp, RelaxationResult, Scheme, StoppingRule, relax
from foilstudy.relaxation.damping import AdaptiveViscousDamping
from foilstudy.relaxation.spectral_mass import SpectralMass
from foilstudy.shell.intersection import self_crossing_share
from foilstudy.shell.sheet_model import SheetModel
from foilstudy.shell.yielding import beyond_yield_share

RAMP_DAMPING, RELAXATION_DAMPING = 0.5, 0.25
"""Share of the critical damping of the current motion, while the ring moves and after. The Rayleigh
quotient overestimates the slowest mode, so that less damping settles sooner (docs/method.md)."""


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
        "stabilisation": task.relaxation.stabilisation,
    }
    started = time.perf_counter()
    try:
        sheet, result = _relax(task)
        quantities = _quantities(sheet, result)
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


def _relax(task: CrumpleTask) -> tuple[SheetModel, RelaxationResult]:
    foil, patch, options = foil_of(task), patch_of(task), task.relaxation
    perfect = cylinder_control_points(patch, foil.diameter)
    reference = imperfect_cylinder(patch, perfect, foil, imperfection_of(task))
    sheet = SheetModel(patch, reference, foil.material, foil.thickness, options.stabilisation)
    scheme = Scheme(
        mass=SpectralMass(sheet),
        ramp_damping=AdaptiveViscousDamping(RAMP_DAMPING),
        relaxation_damping=AdaptiveViscousDamping(RELAXATION_DAMPING),
    )
    rule = StoppingRule(
        options.residual_tolerance,
        options.kinetic_energy_tolerance,
        options.relaxation_steps_max,
        options.check_interval,
    )
    ramp = Ramp(foil.reference_height - foil.gap_height, options.ramp_steps)
    return sheet, relax(sheet, scheme, ramp, rule)


def _quantities(sheet: SheetModel, result: RelaxationResult) -> dict[str, Quantity]:
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
    quantities = {
        f"history_{name}": Quantity(getattr(result.history, name), units, text, ("history",))
        for name, (units, text) in history.items()
    }
    if result.status == "diverged":
        return quantities
    return quantities | _shape(sheet, result.points) | _scalars(sheet, result)


def _shape(sheet: SheetModel, points: np.ndarray) -> dict[str, Quantity]:
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


def _scalars(sheet: SheetModel, result: RelaxationResult) -> dict[str, Quantity]:
    points, patch = result.points, sheet.patch
    energies = sheet.energies(points)
    surface = knot_points(points)
    radial = _radial_displacement(surface, knot_points(sheet.reference))
    return {
        "membrane_energy": Quantity(energies.membrane, "J", "membrane energy"),
        "bending_energy": Quantity(energies.bending, "J", "bending energy"),
        "stabilisation_energy": Quantity(energies.stabilisation, "J", "stabilisation energy"),
        "reaction_force": Quantity(
            result.history.reaction_force[-1], "N", "axial force of the foil on the top ring"
        ),
        "equilibrium_residual": Quantity(
            result.residual, "1", "norm of the force on the free foil over that on the rings"
        ),
        "kinetic_energy_ratio": Quantity(
            result.kinetic_energy_ratio, "1", "kinetic over strain energy at the end"
        ),
        "steps": Quantity(float(result.steps), "1", "pseudo-time steps, ramp included"),
        "element_size": Quantity(_element_size(patch), "m", "element length around"),
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


def _element_size(patch: Patch) -> float:
    return max(patch.size_around, patch.size_along)
