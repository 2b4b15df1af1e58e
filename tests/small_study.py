"""A study that was computed, as small as one can be, with stand-ins for all that is drawn of it."""

from foilstudy.config import load_config
from foilstudy.present.files import StudyFiles
from foilstudy.present.shown import note_origin, shown
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cube import gather
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.export import export_realisation
from foilstudy.study.sweep.origins import cell_folder
from foilstudy.study.sweep.respond import respond_job

SECTIONS = {
    "study": {"name": "small"},
    "sweep": {"thickness_um": [500], "reference_height_mm": [143, 150], "realisations": 2},
    "mesh": {"element_size_mm": 18},
    "relaxation": {"ramp_steps": 100},
    "stiffness": {"refinements": 0},
    "dynamics": {"shown_max_hz": 50, "frequencies": 4, "eigenfrequencies": 2},
    "export": {"formats": ["npz"]},
}


def sections_with(**changes):
    """Its configuration with some keys set otherwise."""
    return {n: SECTIONS.get(n, {}) | changes.get(n, {}) for n in {**SECTIONS, **changes}}


def compute(folder):
    """Do all jobs of the study in the order of the workflow, but for the drawing."""
    study = load_config(SECTIONS)
    for cell in study.cells():
        place = cell_folder(folder, cell)
        crumple_job(study.crumple_task(cell), place / "crumple.nc")
        task = study.response_task(cell)
        respond_job(task, place / "crumple.nc", place / "response.nc")
        export_realisation(task, place / "crumple.nc", place / "export", *study.export.formats)
    cylinder_bounds(study, folder / "cylinder.nc")
    gather(study, folder, folder / "cube.nc")
    files = StudyFiles(folder / "cube.nc")
    for path in shown(files):
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"stand-in for {path.name}")
    note_origin(files, shown(files))
    return folder
