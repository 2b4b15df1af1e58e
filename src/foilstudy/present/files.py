"""Where the results of a study lie, from which all that is shown of it is made."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.record import read_attributes
from foilstudy.config.model import overlength_id, thickness_id
from foilstudy.present.statistics.cells import realised

if TYPE_CHECKING:
    from foilstudy.present.measured_files import MeasuredFile

CELL = ("thickness", "overlength", "seed")
_UNKNOWN = "in a cube of a release before 0.4"


@dataclass(frozen=True)
class StudyFiles:
    """Files of one study; none is opened without need.

    Attributes
    ----------
    cube_path : Path
        The study's ``cube.nc``. Tables, figures, page and the workflow's benchmark tables have
        their places beside it.
    crumple_paths : tuple of Path
        ``crumple.nc`` of the realisations. The response of a realisation lies beside its crumple.
    left_out : frozenset of str
        Ids of figures that the page does not show though there may be a picture of that name.
    measured : tuple of MeasuredFile
        Measurements that the page puts beside the simulated realisations.
    """

    cube_path: Path
    crumple_paths: tuple[Path, ...] = ()
    left_out: frozenset[str] = frozenset()
    measured: tuple[MeasuredFile, ...] = ()

    @classmethod
    def found(cls, cube_path: Path) -> StudyFiles:
        """Files of a study as they lie in its folder.

        Records count if those of every realisation are there, and are the ones that the cube was
        gathered from: a picture of a part of the study, or of another, would pass for the whole.
        """
        files = cls(cube_path)
        crumples = tuple(files._gathered())
        return cls(cube_path, () if None in crumples else crumples)

    @cached_property
    def cube(self):
        """The cube, see `foilstudy.open_cube`."""
        from foilstudy.base.cube import open_cube

        return open_cube(self.cube_path)

    @property
    def folder(self) -> Path:
        """Folder of the study."""
        return Path(self.cube_path).parent

    @property
    def figures(self) -> Path:
        """Folder of the figures."""
        return self.folder / "figures"

    @property
    def benchmarks(self) -> Path:
        """Folder of the workflow's benchmark tables."""
        return self.folder / "benchmarks"

    @property
    def response_paths(self) -> tuple[Path, ...]:
        """``response.nc`` of those realisations that have one."""
        beside = (Path(crumple).with_name("response.nc") for crumple in self.crumple_paths)
        return tuple(path for path in beside if path.exists())

    @property
    def page(self) -> Path:
        """The report."""
        return self.folder / "report.html"

    def table(self, name: str) -> Path:
        """Path of a table, named as in `foilstudy.present.statistics.tables.TABLES`."""
        return self.folder / f"{name}.csv"

    def _gathered(self) -> Iterator[Path | None]:
        """Crumples of the realisations of the cube; None for one that is not as gathered."""
        for at in np.argwhere(realised(self.cube).to_numpy()):
            cell = self.cube.isel(dict(zip(CELL, at, strict=True)))
            thickness, height = float(cell["thickness"]), float(cell["reference_height"])
            place = thickness_id(thickness), overlength_id(height), str(int(cell["seed"]))
            folder = Path(self.folder, "realisations", *place)
            there = all(
                _digest(folder / f"{part}.nc") == cell.get(f"{part}_digest", _UNKNOWN)
                for part in ("crumple", "response")
            )
            yield folder / "crumple.nc" if there else None


def _digest(path: Path) -> str | None:
    try:
        return read_attributes(path)["digest"]
    except Refusal:
        return None
