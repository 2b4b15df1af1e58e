"""Tables, figures and page of a study from its cube, without any physics."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from foilstudy.present.figures import FIGURES, FigureSpec, draw_figures
from foilstudy.present.files import StudyFiles
from foilstudy.present.report import write_report
from foilstudy.present.shown import note_origin
from foilstudy.present.statistics.tables import write_tables


@dataclass(frozen=True)
class Redrawn:
    """What `redraw` has made.

    Attributes
    ----------
    written : list of Path
        Tables, figures and page.
    kept : list of str
        Ids of the figures that need records which are not there, and whose picture of before
        stands in the page.
    left_out : list of str
        Ids of those that had no picture.
    """

    written: list[Path]
    kept: list[str]
    left_out: list[str]


def redraw(results: str | Path) -> Redrawn:
    """Write the tables, figures and page of a study anew.

    Parameters
    ----------
    results : str or Path
        Folder of a study, ``results/NAME``, or its ``cube.nc``. Figures of shapes, histories and
        modes need the records of all its realisations, ``realisations/*/*/*/crumple.nc`` and
        ``response.nc`` beside them, those that the cube was gathered from.

    Raises
    ------
    Refusal
        If there is no cube, or if it is not one of this package.
    """
    results = Path(results)
    files = StudyFiles.found(results / "cube.nc" if results.is_dir() else results)
    drawn = [name for name, figure in FIGURES.items() if _can_be_drawn(figure, files)]
    missing = [name for name in FIGURES if name not in drawn]
    kept = [name for name in missing if any(files.figures.glob(f"{name}.*"))]
    written = write_tables(files.cube, files.folder)
    written += draw_figures(drawn, files, files.figures)
    written.append(write_report(files, files.page))
    note_origin(files, written)
    return Redrawn(written, kept, [name for name in missing if name not in kept])


def _can_be_drawn(figure: FigureSpec, files: StudyFiles) -> bool:
    return figure.needs == ("cube",) or bool(files.crumple_paths)
