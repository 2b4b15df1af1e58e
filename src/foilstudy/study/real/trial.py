"""One foil by one model: the jobs of a study, and what is kept of their records."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from foilstudy.base.record import read_record
from foilstudy.config import load_config
from foilstudy.config.sources import merged
from foilstudy.study.real.settings import Sections, Trial, ladder
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.respond import respond_job

_LARGEST = 64
"""Numbers of a quantity that is kept: stiffness of all kinds, no shapes and no histories."""


def measure(trial: Trial, study: str) -> dict:
    """Crumple the foil and measure its stiffness, as in a study of its own.

    Parameters
    ----------
    trial : Trial
        One foil.
    study : str
        Side study whose models it is one of.

    Returns
    -------
    dict
        ``status`` and ``message``, and by their names in the records all quantities of a few
        numbers.
    """
    configured = load_config(_configured(trial, ladder(study).sections_of(trial.step)))
    cell = configured.cells()[trial.seed]
    with tempfile.TemporaryDirectory() as folder:
        crumple, response = Path(folder) / "crumple.nc", Path(folder) / "response.nc"
        crumple_job(configured.crumple_task(cell), crumple)
        respond_job(configured.response_task(cell), crumple, response)
        shape, _ = read_record(crumple)
        measured, outcome = read_record(response)
    values = {
        name: np.asarray(value, float).tolist()
        for name, value in {**shape, **measured}.items()
        if np.size(value) <= _LARGEST and not name.startswith("history_")
    }
    return {"status": outcome["status"], "message": outcome["message"], **values}


def _configured(trial: Trial, sections: Sections) -> Sections:
    """A study of this foil alone, its realisations up to that of the trial."""
    sweep = {
        "thickness_um": [trial.thickness_um],
        "reference_height_mm": [trial.height_mm],
        "realisations": trial.seed + 1,
    }
    return merged([sections, {"study": {"name": "trial"}, "sweep": sweep}])
