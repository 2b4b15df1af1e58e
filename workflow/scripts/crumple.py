"""Crumple one realisation: crumple.py TASK_JSON CRUMPLE_NC."""

import sys
from pathlib import Path

from foilstudy.config import CrumpleTask
from foilstudy.study.sweep.crumple import crumple_job

task_json, crumple_nc = sys.argv[1:]
crumple_job(CrumpleTask.model_validate_json(task_json), Path(crumple_nc))
