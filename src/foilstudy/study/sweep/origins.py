"""What each record of a study is made of, and which code decides it.

Of strategies, elements and the like only what the task of a record chooses counts as its code.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from foilstudy.base.errors import Refusal
from foilstudy.base.fingerprint import Code, fingerprint_of_files
from foilstudy.base.origin import Origin
from foilstudy.base.record import AGAIN, read_record
from foilstudy.config import Cell, CrumpleTask, RefineTask, ResponseTask, StudyConfig
from foilstudy.config.choices import choices_of
from foilstudy.export.formats import FORMATS

_CRUMPLING = (
    "config.foils",
    "config.installation",
    "config.scene",
    "linalg",
    "model",
    "solve",
    "measure.localisation",
    "measure.verdicts",
    "pipeline.crumple",
    "pipeline.crumpled",
    "pipeline.evidence",
    "pipeline.method",
    "pipeline.rest",
    "pipeline.retry",
    "pipeline.shape",
    "base.spec",
    "study.sweep.outcome",
)
_MEASURING = (*_CRUMPLING, "measure", "pipeline")

# a task says all constants of its material, by which name they were ever found
_TABLE = ("model.material_table",)

CRUMPLE = Code(("study.sweep.crumple",), _CRUMPLING, _TABLE)
RESPONSE = Code(("study.sweep.respond",), _MEASURING, _TABLE)
# relaxing takes no dynamics, and its task says nothing of them
REFINED = Code(
    ("study.sweep.relax_refined",), _MEASURING, (*_TABLE, "measure.air", "measure.dynamics")
)
# its task says `auto`, and not the size that comes of it
CYLINDER = Code(("study.sweep.cylinder", "config.mesh"), _MEASURING, _TABLE)
CUBE = Code(
    ("study.sweep.cube", "config.model"),
    ("study.sweep.quantities", "study.sweep.rounds", "base.confidence"),
)
EXPORT = Code(("study.sweep.export",), (*_MEASURING, "export"), _TABLE)

PRESENTING = Code(
    ("present.jobs",),
    (
        "base",
        "config",
        "measure",
        "model",
        "plot",
        "present",
        "study.sweep.expected",
        "study.sweep.rounds",
    ),
)
_TEMPLATES = ("base/data", "present/report/templates")
"""What decides how a cube is shown, beside sources."""

_FOIL = ("sheet", "material", "specimen", "thickness_um", "reference_height_mm", "seed")
"""Sections of a task that name the realisation."""


def remember_codes() -> None:
    """Read all code as it is now, for this process and its children, whatever a task chooses.

    A job that began with the code of before an edit may end after it.
    """
    for code in (CRUMPLE, RESPONSE, REFINED, CYLINDER, CUBE, EXPORT):
        code.fingerprint()
    presented_origin({})


def physics_codes(study: StudyConfig) -> dict[str, str]:
    """Fingerprints of what crumples and of what measures, by the names of a cube's attributes."""
    cell = study.cells()[0]
    crumple = study.crumple_task(cell)
    return {
        "crumple_code": _crumple_code(crumple),
        "response_code": _code(RESPONSE, study.response_task(cell), crumple),
    }


def _code(
    code: Code,
    task: RefineTask | ResponseTask,
    crumple: CrumpleTask | None,
    formats: tuple[str, ...] = (),
) -> str:
    """Fingerprint for a task that goes on with a crumple; of all code if that is not known."""
    if crumple is None:
        return code.fingerprint()
    chosen = choices_of(task, crumple) | {FORMATS.kind: formats}
    return code.choosing(chosen).fingerprint()


def _crumple_code(task: CrumpleTask | None) -> str:
    return (CRUMPLE.choosing(choices_of(task)) if task else CRUMPLE).fingerprint()


def _recorded(crumple: Mapping[str, Any]) -> CrumpleTask | None:
    """Task of a crumple by the attributes of its record; None if it is of another release."""
    try:
        return CrumpleTask.model_validate_json(crumple["task"])
    except ValidationError:
        return None


def cell_folder(results: Path, cell: Cell) -> Path:
    """Where the records of a realisation lie in the folder of a study."""
    return results / "realisations" / cell.thickness_id / cell.overlength_id / str(cell.seed)


def crumple_origin(task: CrumpleTask) -> Origin:
    """Of a ``crumple.nc``."""
    return Origin(task.model_dump_json(), _crumple_code(task))


def response_origin(task: ResponseTask, crumple: Mapping[str, Any]) -> Origin:
    """Of a ``response.nc``; `crumple` are the attributes of the crumple's record."""
    code = _code(RESPONSE, task, _recorded(crumple))
    return Origin(task.model_dump_json(), code, (crumple["digest"],))


def refined_origin(task: RefineTask, crumple: Mapping[str, Any]) -> Origin:
    """Of a ``refined.nc``; `crumple` are the attributes of the crumple's record."""
    code = _code(REFINED, task, _recorded(crumple))
    return Origin(task.model_dump_json(), code, (crumple["digest"],))


def cylinder_origin(study: StudyConfig) -> Origin:
    """Of a ``cylinder.nc``."""
    chosen = choices_of(study.sheet, study.material, study.sweep, study.mesh)
    return Origin(study.cylinder_task(), CYLINDER.choosing(chosen).fingerprint())


def parts_of(study: StudyConfig) -> tuple[str, ...]:
    """Records of each realisation, by the names of their files."""
    again = study.stiffness.relaxed_refinements > 0
    return ("crumple", "response", "refined")[: 2 + again]


def cube_origin(study: StudyConfig, digests: Mapping[str, np.ndarray], cylinder: str) -> Origin:
    """Of a ``cube.nc``.

    Parameters
    ----------
    digests : mapping of str to array of str
        Of the records of all realisations, by `parts_of`.
    cylinder : str
        Of ``cylinder.nc``.
    """
    summary = sha256(cylinder.encode())
    for found in digests.values():
        for digest in np.ravel(found):
            summary.update(f" {digest}".encode())
    return Origin(study.model_dump_json(), CUBE.fingerprint(), (summary.hexdigest()[:16],))


def presented_origin(cube: Mapping[str, Any]) -> Origin:
    """Of tables, figures and page; `cube` are the attributes of the cube."""
    code = f"{PRESENTING.fingerprint()} {fingerprint_of_files(*_TEMPLATES)}"
    # the cube of a release before 0.4 has none
    return Origin(code=code, sources=tuple(filter(None, [cube.get("digest")])))


def export_origin(
    task: ResponseTask, crumple: Mapping[str, Any], formats: tuple[str, ...]
) -> Origin:
    """Of an export folder."""
    content = task.model_dump(mode="json") | {"formats": list(formats)}
    code = _code(EXPORT, task, _recorded(crumple), formats)
    return Origin(json.dumps(content), code, (crumple["digest"],))


def read_crumple(
    path: Path, task: RefineTask | ResponseTask
) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Values and attributes of the crumple that a task goes on with.

    Raises
    ------
    Refusal
        If the record is unreadable, of another foil or seed, or made by other code.
    """
    values, attributes = read_record(path)
    code = _crumple_code(_recorded(attributes))
    wanted = Origin(_named(task.model_dump_json()), code)
    refuse_departure(path, Origin(_named(attributes["task"]), attributes["code"]), wanted)
    return values, attributes


def refuse_departure(path: Path, found: Origin, wanted: Origin) -> None:
    """See that a record is what is wanted.

    Raises
    ------
    Refusal
        Naming file, difference and remedy.
    """
    if departure := found.departure(wanted):
        raise Refusal(f"{path}: was made {departure}; {AGAIN}.")


def _named(task: str) -> str:
    content = json.loads(task)
    return json.dumps({name: content.get(name) for name in _FOIL})
