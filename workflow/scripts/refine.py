"""Relax a crumple again on refined meshes: refine.py TASK_JSON CRUMPLE_NC REFINED_NC."""

import sys
from pathlib import Path

from foilstudy.config import RefineTask
from foilstudy.study.sweep.relax_refined import refine_job

task_json, crumple_nc, refined_nc = sys.argv[1:]
refine_job(RefineTask.model_validate_json(task_json), Path(crumple_nc), Path(refined_nc))
