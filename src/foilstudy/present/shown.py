"""All that is shown of a study, and the manifest that says what it was made of."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from foilstudy.base.manifest import write_manifest
from foilstudy.present.figures import FIGURES
from foilstudy.present.files import StudyFiles
from foilstudy.present.measured_files import notes_of
from foilstudy.present.statistics.tables import TABLES
from foilstudy.study.sweep.origins import presented_origin

__all__ = ["note_origin", "shown"]


def shown(files: StudyFiles) -> list[Path]:
    """Where tables, figures and page of a study lie, whether or not they are there."""
    tables = [files.table(name) for name in TABLES]
    figures = [files.figures / f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")]
    return [*tables, *figures, files.page]


def note_origin(files: StudyFiles, paths: Iterable[Path]) -> None:
    """Put down that these files were made of the cube as it is, by the code as it is."""
    origin = presented_origin(files.cube.attrs)
    write_manifest(files.folder, origin, paths, notes_of(files.measured))
