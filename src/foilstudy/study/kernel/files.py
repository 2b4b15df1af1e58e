"""Records of a side study, and the tables and figures made of them.

Everything of a study lies in its folder: a record ``PART/CASE.json`` per case, with large arrays in
``PART/CASE.npz`` beside it, then the tables, and every figure as PNG and SVG.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, is_dataclass
from pathlib import Path

import numpy as np

from foilstudy.base.costs import Cost, measured
from foilstudy.base.files import read_json, write_json, written_whole
from foilstudy.base.provenance import provenance
from foilstudy.base.tables import csv_text
from foilstudy.study.kernel.plan import Lazy, Record, Records, Study, case_name


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
    if isinstance(plan.measure, Lazy):
        plan.measure.load()  # which is no cost of the case
    with measured() as cost:
        result = plan.measure(plan.case(case), **records)
    record = Record(part, plan.case(case), asdict(result) if is_dataclass(result) else result, cost)
    write_record(study, record, path)
    return record


def write_record(study: Study, record: Record, path: str | Path) -> None:
    """Write a record as JSON, its arrays beside it."""
    path, keys, result = Path(path), study.part(record.part).arrays, record.result
    if keys:
        with written_whole(path.with_suffix(".npz")) as partial, partial.open("wb") as file:
            np.savez_compressed(file, **{key: result[key] for key in keys})
        result = {key: value for key, value in result.items() if key not in keys}
    head = {"study": study.name, "part": record.part, "case": case_name(record.case)}
    head["parameters"] = asdict(record.case) if is_dataclass(record.case) else {}
    write_json(head | provenance() | {"cost": asdict(record.cost), "result": result}, path)


def read_record(study: Study, path: str | Path) -> Record:
    """The record in a JSON file and the arrays beside it."""
    path = Path(path)
    content = read_json(path)
    part, result = study.part(content["part"]), content["result"]
    if part.arrays:
        with np.load(path.with_suffix(".npz")) as arrays:
            result |= dict(arrays)
    return Record(part.name, part.case(content["case"]), result, Cost(**content["cost"]))


def read_records(study: Study, folder: str | Path) -> Records:
    """All records of a study in its folder."""
    found: Records = {part.name: {} for part in study.parts}
    for record in (read_record(study, Path(folder, file)) for file in study.records()):
        found[record.part][record.case] = record
    return found


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


def problems(study: Study, folder: str | Path) -> list[str]:
    """A sentence for each demand that the records in a folder miss."""
    return list(study.problems(study.findings(read_records(study, folder))))


def _costs(records: Records) -> list[dict]:
    return [
        {"part": part, "case": case_name(case)} | asdict(record.cost)
        for part, cases in records.items()
        for case, record in cases.items()
    ]
