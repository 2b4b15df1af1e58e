"""Where the results of a study lie, from which all that is shown of it is made."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path


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
    """

    cube_path: Path
    crumple_paths: tuple[Path, ...] = ()

    @classmethod
    def found(cls, cube_path: Path) -> StudyFiles:
        """Files of a study as they lie in its folder.

        Records count if crumple and response of every realisation of the cube are there: a picture
        of a part of the study would pass for the whole.
        """
        files = cls(cube_path)
        crumples = tuple(
            files.folder / "realisations" / cell / "crumple.nc" for cell in files._cells()
        )
        complete = all(
            path.exists() and path.with_name("response.nc").exists() for path in crumples
        )
        return cls(cube_path, crumples if complete else ())

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

    def table(self, name: str) -> Path:
        """Path of a table, named as in `foilstudy.present.statistics.tables.TABLES`."""
        return self.folder / f"{name}.csv"

    def _cells(self):
        """Paths of the realisations of the cube below ``realisations``."""
        from foilstudy.config.model import overlength_id, thickness_id

        for thickness in self.cube["thickness"].values:
            for height in self.cube["reference_height"].values:
                for seed in self.cube["seed"].values:
                    yield Path(
                        thickness_id(float(thickness)), overlength_id(float(height)), str(seed)
                    )
