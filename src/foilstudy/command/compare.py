"""`foilstudy compare`: a measured dynamic stiffness beside the simulated ones."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from foilstudy.bench.comparison import Comparison

__all__ = ["compare"]

_RUNS_MAX = 8


def compare(
    file: Path,
    cube: Path,
    /,
    *,
    thickness: float | None = None,
    height: float | None = None,
    direction: str = "axial",
    definition: str = "transfer",
    function: str | None = None,
    output: Path | None = None,
) -> None:
    """Put a measured dynamic stiffness beside the simulated band of its configuration.

    Parameters
    ----------
    file : Path
        CSV, MAT or Universal File (dataset 58) of dynamic stiffness, receptance or accelerance,
        its units stated; docs/bench.md says how.
    cube : Path
        The cube.nc of a study, or its folder results/NAME.
    thickness : float
        Of the foil, um; may be left out where the cube has one.
    height : float
        Of the uncrumpled cylinder, mm; likewise.
    direction : str
        axial or radial.
    definition : str
        transfer, driving or relative.
    function : str
        Part of the name of the response, where FILE holds several.
    output : Path
        Picture, as PNG and SVG; else beside FILE, with -compared behind its name.
    """
    from foilstudy.base.cube import open_cube
    from foilstudy.bench.comparison import Comparison, Configuration, simulated
    from foilstudy.bench.figure import drawn
    from foilstudy.bench.measured import read_response

    measured = read_response(file, function)
    wanted = Configuration(thickness, height, direction, definition)
    values = open_cube(cube / "cube.nc" if cube.is_dir() else cube)
    comparison = Comparison.of(measured, simulated(values, wanted))
    title = _title(comparison)
    print("\n".join([f"{file}: {title}", *(f"{n:12} {text}" for n, text in _lines(comparison))]))
    stem = output.with_suffix("") if output else file.with_name(f"{file.stem}-compared")
    for path in drawn(comparison, title, stem):
        print(f"wrote {path}")


def _title(comparison: Comparison) -> str:
    own = comparison.simulated
    return (
        f"{own.thickness_um:g} um, {own.height_mm:g} mm ({own.overlength_percent:.3g} %), "
        f"{own.direction} {own.definition} stiffness"
    )


def _lines(comparison: Comparison) -> Iterator[tuple[str, str]]:
    from foilstudy.base.numerals import percent, plural

    measured, own = comparison.measured, comparison.simulated
    low, high = measured.frequencies[[0, -1]]
    share = float((~measured.trusted).mean())
    doubt = f", {percent(share)} of them with a coherence below 0.95" if share else ""
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
    if comparison.static is not None:
        yield "ratio", f"{comparison.static.value / mean.mean:.3g} measured over simulated, static"
    yield "", f"{comparison.ratio:.3g} over all frequencies, median"
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
    import math

    text = f"{value:.4g} N/m"
    if not (math.isfinite(low) and math.isfinite(high)):
        return f"{text}, interval unknown"
    return f"{text} (95 %: {low:.4g} to {high:.4g})"
