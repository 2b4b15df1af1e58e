"""A measurement from a file beside the simulated realisations of its configuration, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Self

import numpy as np
import xarray as xr

from foilstudy.base.errors import Refusal
from foilstudy.base.manifest import noted
from foilstudy.base.numerals import percent, plural
from foilstudy.bench.comparison import Comparison, Configuration, simulated
from foilstudy.bench.figure import draw, drawn
from foilstudy.bench.measured import read_response
from foilstudy.config import StudyConfig
from foilstudy.study.stale import Stale

__all__ = [
    "MeasuredFile",
    "draw",
    "drawn",
    "findings",
    "measured_of",
    "notes_of",
    "noted_files",
    "stale_page",
    "title_of",
]

_NOTE = "measured"
"""Key of what the page shows in the manifest."""

_RUNS_MAX = 8


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


def measured_of(study: StudyConfig) -> tuple[MeasuredFile, ...]:
    """The measurements that a configuration names.

    Raises
    ------
    Refusal
        If one is not there or cannot be read.
    """
    found = []
    for i, run in enumerate(study.report.measured):
        values = run.model_dump()
        file = MeasuredFile.of(Path(values.pop("file")), **values)
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


def title_of(comparison: Comparison) -> str:
    """Which configuration and stiffness it is of."""
    own = comparison.simulated
    return (
        f"{own.thickness_um:g} um, {own.height_mm:g} mm ({own.overlength_percent:.3g} %), "
        f"{own.direction} {own.definition} stiffness"
    )


def findings(comparison: Comparison) -> Iterator[tuple[str, str]]:
    """What it shows: pairs of a word and what is said of it, the word empty where it goes on."""
    measured, own = comparison.measured, comparison.simulated
    low, high = measured.frequencies[[0, -1]]
    share = float((~measured.trusted).mean())
    doubt = f", {percent(share)} of them with a coherence below 0.95" if share else ""
    if np.isnan(measured.coherence).all():
        doubt = ", their coherence unknown"
    yield "compared", f"{plural(measured.values.size, 'value')} from {low:g} to {high:g} Hz{doubt}"
    if comparison.static is None:
        yield "static", "not measured: no value of enough coherence from 1 to 10 Hz"
    else:
        found = comparison.static
        yield "measured", f"{_interval(found.value, found.low, found.high)}, mean of 1 to 10 Hz"
    mean = own.static
    yield (
        "simulated",
        f"{_interval(mean.mean, mean.low, mean.high)}, mean static stiffness of "
        f"{plural(mean.n, 'realisation')}",
    )
    if not measured.trusted.any():
        yield "not compared", "no value of enough coherence in the whole band"
        return
    if comparison.static is not None:
        yield "ratio", f"{comparison.static.value / mean.mean:.3g} measured over simulated, static"
    word = "" if comparison.static is not None else "ratio"
    yield word, f"{comparison.ratio:.3g} over all frequencies, median"
    least, most = comparison.frac_range
    yield "FRAC", f"{comparison.frac:.3f} with the median, {least:.3f} to {most:.3f} with one each"
    outside = float((comparison.excursion != 1).mean())
    yield "outside", f"{percent(outside)} of the values leave the band of the realisations"
    runs = sorted(comparison.excursions, key=lambda run: run.low_hz - run.high_hz)[:_RUNS_MAX]
    for run in sorted(runs, key=lambda run: run.low_hz):
        side = "above" if run.above else "below"
        yield "", f"{run.low_hz:g} to {run.high_hz:g} Hz: {side}, by up to {run.factor:.3g} times"
    if (more := len(comparison.excursions) - len(runs)) > 0:
        yield "", f"and {plural(more, 'shorter run')}"


def _interval(value: float, low: float, high: float) -> str:
    """With its 95 % interval where that is known."""
    text = f"{_four_digits(value)} N/m"
    if not (math.isfinite(low) and math.isfinite(high)):
        return f"{text}, interval unknown"
    return f"{text} (95 %: {_four_digits(low)} to {_four_digits(high)})"


def _four_digits(value: float) -> str:
    return f"{float(f'{value:.4g}'):g}"
