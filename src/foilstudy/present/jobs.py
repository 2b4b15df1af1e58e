"""The jobs that show a study, by names and paths alone, as the workflow calls them."""

# ruff: noqa: F401
from __future__ import annotations

from pathlib import Path

# What most figures load on first use; named here, a worker keeps it for the next of them.
import matplotlib.backends.backend_agg
import matplotlib.backends.backend_svg
import matplotlib.projections
import statsmodels.regression.linear_model
import xarray

import foilstudy.plot.render
from foilstudy.config import StudyConfig
from foilstudy.present.figures import draw_figures
from foilstudy.present.files import StudyFiles
from foilstudy.present.measured_files import measured_of
from foilstudy.present.report import write_report
from foilstudy.present.shown import note_origin, shown
from foilstudy.present.statistics.tables import write_tables


def tables(cube: Path) -> None:
    """Fitted laws and their spread as CSV, beside the cube."""
    write_tables(StudyFiles(cube).cube, cube.parent)


def figure(name: str, results: Path, *crumples: Path) -> None:
    """One figure as PNG and SVG."""
    files = StudyFiles(results / "cube.nc", crumples)
    draw_figures([name], files, files.figures)


def report(study: StudyConfig, page: Path, *crumples: Path) -> None:
    """The page of a study, beside its cube, and the manifest of all that is shown of it."""
    files = StudyFiles(page.with_name("cube.nc"), crumples, measured=measured_of(study))
    write_report(files, page)
    note_origin(files, shown(files))
