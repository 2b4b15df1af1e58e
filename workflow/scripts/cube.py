"""All realisations of a study in one cube: cube.py STUDY_JSON RESULTS CUBE_NC."""

import sys
from pathlib import Path

from foilstudy.config import StudyConfig
from foilstudy.study.sweep.cube import gather

study_json, results, cube_nc = sys.argv[1:]
gather(StudyConfig.model_validate_json(study_json), Path(results), Path(cube_nc))
