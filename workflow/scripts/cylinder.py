"""Stiffness of the uncrumpled cylinders of a study: cylinder.py STUDY_JSON CYLINDER_NC."""

import sys
from pathlib import Path

from foilstudy.config import StudyConfig
from foilstudy.study.sweep.cylinder import cylinder_bounds

study_json, cylinder_nc = sys.argv[1:]
cylinder_bounds(StudyConfig.model_validate_json(study_json), Path(cylinder_nc))
