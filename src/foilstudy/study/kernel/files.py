"""Records of a side study, and the tables and figures made of them.

Everything of a study lies in its folder: a record ``PART/CASE.json`` per case, with large arrays in
``PART/CASE.npz`` beside it, then the tables, and every figure as PNG and SVG.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from dataclasses import asdict, is_dataclass, replace
from pathlib import Path

import numpy as np

from foilstudy.base.costs import Cost, measured
from foilstudy.base.digest import digest_of
from foilstudy.base.errors import Refusal
from foilstudy.base.files import json_text, read_json_text, write_json, written_whole
from foilstudy.base.manifest import outdated, write_manifest
from foilstudy.base.origin import Origin
from foilstudy.base.provenance import provenance
from foilstudy.base.record import AGAIN
from foilstudy.base.tables import csv_text
from foilstudy.study.kernel.plan import Case, Lazy, Part, Record, Records, Study, case_name
from foilstudy.study.stale import Stale


def measure(
    study: Study, part: str, case: str, path: str | Path, needed: Iterable[str | Path] = ()
) -> Record:
    """Measure one case and write its record.

    Parameters
    ----------
    part, case : str
        Names.
    path : path
        Of the JSON to write.
    needed : iterable of path
        JSON of the records that the case takes.
    """
    plan = study.part(part)
    records: Records = {name: {} for name in plan.needs}
    for other in (read_record(study, path) for path in needed):
        records[other.part][other.case] = other
    _ = plan.code  # as it is before it is loaded
    if isinstance(plan.measure, Lazy):
        plan.measure.load()  # which is no cost of the case
    with measured() as cost:
        result = plan.measure(plan.case(case), **records)
    record = Record(part, plan.case(case), asdict(result) if is_dataclass(result) else result, cost)
    write_record(study, record, path, records)
    return record


def write_record(
    study: Study, record: Record, path: str | Path, needed: Records | None = None
) -> None:
    """Write a record as JSON, its arrays beside it; `needed` are the records it was made from."""
    path, keys, result = Path(path), study.part(record.part).arrays, record.result
    arrays = {key: np.asarray(result[key]) for key in keys}
    if keys:
        with written_whole(path.with_suffix(".npz")) as partial, partial.open("wb") as file:
            np.savez_compressed(file, **arrays)
        result = {key: value for key, value in result.items() if key not in keys}
    head = {"study": study.name, "part": record.part, "case": case_name(record.case)}
    head["parameters"] = asdict(record.case) if is_dataclass(record.case) else {}
    made = _origin(study, record.part, record.case, needed or {}).attributes()
    made["digest"] = digest_of(arrays, json.dumps(json.loads(json_text(result))))
    write_json(head | made | provenance() | {"cost": asdict(record.cost), "result": result}, path)


def read_record(study: Study, path: str | Path, needed: Records | None = None) -> Record:
    """The record in a JSON file and the arrays beside it.

    Parameters
    ----------
    needed : records, optional
        Those beside it that it is made from; without them it is not asked whether it was.

    Raises
    ------
    Refusal
        If a file is missing, cut off, or none of this study, if the record is of another case,
        made by other code or from other records, or holds other values than were written.
    """
    path = Path(path)
    try:
        text = path.read_text("utf-8")
        content, plain = read_json_text(text), json.loads(text)["result"]
        part, result = study.part(content["part"]), content["result"]
        case, cost, digest = part.case(content["case"]), Cost(**content["cost"]), content["digest"]
        arrays = {}
        if part.arrays:
            with np.load(path.with_suffix(".npz")) as file:
                arrays = {key: file[key] for key in part.arrays}
    except MemoryError:
        raise
    except Exception as error:  # a damaged archive ends in almost anything
        raise Refusal(
            f"{path}: cannot be read as a record of {study.name} "
            f"({type(error).__name__}: {error}); {AGAIN}."
        ) from None
    if digest_of(arrays, json.dumps(plain)) != digest:
        raise Refusal(f"{path}: holds other values than were written; {AGAIN}.")
    found, wanted = Origin.of(content), _origin(study, part.name, case, needed or {})
    if needed is None:
        found = replace(found, sources=())
    place = _task(study, path.parent.name, path.stem)
    if departure := found.departure(replace(wanted, task=place)):
        raise Refusal(f"{path}: was made {departure}; {AGAIN}.")
    return Record(part.name, case, result | arrays if arrays else result, cost, digest)


def read_records(study: Study, folder: str | Path) -> Records:
    """All records of a study in its folder.

    Raises
    ------
    Refusal
        If one does not count, see `read_record`.
    """
    found: Records = {part.name: {} for part in study.parts}
    for part in study.parts:
        for case in part.cases:
            path = Path(folder, part.files(case_name(case))[0])
            record = read_record(study, path, needed_records(part, case, found))
            found[part.name][case] = record
    return found


def stale_results(study: Study, folder: str | Path) -> Iterator[Stale]:
    """Go through those results in the folder of a study that are there but do not count."""
    folder, found = Path(folder), {part.name: {} for part in study.parts}
    for part in study.parts:
        for case in part.cases:
            path = folder / part.files(case_name(case))[0]
            try:
                needed = needed_records(part, case, found)
                found[part.name][case] = read_record(study, path, needed)
            except KeyError:
                continue  # made again with what it needs
            except Refusal as problem:
                if os.path.lexists(path):
                    yield Stale.refused(path, problem)
    shown = [folder / name for name in study.outputs()]
    if all(len(found[part.name]) == len(part.cases) for part in study.parts):
        other = outdated(folder, _presented_origin(study, found), shown)
    else:
        other = {path: "was made from other records" for path in shown if path.is_file()}
    yield from (Stale(path, reason) for path, reason in other.items())


def needed_records(part: Part, case: Case, found: Records) -> Records:
    """The records that a case takes; KeyError if one is not there."""
    return {
        name: {other: found[name][other] for other in cases(case)}
        for name, cases in part.needs.items()
    }


def _origin(study: Study, part: str, case: Case, needed: Records) -> Origin:
    return Origin(_task(study, part, case_name(case)), study.part(part).code, _digests(needed))


def _task(study: Study, part: str, case: str) -> str:
    return json.dumps({"study": study.name, "part": part, "case": case})


def _presented_origin(study: Study, records: Records) -> Origin:
    return Origin(json.dumps(dict(study.shown_by)), study.presenting_code, _digests(records))


def _digests(records: Records) -> tuple[str, ...]:
    return tuple(record.digest for cases in records.values() for record in cases.values())


def present(study: Study, folder: str | Path) -> None:
    """Write tables and figures of the records in a folder, and what each record has cost."""
    from foilstudy.plot.save import save  # matplotlib

    records = read_records(study, folder)
    findings = study.findings(records)
    contents = {name: table(findings) for name, table in study.tables.items()}
    for name, content in (contents | {"costs.csv": _costs(records)}).items():
        with written_whole(Path(folder, name)) as partial:
            text = content if isinstance(content, str) else csv_text(content)
            partial.write_text(text, encoding="utf-8")
    for stem, draw in study.figures.items():
        save(draw(findings), Path(folder, stem))
    shown = [Path(folder, name) for name in study.outputs()]
    write_manifest(Path(folder), _presented_origin(study, records), shown)


def problems(study: Study, folder: str | Path) -> list[str]:
    """A sentence for each demand that the records in a folder miss."""
    return list(study.problems(study.findings(read_records(study, folder))))


def _costs(records: Records) -> list[dict]:
    return [
        {"part": part, "case": case_name(case)} | asdict(record.cost)
        for part, cases in records.items()
        for case, record in cases.items()
    ]
