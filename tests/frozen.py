"""Numbers that must not move: four cells as they were before the code was rearranged.

``reference/*.json`` hold every number of their records: single numbers as hexadecimal floats,
arrays as digest, size and norm. On the processor that made them they must come out to the last
bit. On another one the last bits of a force differ and a crumple, which is chaotic, with them; so
there the stiffness of a kept shape is held to 1e-9 instead (``reference/shape.npz``).
"""

from __future__ import annotations

import hashlib
import json
import sys
from pathlib import Path

import numpy as np

from foilstudy.config import load_config

FOLDER = Path(__file__).parent / "reference"
_COSTS = ("seconds_", "peak_memory")

COMMON = {
    "mesh": {"element_size_mm": 10},
    "relaxation": {"ramp_steps": 1000},
    "stiffness": {"refinements": 1, "relaxed_refinements": 1},
    "dynamics": {"shown_max_hz": 200, "frequencies": 20, "eigenfrequencies": 5},
}
CELLS = {
    "t500um_h170mm_corner_krylov": (500, 170, "corner", "rational_krylov"),
    "t500um_h150mm_one_point_hintz_herting": (500, 150, "one_point", "hintz_herting"),
    "t50um_h150mm_corner_craig_bampton": (50, 150, "corner", "craig_bampton"),
    "t50um_h170mm_one_point_guyan": (50, 170, "one_point", "guyan"),
}


def study_of(name: str, **sections):
    """Configuration of a frozen cell."""
    thickness, height, element, reduction = CELLS[name]
    sweep = {"thickness_um": [thickness], "reference_height_mm": [height], "realisations": 1}
    content = {key: dict(value) for key, value in COMMON.items()} | {"sweep": sweep}
    content["mesh"]["element"] = element
    content["dynamics"]["reduction"] = reduction
    for key, value in sections.items():
        content[key] = content.get(key, {}) | value
    return load_config(content)


def frozen(values: dict, attributes: dict) -> dict:
    """A record as it is kept: exact, and small."""
    numbers = {name: _number(value) for name, value in sorted(values.items()) if not _is_cost(name)}
    return {"status": attributes.get("status", ""), "values": numbers}


def _is_cost(name: str) -> bool:
    return name.startswith(_COSTS)


def _number(value):
    value = np.asarray(value)
    if value.ndim == 0:
        return float(value).hex()
    value = np.where(np.isnan(value), np.nan, value)  # of all that count as such, one
    digest = hashlib.sha256(value.tobytes()).hexdigest()
    return {
        "shape": list(value.shape),
        "digest": digest,
        "norm": float(np.sqrt(np.nansum(value**2))),
    }


def processor() -> str:
    """What decides the last bits: the instruction set that numba compiles for, and the model."""
    import llvmlite.binding as llvm

    from foilstudy.base.provenance import machine

    model = machine().split(", ")[1]
    return f"{model}, {llvm.get_host_cpu_name()}"


def read(name: str) -> dict:
    """A kept reference."""
    return json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))


def write(name: str, content: dict) -> None:
    """Keep a reference; only where numbers are meant to change."""
    FOLDER.mkdir(exist_ok=True)
    text = json.dumps(content, indent=1)
    (FOLDER / f"{name}.json").write_text(text + "\n", encoding="utf-8")


def run(name: str, folder: Path) -> None:
    """Compute every record of a frozen cell."""
    from foilstudy.study.sweep.crumple import crumple_job
    from foilstudy.study.sweep.cylinder import cylinder_bounds
    from foilstudy.study.sweep.relax_refined import refine_job
    from foilstudy.study.sweep.respond import respond_job

    study = study_of(name)
    (cell,) = study.cells()
    crumple_job(study.crumple_task(cell), folder / "crumple.nc")
    respond_job(study.response_task(cell), folder / "crumple.nc", folder / "response.nc")
    refine_job(study.refine_task(cell), folder / "crumple.nc", folder / "refined.nc")
    cylinder_bounds(study, folder / "cylinder.nc")


if __name__ == "__main__":
    for cell_name in CELLS:
        run(cell_name, Path(sys.argv[1], cell_name))
