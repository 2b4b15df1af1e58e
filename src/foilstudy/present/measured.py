"""A measurement from a file beside the simulated realisations of its configuration, in words."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from foilstudy.base.numerals import percent, plural
from foilstudy.bench.comparison import Comparison
from foilstudy.bench.figure import draw, drawn

__all__ = ["draw", "drawn", "findings", "title_of"]

_RUNS_MAX = 8


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
