"""The cube: every realisation of a study in one NetCDF file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from foilstudy.base.files import written_whole
from foilstudy.base.outcome import USABLE
from foilstudy.base.provenance import provenance
from foilstudy.base.record import read_record
from foilstudy.config import Cell, StudyConfig
from foilstudy.measure.dynamics import DEFINITIONS, frequency_grid
from foilstudy.measure.stiffness import DOF_NAMES
from foilstudy.measure.stiffness.directional import DIRECTIONS

CONVENTION = "foilstudy cube 1"

_CELL = ("thickness", "overlength", "seed")
_MILLI = {"radial_displacement_min", "radial_displacement_max", "radial_displacement_rms"} | {
    "element_size",
    "refined_element_size",
}
"""Lengths that the records hold in m and the cube in mm."""


def _variables(study: StudyConfig) -> dict[str, tuple[tuple[str, ...], str, str]]:
    """Dimensions beyond the cell, unit and meaning of every variable per realisation."""
    directional = ("direction",)
    dynamic = ("definition", "direction", "frequency")
    return {
        "static_stiffness": (directional, "N/m", "static stiffness, other motions held"),
        "static_stiffness_free": (directional, "N/m", "static stiffness, other motions free"),
        "static_stiffness_converged": (
            directional,
            "N/m",
            "static stiffness of the same shape, extrapolated to element size zero",
        ),
        "static_stiffness_mesh_error": (
            directional,
            "N/m",
            "estimated mesh error of static_stiffness_converged",
        ),
        "prestressed_stiffness": (
            directional,
            "N/m",
            "static stiffness at the stressed equilibrium, other motions held",
        ),
        "prestressed_stiffness_converged": (
            directional,
            "N/m",
            "pre-stressed stiffness, relaxed again on the finest mesh",
        ),
        "prestressed_stiffness_mesh_error": (
            directional,
            "N/m",
            "step of prestressed_stiffness_converged from the next coarser mesh",
        ),
        "refined_static_stiffness": (
            directional,
            "N/m",
            "static stiffness of the shape relaxed again on the finest mesh",
        ),
        "interface_stiffness": (
            ("interface_dof", "interface_dof_in"),
            "N/m, N, N m",
            "stress-free interface stiffness, rotations in rad",
        ),
        "dynamic_stiffness_re": (dynamic, "N/m", "dynamic stiffness, real part"),
        "dynamic_stiffness_im": (dynamic, "N/m", "dynamic stiffness, imaginary part"),
        "eigenfrequency": (("mode",), "Hz", "eigenfrequency, rings clamped"),
        "first_eigenfrequency": ((), "Hz", "first eigenfrequency, rings clamped"),
        "membrane_energy": ((), "J", "membrane energy"),
        "bending_energy": ((), "J", "bending energy"),
        "stabilisation_energy": ((), "J", "stabilisation energy"),
        "reaction_force": ((), "N", "axial force of the crumpled foil on the top ring"),
        "radial_displacement_min": ((), "mm", "smallest radial displacement"),
        "radial_displacement_max": ((), "mm", "largest radial displacement"),
        "radial_displacement_rms": ((), "mm", "root mean square radial displacement"),
        "equilibrium_residual": ((), "1", "force on the free foil over force on the rings"),
        "negative_eigenvalues": ((), "1", "negative eigenvalues of the tangent at the end"),
        "steps": ((), "1", "pseudo-time steps, ramp included"),
        "newton_steps": ((), "1", "quasi-Newton steps after them"),
        "refined_strain_energy": ((), "J", "strain energy, relaxed again on the finest mesh"),
        "refined_element_size": ((), "mm", "element size of the finest relaxed mesh"),
        "refined_residual": ((), "1", "equilibrium residual on the finest relaxed mesh"),
        "refined_negative_eigenvalues": ((), "1", "negative eigenvalues on that mesh"),
        "refined_steps": ((), "1", "pseudo-time steps on that mesh"),
        "element_size": ((), "mm", "element size of the crumpled mesh"),
        "beyond_yield_share": ((), "1", "share of the surface beyond the yield stress"),
        "self_crossing_share": ((), "1", "share of the surface crossed by another part"),
        "mode_count": (("frequency",), "1", "eigenfrequencies, rings clamped, below a frequency"),
        "reduced_coordinates": ((), "1", "coordinates of the reduced model"),
        "reduction_error": ((), "1", "estimated largest relative error of the reduction"),
        "valid_to_frequency": ((), "Hz", "frequency up to which that meets the tolerance"),
        "seconds_crumple": ((), "s", "time of crumpling"),
        "seconds_static": ((), "s", "time of the static stiffness"),
        "seconds_dynamic": ((), "s", "time of the dynamic stiffness"),
        "seconds_refined": ((), "s", "time of relaxing again on refined meshes"),
        "peak_memory": ((), "MB", "peak memory of the response job"),
    }


def gather(study: StudyConfig, results: Path, path: Path) -> xr.Dataset:
    """Collect the records of a study into a cube and write it.

    Parameters
    ----------
    study : StudyConfig
    results : Path
        Folder with ``realisations/THICKNESS/OVERLENGTH/SEED/`` and ``cylinder.nc``.
    path : Path
        The cube; it appears only when it is complete.

    Returns
    -------
    xarray.Dataset
        As written.
    """
    coordinates = _coordinates(study)
    variables = _variables(study)
    sizes = {name: len(values) for name, (_, values, _) in coordinates.items()}
    cells = tuple(sizes[name] for name in _CELL)
    data = {
        name: np.full(cells + tuple(sizes[d] for d in dims), np.nan)
        for name, (dims, _, _) in variables.items()
    }
    status = np.full(cells, "", dtype=object)
    message = np.full(cells, "", dtype=object)
    position = {cell: index for index, cell in zip(np.ndindex(cells), study.cells(), strict=True)}
    commits: set[str] = set()
    for cell, index in position.items():
        record = _read_cell(results, cell)
        status[index], message[index] = record.status, record.message
        commits |= record.commits
        for name in data.keys() & record.values.keys():
            data[name][index] = record.values[name] * (1e3 if name in _MILLI else 1.0)
    cube = xr.Dataset(
        {
            name: (_CELL + dims, data[name], {"units": units, "long_name": text})
            for name, (dims, units, text) in variables.items()
        },
        coords={
            name: (dim, values, attributes)
            for name, (dim, values, attributes) in coordinates.items()
        },
        attrs={
            "Conventions": CONVENTION,
            "title": study.report.title,
            "study": study.study.name,
            "config": study.to_yaml(),
            **provenance(),
            "realisation_commits": ", ".join(sorted(commits)),
        },
    )
    bounds, _ = read_record(results / "cylinder.nc")
    cube["cylinder_stiffness"] = (
        ("thickness", "overlength", "direction"),
        bounds["cylinder_stiffness"],
        {"units": "N/m", "long_name": "static stiffness of the uncrumpled cylinder"},
    )
    cube["status"] = (_CELL, status, {"units": "1", "long_name": "outcome of the realisation"})
    cube["message"] = (_CELL, message, {"units": "1", "long_name": "reason of the status"})
    _write(cube, path)
    return cube


def _coordinates(study: StudyConfig) -> dict[str, tuple[str, np.ndarray, dict]]:
    options = study.dynamics
    grid = frequency_grid(options.shown_min_hz, options.shown_max_hz, options.frequencies)

    def coordinate(dim, values, units, text):
        return dim, np.asarray(values), {"units": units, "long_name": text}

    names = {"units": "1", "long_name": "ring motion"}
    return {
        "thickness": coordinate("thickness", study.thicknesses_um, "um", "foil thickness"),
        "overlength": coordinate("overlength", study.overlengths_percent, "%", "overlength"),
        "reference_height": coordinate(
            "overlength", study.reference_heights_mm, "mm", "height of the uncrumpled cylinder"
        ),
        "seed": coordinate("seed", study.seeds, "1", "realisation"),
        "direction": coordinate("direction", DIRECTIONS, "1", "direction of motion and force"),
        "definition": coordinate("definition", DEFINITIONS, "1", "dynamic stiffness definition"),
        "frequency": coordinate("frequency", grid, "Hz", "frequency"),
        "interface_dof": ("interface_dof", np.asarray(DOF_NAMES), names),
        "interface_dof_in": ("interface_dof_in", np.asarray(DOF_NAMES), names),
        "mode": coordinate("mode", np.arange(1, options.eigenfrequencies + 1), "1", "mode number"),
    }


@dataclass(frozen=True)
class _Cell:
    values: dict[str, np.ndarray]
    status: str
    message: str
    commits: set[str]


def _read_cell(results: Path, cell: Cell) -> _Cell:
    folder = results / "realisations" / cell.thickness_id / cell.overlength_id / str(cell.seed)
    crumpled, crumple_attributes = read_record(folder / "crumple.nc")
    responded, attributes = read_record(folder / "response.nc")
    status, message = attributes["status"], attributes["message"]
    commits = {a.get("git_commit", "unknown") for a in (crumple_attributes, attributes)}
    if status not in USABLE:
        return _Cell({}, status, message, commits)  # whatever the crumple holds, it has failed
    refined: dict[str, np.ndarray] = {}
    if (folder / "refined.nc").exists():
        refined, refined_attributes = read_record(folder / "refined.nc")
        commits.add(refined_attributes.get("git_commit", "unknown"))
    return _Cell(crumpled | responded | refined, status, message, commits)


def _write(cube: xr.Dataset, path: Path) -> None:
    encoding = {
        name: {"zlib": True, "shuffle": True, "complevel": 4}
        for name, variable in cube.data_vars.items()
        if variable.dtype.kind == "f"
    }
    with written_whole(path) as partial:
        cube.to_netcdf(partial, engine="netcdf4", encoding=encoding)


def open_cube(path: str | Path) -> xr.Dataset:
    """Open a cube with its dynamic stiffness as one complex variable.

    Parameters
    ----------
    path : str or Path
        ``results/NAME/cube.nc``.

    Returns
    -------
    xarray.Dataset
        Loaded; ``dynamic_stiffness`` replaces its real and imaginary parts.

    Raises
    ------
    ValueError
        If there is no such file, or if it is not a cube of this package.
    """
    path = Path(path)
    if not path.exists():
        raise ValueError(f"{path} does not exist; run the study first or correct the path.")
    if not path.is_file():
        raise ValueError(f"{path} is not a file; give the cube.nc of a study.")
    try:
        with xr.open_dataset(path, engine="netcdf4") as file:
            cube = file.load()
    except (OSError, ValueError, RuntimeError) as error:
        raise ValueError(
            f"{path} is not a NetCDF file that can be read ({error}); give the cube.nc of a study."
        ) from error
    parts = {"dynamic_stiffness_re", "dynamic_stiffness_im"}
    if cube.attrs.get("Conventions") != CONVENTION or not parts <= set(cube):
        raise ValueError(
            f"{path} is a NetCDF file but not a cube of foilstudy; give the cube.nc of a study, "
            "not the record of one realisation."
        )
    real, imaginary = cube["dynamic_stiffness_re"], cube["dynamic_stiffness_im"]
    cube["dynamic_stiffness"] = (real + 1j * imaginary).assign_attrs(
        units="N/m", long_name="dynamic stiffness"
    )
    return cube.drop_vars(parts)
