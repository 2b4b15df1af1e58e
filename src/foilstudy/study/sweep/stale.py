"""Which results of a sweep are there but do not count; missing ones need no telling."""

from __future__ import annotations

import os
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from foilstudy.base.cube import verified_attributes
from foilstudy.base.errors import Refusal
from foilstudy.base.manifest import listed, outdated
from foilstudy.base.origin import Origin
from foilstudy.base.record import read_record
from foilstudy.config import Cell, StudyConfig
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
from foilstudy.study.sweep.rounds import Values, rounds, stiffnesses_of

__all__ = ["stale_results"]

_STIFFNESSES = "stiffnesses"
"""Key of the values that rounds go by, beside the attributes of a response."""


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
    made: dict[Cell, _Made] = {}
    for cell in study.cells():
        made[cell] = yield from _realisation(study, results, cell)
    wanted = yield from _rounds(study, results, made)
    cylinder = yield from _checked(results / "cylinder.nc", cylinder_origin(study))
    parts = parts_of(study)
    if cylinder and wanted and all(made[cell].digests.keys() == set(parts) for cell in wanted):
        arrays = {name: np.array([made[cell].digests[name] for cell in wanted]) for name in parts}
        origin = cube_origin(study, arrays, cylinder["digest"])
    else:
        origin = cube_origin(study, {}, "")  # no cube was made from what is not there
    cube = yield from _checked(results / "cube.nc", origin, verified_attributes)
    if cube:
        other = outdated(results, presented_origin(cube), presented)
    else:
        other = {path: "was made from another cube" for path in presented if path.is_file()}
    yield from (Stale(path, reason) for path, reason in other.items())


@dataclass(frozen=True)
class _Made:
    """What counts of a realisation: digests of its records by their names, its stiffnesses."""

    digests: dict[str, str]
    stiffnesses: Values | None = None


def _realisation(study: StudyConfig, results: Path, cell: Cell) -> Generator[Stale, None, _Made]:
    folder = cell_folder(results, cell)
    path = folder / "crumple.nc"
    crumple = yield from _checked(path, crumple_origin(study.crumple_task(cell)))
    if not crumple:
        return _Made({})  # all else is made from it, and so made again with it
    digests = {"crumple": crumple["digest"]}
    origin = response_origin(study.response_task(cell), crumple)
    response = yield from _checked(folder / "response.nc", origin, _responded)
    if response:
        digests["response"] = response["digest"]
    if "refined" in parts_of(study):
        origin = refined_origin(study.refine_task(cell), crumple)
        refined = yield from _checked(folder / "refined.nc", origin)
        if refined:
            digests["refined"] = refined["digest"]
    if study.export.formats:
        wanted = export_origin(study.response_task(cell), crumple, study.export.formats)
        yield from _checked_export(folder / "export", wanted)
    return _Made(digests, response.get(_STIFFNESSES))


class _NotMade(Exception):
    """A realisation that a round waits for."""


def _rounds(
    study: StudyConfig, results: Path, made: Mapping[Cell, _Made]
) -> Generator[Stale, None, tuple[Cell, ...]]:
    """Realisations of the study; none where that is not known yet."""
    if not study.sweep.in_rounds:
        return study.cells()

    def values_of(cell: Cell) -> Values:
        if (stiffnesses := made[cell].stiffnesses) is None:
            raise _NotMade
        return stiffnesses

    texts: list[str] = []
    last: tuple[Cell, ...] = ()
    with suppress(_NotMade):
        for each in rounds(study, values_of):
            texts.append(each.text())
            if each.is_last:
                last = each.cells(study)
    for path in sorted((results / "rounds").glob("*.json")):
        number = int(path.stem) if path.stem.isdecimal() else len(texts)
        if number < len(texts):
            if path.read_text("utf-8", errors="replace") != texts[number]:
                yield Stale(path, "was made from other realisations or for another wish")
        elif not last:  # else of longer rounds than these, and nobody reads it
            yield Stale(path, "was made from realisations that are not there")
    return last


def _verified(path: Path) -> dict[str, Any]:
    _, attributes = read_record(path)
    return attributes


def _responded(path: Path) -> dict[str, Any]:
    values, attributes = read_record(path)
    return attributes | {_STIFFNESSES: stiffnesses_of(values, attributes)}


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
