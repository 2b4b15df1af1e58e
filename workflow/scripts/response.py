"""Stiffness of one crumpled realisation: response.py TASK_JSON CRUMPLE_NC RESPONSE_NC."""

import sys
from pathlib import Path

from foilstudy.config import ResponseTask
from foilstudy.study.sweep.respond import respond_job

task_json, crumple_nc, response_nc = sys.argv[1:]
respond_job(ResponseTask.model_validate_json(task_json), Path(crumple_nc), Path(response_nc))
