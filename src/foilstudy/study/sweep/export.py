"""From the record of a realisation to the files of an export."""

from __future__ import annotations

import traceback
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from foilstudy.base.errors import Refusal
from foilstudy.base.files import written_whole
from foilstudy.base.manifest import write_manifest
from foilstudy.base.origin import Origin
from foilstudy.base.provenance import provenance
from foilstudy.base.record import AGAIN, MACHINE_FAULTS, read_attributes
from foilstudy.config import ResponseTask
from foilstudy.config.scene import air_of, dynamics_of
from foilstudy.export.contents import Contents
from foilstudy.export.formats import FORMATS
from foilstudy.export.write import write
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.study.sweep.origins import (
    export_origin,
    read_crumple,
    refuse_departure,
    response_origin,
)

README = "README.txt"


def recorded_task(folder: Path) -> ResponseTask:
    """Foil, damping, reduction and band of a finished realisation, from its ``response.nc``.

    Raises
    ------
    Refusal
        If one of the records is unreadable, was made by other code, or does not belong to the
        other.
    """
    path = folder / "response.nc"
    attributes = read_attributes(path)
    try:
        task = ResponseTask.model_validate_json(attributes["task"])
    except ValidationError:
        raise Refusal(f"{path}: is the record of another kind of task; {AGAIN}.") from None
    _, crumple = read_crumple(folder / "crumple.nc", task)
    refuse_departure(path, Origin.of(attributes), response_origin(task, crumple))
    return task


def contents_of(task: ResponseTask, crumple_path: Path, refinements: int = 0) -> Contents:
    """Shape and dynamics of one crumple; its reduced model is made when a format asks for it.

    Parameters
    ----------
    task : ResponseTask
        Foil, damping, reduction and band.
    crumple_path : Path
        Record of a crumple.
    refinements : int
        How often the elements of the same shape are halved before.

    Raises
    ------
    Refusal
        If the record is unreadable or another's, or if the crumple is no equilibrium.
    """
    if refinements < 0:
        raise Refusal(f"refinements is {refinements}; elements can be halved, not joined.")
    return _contents(task, crumple_path, *read_crumple(crumple_path, task), refinements)


def _contents(
    task: ResponseTask,
    crumple_path: Path,
    values: dict[str, np.ndarray],
    attributes: dict[str, Any],
    refinements: int = 0,
) -> Contents:
    status = attributes["status"]
    if status != "converged":
        raise Refusal(
            f"{crumple_path}: its status is {status} ({attributes['message']}); "
            "only an equilibrium is exported, so relax it further or take another seed."
        )
    origin = {
        "thickness_um": f"{task.thickness_um:g}",
        "reference_height_mm": f"{task.reference_height_mm:g}",
        "seed": f"{task.seed}",
        "refinements": f"{refinements}",
        "crumple_git_commit": str(attributes["git_commit"]),
    }
    try:
        crumpled = Crumpled.of_record(values, attributes)
        for _ in range(refinements):
            crumpled = crumpled.refined()
        return Contents.of(
            crumpled, dynamics_of(task.dynamics), origin | provenance(), air_of(task.air)
        )
    except Refusal as problem:
        raise Refusal(f"{crumple_path}: {problem}") from None


def export_realisation(task: ResponseTask, crumple_path: Path, folder: Path, *formats: str) -> None:
    """Write the formats into a folder, and beside them a text that says what each is.

    A realisation or a format that cannot be exported leaves its reason in that text, so that a
    study goes on.

    Raises
    ------
    Refusal
        If a format is unknown, or the record of the crumple unreadable or another's.
    """
    files = {name: FORMATS.choice(name).filename for name in formats}
    values, attributes = read_crumple(crumple_path, task)
    lines = [
        f"Realisation {task.thickness_um:g} um, {task.reference_height_mm:g} mm, seed {task.seed}.",
        "SI units; how to open these files: docs/exchange.md.",
        "",
    ]
    try:
        contents = _contents(task, crumple_path, values, attributes)
    except MACHINE_FAULTS:
        raise
    except Exception as error:  # a study must survive any one realisation
        lines.append(f"Not exported: {_reason(error)}")
    else:
        lines += [_exported(contents, name, folder) for name in files]
    with written_whole(folder / README) as partial:
        partial.write_text("\n".join(lines) + "\n", encoding="utf-8")
    there = [path for filename in files.values() if (path := folder / filename).is_file()]
    write_manifest(folder, export_origin(task, attributes, formats), [folder / README, *there])
    print("\n".join(lines), f"{len(there)} of {len(files)} files written", sep="\n")


def _exported(contents: Contents, name: str, folder: Path) -> str:
    """Write one format; the line that says what it is, or why it is not there."""
    kind = FORMATS.choice(name)
    try:
        write(contents, name, folder / kind.filename)
    except MACHINE_FAULTS:
        raise
    except Exception as error:  # the other formats may well be possible
        return f"{kind.filename}: not written: {_reason(error)}"
    return f"{kind.filename}: {kind.words}"


def _reason(error: Exception) -> str:
    if isinstance(error, Refusal):
        return str(error)
    traceback.print_exc()
    return f"{type(error).__name__}: {error}"
