"""The cube: every realisation of a study in one NetCDF file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from foilstudy.base.cube import CONTENT, CONVENTION
from foilstudy.base.digest import digest_of
from foilstudy.base.files import written_whole
from foilstudy.base.origin import Origin
from foilstudy.base.outcome import NOT_NEEDED, USABLE
from foilstudy.base.provenance import provenance
from foilstudy.base.record import read_record
from foilstudy.config import Cell, StudyConfig
from foilstudy.config.scene import dynamics_of
from foilstudy.measure.dynamics import DEFINITIONS
from foilstudy.measure.stiffness import DOF_NAMES
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.measure.verdicts import VERDICTS
from foilstudy.study.sweep.origins import (
    cell_folder,
    crumple_origin,
    cube_origin,
    cylinder_origin,
    parts_of,
    physics_codes,
    refined_origin,
    refuse_departure,
    response_origin,
)
from foilstudy.study.sweep.quantities import QUANTITIES
from foilstudy.study.sweep.rounds import recorded_values, wanted_cells

_CELL = ("thickness", "overlength", "seed")


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

    Raises
    ------
    Refusal
        If a record is missing, unreadable, of another task, or made by other code.
    """
    wanted = wanted_cells(study, lambda cell: recorded_values(study, results, cell))
    coordinates = _coordinates(study, wanted)
    elastic, passing = study.material.law == "elastic", study.contact.kind == "none"
    variables = {
        name: q
        for name, q in QUANTITIES.items()
        if q.in_cube and not (elastic and q.yielding) and not (passing and q.touching)
    }
    sizes = {name: len(values) for name, (_, values, _) in coordinates.items()}
    cells = tuple(sizes[name] for name in _CELL)
    data = {
        name: np.full(cells + tuple(sizes[d] for d in quantity.dims), np.nan)
        for name, quantity in variables.items()
    }
    status = np.full(cells, NOT_NEEDED, dtype=object)
    message = np.full(cells, "", dtype=object)
    refined = study.stiffness.relaxed_refinements > 0
    refined_status = np.full(cells, "", dtype=object)
    digests = {name: np.full(cells, "", dtype=object) for name in parts_of(study)}
    commits: set[str] = set()
    for cell in wanted:
        record = _read_cell(study, cell, results)
        index = (
            study.thicknesses_um.index(cell.thickness_um),
            study.reference_heights_mm.index(cell.reference_height_mm),
            cell.seed,
        )
        status[index], message[index] = record.status, record.message
        refined_status[index] = record.refined_status
        commits |= record.commits
        for name, digest in record.digests.items():
            digests[name][index] = digest
        for name in data.keys() & record.values.keys():
            data[name][index] = record.values[name] * variables[name].cube_scale
    cube = xr.Dataset(
        {
            name: (
                _CELL + quantity.dims,
                data[name],
                {"units": quantity.cube_units or quantity.units, "long_name": quantity.words},
            )
            for name, quantity in variables.items()
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
    bounds, attributes = _read(results / "cylinder.nc", cylinder_origin(study))
    for name, values in bounds.items():
        what = QUANTITIES[name]
        cube[name] = (what.dims, values, {"units": what.units, "long_name": what.words})
    cube["verdict"] = _flagged(cube["verdict"])
    cube["status"] = (_CELL, status, {"units": "1", "long_name": "outcome of the realisation"})
    cube["message"] = (_CELL, message, {"units": "1", "long_name": "reason of the status"})
    if refined:
        words = {"units": "1", "long_name": "outcome of relaxing again on refined meshes"}
        cube["refined_status"] = (_CELL, refined_status, words)
    for name, values in digests.items():
        words = {"units": "1", "long_name": f"digest of the record {name}.nc"}
        cube[f"{name}_digest"] = (_CELL, values, words)
    there = status != NOT_NEEDED
    gathered = {name: found[there] for name, found in digests.items()}
    origin = cube_origin(study, gathered, attributes["digest"])
    cube.attrs |= origin.attributes() | {"digest": origin.digest} | physics_codes(study)
    cube.attrs[CONTENT] = digest_of({name: v.values for name, v in cube.variables.items()})
    _write(cube, path)
    return cube


def _coordinates(
    study: StudyConfig, wanted: Sequence[Cell]
) -> dict[str, tuple[str, np.ndarray, dict]]:
    options = dynamics_of(study.dynamics)

    def coordinate(dim, values, units, text):
        return dim, np.asarray(values), {"units": units, "long_name": text}

    names = {"units": "1", "long_name": "ring motion"}
    return {
        "thickness": coordinate("thickness", study.thicknesses_um, "um", "foil thickness"),
        "overlength": coordinate("overlength", study.overlengths_percent, "%", "overlength"),
        "reference_height": coordinate(
            "overlength", study.reference_heights_mm, "mm", "height of the uncrumpled cylinder"
        ),
        "seed": coordinate("seed", np.arange(1 + max(c.seed for c in wanted)), "1", "realisation"),
        "direction": coordinate("direction", DIRECTIONS, "1", "direction of motion and force"),
        "definition": coordinate("definition", DEFINITIONS, "1", "dynamic stiffness definition"),
        "frequency": coordinate("frequency", options.grid, "Hz", "frequency"),
        "interface_dof": ("interface_dof", np.asarray(DOF_NAMES), names),
        "interface_dof_in": ("interface_dof_in", np.asarray(DOF_NAMES), names),
        "mode": coordinate("mode", np.arange(1, options.eigenfrequencies + 1), "1", "mode number"),
    }


def _flagged(verdict: xr.DataArray) -> xr.DataArray:
    """As whole numbers, which say by the CF conventions what their bits mean."""
    masks = np.array([1 << bit for bit in range(len(VERDICTS))], dtype=np.int32)
    meanings = " ".join(each.name for each in VERDICTS)
    attributes = verdict.attrs | {"flag_masks": masks, "flag_meanings": meanings}
    return verdict.fillna(0).astype(np.int32).assign_attrs(attributes)


@dataclass(frozen=True)
class _Cell:
    values: dict[str, np.ndarray]
    status: str
    message: str
    commits: set[str]
    digests: dict[str, str]
    refined_status: str = ""


def _read_cell(study: StudyConfig, cell: Cell, results: Path) -> _Cell:
    folder = cell_folder(results, cell)
    wanted = crumple_origin(study.crumple_task(cell))
    values, crumple = _read(folder / "crumple.nc", wanted)
    wanted = response_origin(study.response_task(cell), crumple)
    responded, response = _read(folder / "response.nc", wanted)
    status, message = response["status"], response["message"]
    records, values, relaxed_again = [crumple, response], values | responded, ""
    if study.stiffness.relaxed_refinements:  # records of an earlier setting stay around
        wanted = refined_origin(study.refine_task(cell), crumple)
        relaxed, refined = _read(folder / "refined.nc", wanted)
        records, values = [*records, refined], values | relaxed
        if status in USABLE:
            relaxed_again = refined["status"]
            if relaxed_again != "converged":
                message = f"{message}; relaxed again: {refined['message']}"
    return _Cell(
        # whatever the crumple holds, it has failed
        values if status in USABLE else {"verdict": responded["verdict"]},
        status,
        message,
        {record["git_commit"] for record in records},
        {name: record["digest"] for name, record in zip(parts_of(study), records, strict=True)},
        relaxed_again,
    )


def _read(path: Path, wanted: Origin) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    values, attributes = read_record(path)
    refuse_departure(path, Origin.of(attributes), wanted)
    return values, attributes


def _write(cube: xr.Dataset, path: Path) -> None:
    encoding = {
        name: {"zlib": True, "shuffle": True, "complevel": 4}
        for name, variable in cube.data_vars.items()
        if variable.dtype.kind == "f"
    }
    with written_whole(path) as partial:
        cube.to_netcdf(partial, engine="netcdf4", encoding=encoding)
