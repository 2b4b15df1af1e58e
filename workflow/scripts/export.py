"""One realisation for other tools: export.py TASK_JSON CRUMPLE_NC FOLDER FORMAT..."""

import sys
from pathlib import Path

from foilstudy.config import ResponseTask
from foilstudy.study.sweep.export import export_realisation

task_json, crumple_nc, folder, *formats = sys.argv[1:]
task = ResponseTask.model_validate_json(task_json)
export_realisation(task, Path(crumple_nc), Path(folder), formats)
