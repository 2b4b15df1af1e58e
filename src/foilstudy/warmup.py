"""Compile every numba kernel once, so that parallel jobs only read the cache."""

from __future__ import annotations

import tempfile
from pathlib import Path

from foilstudy.config import load_config
from foilstudy.outcome import USABLE


def compile_kernels() -> None:
    """Run one very small realisation from end to end.

    Raises
    ------
    RuntimeError
        If that realisation fails.
    """
    from foilstudy.realisation.crumple import crumple
    from foilstudy.realisation.record import read_record
    from foilstudy.realisation.respond import respond

    study = load_config(
        {
            "study": {"name": "warmup"},
            "sweep": {"thickness_um": [500], "reference_height_mm": [150], "realisations": 1},
            "mesh": {"element_size_mm": 15},
            "relaxation": {"ramp_steps": 200},
            "dynamics": {"shown_max_hz": 50},
        }
    )
    (cell,) = study.cells()
    with tempfile.TemporaryDirectory() as folder:
        paths = Path(folder) / "crumple.nc", Path(folder) / "response.nc"
        crumple(study.crumple_task(cell), paths[0])
        respond(study.response_task(cell), *paths)
        _, attributes = read_record(paths[1])
    if attributes["status"] not in USABLE:
        raise RuntimeError(f"the kernels do not work on this machine: {attributes['message']}")
