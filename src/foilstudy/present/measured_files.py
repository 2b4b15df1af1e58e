"""Which measurements stand on the page of a study: named in its configuration, or by hand.

Cheap to import, as the workflow asks before every run.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Self

from foilstudy.base.errors import Refusal
from foilstudy.base.manifest import noted
from foilstudy.bench.comparison import Comparison, Configuration, simulated
from foilstudy.bench.measured import read_response
from foilstudy.config import StudyConfig
from foilstudy.study.stale import Stale

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["MeasuredFile", "measured_of", "noted_files", "notes_of", "stale_page"]

_NOTE = "measured"
"""Key of what the page shows in the manifest."""


@dataclass(frozen=True)
class MeasuredFile:
    """Where a measured response lies, and what it is of.

    Attributes
    ----------
    path : Path
    configuration : Configuration
    function : str or None
        Part of the name of the response, where the file holds several.
    """

    path: Path
    configuration: Configuration
    function: str | None = None

    @classmethod
    def of(
        cls,
        path: Path,
        thickness_um: float | None,
        height_mm: float | None,
        direction: str = "axial",
        definition: str = "transfer",
        function: str | None = None,
    ) -> Self:
        """By plain values."""
        return cls(path, Configuration(thickness_um, height_mm, direction, definition), function)

    def note(self) -> dict[str, object]:
        """What a manifest holds of it."""
        from hashlib import sha256

        own = {"file": str(self.path), "function": self.function} | asdict(self.configuration)
        return own | {"sha256": sha256(self.path.read_bytes()).hexdigest()}

    def beside(self, cube: xr.Dataset) -> Comparison:
        """The measurement with the realisations of its configuration.

        Raises
        ------
        Refusal
            If the file cannot be read, or the cube does not have the configuration.
        """
        response = read_response(self.path, self.function)
        return Comparison.of(response, simulated(cube, self.configuration))


def measured_of(study: StudyConfig, folder: Path = Path()) -> tuple[MeasuredFile, ...]:
    """The measurements that a configuration names, with paths from the folder of its run.

    Raises
    ------
    Refusal
        If one is not there or cannot be read.
    """
    found = []
    for i, run in enumerate(study.report.measured):
        values = run.model_dump()
        file = MeasuredFile.of(folder / values.pop("file"), **values)
        try:
            read_response(file.path, file.function)
        except Refusal as problem:
            raise Refusal(f"report.measured[{i}].file: {problem}") from None
        found.append(file)
    return tuple(found)


def notes_of(measured: Sequence[MeasuredFile]) -> dict[str, object]:
    """What the manifest says of the measurements on a page; nothing of none."""
    return {_NOTE: [each.note() for each in measured]} if measured else {}


def noted_files(folder: Path) -> tuple[MeasuredFile, ...]:
    """The measurements that the page in a folder shows, by its manifest."""
    found = []
    for note in noted(folder).get(_NOTE, ()):
        values = {key: note[key] for key in ("thickness_um", "height_mm", "direction")}
        values |= {key: note[key] for key in ("definition", "function")}
        found.append(MeasuredFile.of(Path(note["file"]), **values))
    return tuple(found)


def stale_page(study: StudyConfig, page: Path) -> Iterator[Stale]:
    """The page of a study, if it shows other measurements than are to be there now."""
    shown = noted(page.parent).get(_NOTE, [])
    if page.is_file() and shown != notes_of(measured_of(study)).get(_NOTE, []):
        yield Stale(page, "shows other measurements")
