"""Tables, figures and page of a study from its cube, without any physics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import chain
from pathlib import Path

from foilstudy.base.cube import CONTENT, verified_attributes
from foilstudy.base.manifest import noted_origin, outdated
from foilstudy.present.figures import FIGURES, FigureSpec, draw_figures
from foilstudy.present.files import StudyFiles
from foilstudy.present.measured_files import MeasuredFile, noted_files
from foilstudy.present.report import write_report
from foilstudy.present.shown import note_origin
from foilstudy.present.statistics.tables import write_tables
from foilstudy.study.sweep.origins import presented_origin


@dataclass(frozen=True)
class Redrawn:
    """What `redraw` has made.

    Attributes
    ----------
    written : list of Path
        Tables, figures and page.
    kept : list of str
        Ids of the figures that need records which are not there, or not those of the cube, and
        whose picture of before stands in the page.
    left_out : list of str
        Ids of those that had no picture of this cube.
    """

    written: list[Path]
    kept: list[str]
    left_out: list[str]


def redraw(results: str | Path, measured: Sequence[MeasuredFile] | None = None) -> Redrawn:
    """Write the tables, figures and page of a study anew.

    Parameters
    ----------
    results : str or Path
        Folder of a study, ``results/NAME``, or its ``cube.nc``. Figures of shapes, histories and
        modes need the records of all its realisations, ``realisations/*/*/*/crumple.nc`` and
        ``response.nc`` beside them, those that the cube was gathered from.
    measured : sequence of MeasuredFile, optional
        What was measured of its configurations, to stand beside them on the page; those that the
        page shows already, if left out.

    Raises
    ------
    Refusal
        If there is no cube, if it is not one of this package, or if it was altered; or if a
        measurement cannot be read or has no place in it.
    """
    results = Path(results)
    files = StudyFiles.found(results / "cube.nc" if results.is_dir() else results)
    if CONTENT in files.cube.attrs:  # from release 0.4 on
        verified_attributes(files.cube_path)
    for each in measured or ():
        each.beside(files.cube)  # refused before anything is written
    if measured is None:
        measured = noted_files(files.folder)
    drawn = [name for name, figure in FIGURES.items() if _can_be_drawn(figure, files)]
    missing = [name for name in FIGURES if name not in drawn]
    kept = {name: paths for name in missing if (paths := _of_this_cube(files, name))}
    left_out = [name for name in missing if name not in kept]
    files = replace(files, left_out=frozenset(left_out), measured=tuple(measured))
    written = write_tables(files.cube, files.folder)
    written += draw_figures(drawn, files, files.figures)
    written.append(write_report(files, files.page))
    note_origin(files, [*written, *chain.from_iterable(kept.values())])
    return Redrawn(written, list(kept), left_out)


def _of_this_cube(files: StudyFiles, name: str) -> list[Path]:
    """Pictures of a figure that were drawn for the cube as it is, by whatever code."""
    pictures = sorted(files.figures.glob(f"{name}.*"))
    origin = replace(presented_origin(files.cube.attrs), code=noted_origin(files.folder).code)
    other = outdated(files.folder, origin, pictures)
    return [path for path in pictures if path not in other]


def _can_be_drawn(figure: FigureSpec, files: StudyFiles) -> bool:
    return figure.needs == ("cube",) or bool(files.crumple_paths)
