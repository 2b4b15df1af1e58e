"""Which results of a sweep are there but do not count; missing ones need no telling."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from foilstudy.base.cube import verified_attributes
from foilstudy.base.errors import Refusal
from foilstudy.base.manifest import listed, outdated
from foilstudy.base.origin import Origin
from foilstudy.base.record import read_record
from foilstudy.config import StudyConfig
from foilstudy.study.stale import Stale
from foilstudy.study.sweep.origins import (
    cell_folder,
    crumple_origin,
    cube_origin,
    cylinder_origin,
    export_origin,
    parts_of,
    presented_origin,
    refined_origin,
    response_origin,
)

__all__ = ["stale_results"]


def stale_results(
    study: StudyConfig, results: Path, presented: Iterable[Path] = ()
) -> Iterator[Stale]:
    """Go through the results of a study in the order in which they are made.

    Parameters
    ----------
    study : StudyConfig
    results : Path
        Folder of the study.
    presented : iterable of Path
        Tables, figures and page.
    """
    digests: dict[str, list[str]] = {name: [] for name in parts_of(study)}
    for cell in study.cells():
        folder = cell_folder(results, cell)
        path = folder / "crumple.nc"
        crumple = yield from _checked(path, crumple_origin(study.crumple_task(cell)))
        digests["crumple"].append(crumple.get("digest", ""))
        if not crumple:
            digests["response"].append("")
            continue  # all else is made from it, and so made again with it
        origins = {"response": response_origin(study.response_task(cell), crumple)}
        if "refined" in digests:
            origins["refined"] = refined_origin(study.refine_task(cell), crumple)
        for name, origin in origins.items():
            record = yield from _checked(folder / f"{name}.nc", origin)
            digests[name].append(record.get("digest", ""))
        if study.export.formats:
            wanted = export_origin(study.response_task(cell), crumple, study.export.formats)
            yield from _checked_export(folder / "export", wanted)
    cylinder = yield from _checked(results / "cylinder.nc", cylinder_origin(study))
    if cylinder and all(all(found) for found in digests.values()):
        arrays = {name: np.array(found) for name, found in digests.items()}
        wanted = cube_origin(study, arrays, cylinder["digest"])
    else:
        wanted = cube_origin(study, {}, "")  # no cube was made from what is not there
    cube = yield from _checked(results / "cube.nc", wanted, verified_attributes)
    if cube:
        other = outdated(results, presented_origin(cube), presented)
    else:
        other = {path: "was made from another cube" for path in presented if path.is_file()}
    yield from (Stale(path, reason) for path, reason in other.items())


def _verified(path: Path) -> dict[str, Any]:
    _, attributes = read_record(path)
    return attributes


def _checked(
    path: Path, wanted: Origin, read: Callable[[Path], dict[str, Any]] = _verified
) -> Generator[Stale, None, dict[str, Any]]:
    """Attributes of a file that counts; empty without one, which is told if it is there."""
    if not os.path.lexists(path):
        return {}
    try:
        attributes = read(path)
    except Refusal as problem:
        yield Stale.refused(path, problem)
        return {}
    if departure := Origin.of(attributes).departure(wanted):
        yield Stale(path, f"was made {departure}")
        return {}
    return attributes


def _checked_export(folder: Path, wanted: Origin) -> Iterator[Stale]:
    if not os.path.lexists(folder):
        return
    files = listed(folder)
    if reasons := list(outdated(folder, wanted, files).values()):
        yield Stale(folder, reasons[0])
    elif not files or not all(path.is_file() for path in files):
        yield Stale(folder, "is not complete")
