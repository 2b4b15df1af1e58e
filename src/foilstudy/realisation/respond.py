"""Static and dynamic stiffness of one crumpled realisation."""

from __future__ import annotations

import resource
import sys
import time
import traceback
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.config import ResponseTask
from foilstudy.dynamics import (
    HintzHerting,
    Structure,
    dynamic_stiffness,
    frequency_grid,
)
from foilstudy.outcome import USABLE
from foilstudy.patch import Patch, refine
from foilstudy.realisation.record import MACHINE_FAULTS, Quantity, read_record, write_record
from foilstudy.realisation.scene import foil_of
from foilstudy.sheet import Foil
from foilstudy.shell.sheet_model import SheetModel
from foilstudy.shell.tangent import mass_matrix, stiffness_matrix
from foilstudy.stiffness import (
    InterfaceSystem,
    Rings,
    StaticCondensation,
    condense,
    fixed_stiffness,
    free_stiffness,
)


@dataclass(frozen=True)
class _Crumple:
    """A crumpled shape as read back, SI."""

    foil: Foil
    patch: Patch
    points: np.ndarray
    reference: np.ndarray
    stabilisation: float

    def sheet(self, reference: np.ndarray, patch: Patch | None = None) -> SheetModel:
        """A sheet of this foil that is stress-free in the given shape."""
        foil = self.foil
        return SheetModel(
            patch or self.patch, reference, foil.material, foil.thickness, self.stabilisation
        )


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
        except MACHINE_FAULTS:
            raise
        except Exception as error:  # a study must survive any one realisation
            traceback.print_exc()
            status, message = "failed", f"{type(error).__name__}: {error}"
    quantities["peak_memory"] = Quantity(_peak_memory_mb(), "MB", "peak memory of the job")
    write_record(path, quantities, {"status": status, "message": message})
    print(_summary(quantities) if "static_stiffness" in quantities else f"{status}: {message}")


def _summary(quantities: dict[str, Quantity]) -> str:
    axial, radial = quantities["static_stiffness"].values
    seconds = sum(quantities[name].values for name in ("seconds_static", "seconds_dynamic"))
    return f"axial {axial:.4g} N/m, radial {radial:.4g} N/m ({seconds:.1f} s)"


def _measure(task: ResponseTask, values: dict, attributes: dict) -> dict[str, Quantity]:
    foil = foil_of(task)
    points = values["control_points"]
    _, rows, columns = points.shape
    patch = Patch(
        columns, rows - 2, np.pi * foil.diameter / columns, foil.reference_height / (rows - 2)
    )
    reference = values["reference_control_points"]
    crumple = _Crumple(foil, patch, points, reference, float(attributes["stabilisation"]))
    clock = time.perf_counter()
    stiffness, static = _stress_free(crumple.sheet(points))
    levels = [fixed_stiffness(static.stiffness), *_refined(task, crumple)]
    prestressed, negative = _prestressed(crumple)
    quantities = _static_quantities(static, levels) | {
        "prestressed_stiffness": Quantity(
            prestressed, "N/m", "tangent stiffness at the stressed equilibrium", ("direction",)
        ),
        "negative_eigenvalues": Quantity(
            float(negative), "1", "negative eigenvalues of the tangent, rings held"
        ),
    }
    seconds_static = time.perf_counter() - clock
    clock = time.perf_counter()
    structure = Structure(stiffness, _mass(crumple), static)
    quantities |= _dynamic_quantities(task, structure)
    seconds_dynamic = time.perf_counter() - clock
    return quantities | {
        "seconds_static": Quantity(seconds_static, "s", "time of the static stiffness"),
        "seconds_dynamic": Quantity(seconds_dynamic, "s", "time of the dynamic stiffness"),
    }


def _stress_free(sheet: SheetModel) -> tuple[InterfaceSystem, StaticCondensation]:
    rings = Rings.of(sheet.patch, sheet.reference)
    system = InterfaceSystem.split(stiffness_matrix(sheet), rings)
    return system, condense(system)


def _mass(crumple: _Crumple) -> InterfaceSystem:
    """Mass of the crumpled foil; the areal density is that of the undeformed foil."""
    foil, patch = crumple.foil, crumple.patch
    areas = crumple.sheet(crumple.reference).element_areas()
    matrix = mass_matrix(patch, foil.material.density * foil.thickness * areas)
    return InterfaceSystem.split(matrix, Rings.of(patch, crumple.points))


def _refined(task: ResponseTask, crumple: _Crumple) -> list[np.ndarray]:
    """Stiffness of the same shape on exactly refined meshes."""
    patch, points, levels = crumple.patch, crumple.points, []
    for _ in range(task.stiffness.refinements):
        patch, points = patch.refined(), refine(points)
        _, static = _stress_free(crumple.sheet(points, patch))
        levels.append(fixed_stiffness(static.stiffness))
    return levels


def _prestressed(crumple: _Crumple) -> tuple[np.ndarray, int]:
    """Stiffness with the stresses left in, and the inertia that says whether it is stable."""
    rings = Rings.of(crumple.patch, crumple.points)
    tangent = stiffness_matrix(crumple.sheet(crumple.reference), crumple.points)
    static = condense(InterfaceSystem.split(tangent, rings))
    return fixed_stiffness(static.stiffness), static.factor.negative_eigenvalues


def _static_quantities(static: StaticCondensation, levels: list) -> dict[str, Quantity]:
    finest, step = np.full(2, np.nan), np.full(2, np.nan)
    if len(levels) > 1:
        finest, step = levels[-1], np.abs(levels[-1] - levels[-2])
    directional = {
        "static_stiffness": (levels[0], "stress-free static stiffness, other motions held"),
        "static_stiffness_free": (
            free_stiffness(static.stiffness),
            "stress-free static stiffness, other motions free",
        ),
        "static_stiffness_converged": (
            finest,
            "stress-free static stiffness of the same shape on the finest exactly refined mesh",
        ),
        "static_stiffness_mesh_error": (
            step,
            "step of static_stiffness_converged from the next coarser mesh",
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


def _dynamic_quantities(task: ResponseTask, structure: Structure) -> dict[str, Quantity]:
    options = task.dynamics
    model = HintzHerting(options.cutoff_hz).reduce(structure)
    grid = frequency_grid(options.shown_min_hz, options.shown_max_hz, options.frequencies)
    stiffness = dynamic_stiffness(model, grid, options.damping_percent / 100)
    eigenfrequencies = model.clamped_eigenfrequencies(options.eigenfrequencies)
    eigenfrequencies[eigenfrequencies > options.cutoff_hz] = np.nan
    dims = ("definition", "direction", "frequency")
    return {
        "frequency": Quantity(grid, "Hz", "frequency", ("frequency",)),
        "dynamic_stiffness_re": Quantity(
            stiffness.real, "N/m", "real part of the dynamic stiffness", dims
        ),
        "dynamic_stiffness_im": Quantity(
            stiffness.imag, "N/m", "imaginary part of the dynamic stiffness", dims
        ),
        "eigenfrequency": Quantity(
            eigenfrequencies, "Hz", "eigenfrequencies with clamped rings", ("mode",)
        ),
        "first_eigenfrequency": Quantity(
            eigenfrequencies[0], "Hz", "first eigenfrequency with clamped rings"
        ),
        "retained_modes": Quantity(
            float(model.retained_modes), "1", "free-free modes kept by the reduction"
        ),
    }


def _peak_memory_mb() -> float:
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 1024 if sys.platform != "darwin" else peak / 1024**2
