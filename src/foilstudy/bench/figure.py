"""Picture of a comparison."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.ticker import MultipleLocator

from foilstudy.base.numerals import plural
from foilstudy.bench.comparison import Comparison, Simulated
from foilstudy.plot import style
from foilstudy.plot.save import save

__all__ = ["draw", "drawn"]

_MEASURED = "#b2182b"


@dataclass(frozen=True, eq=False)
class _Unwrapped:
    """Phases counted from that of the median curve, so that a band does not jump by a turn."""

    frequencies: np.ndarray
    median: np.ndarray

    @classmethod
    def of(cls, simulated: Simulated) -> _Unwrapped:
        known = np.isfinite(simulated.curves).any(axis=0)
        curves = simulated.curves[:, known]
        median = np.nanmedian(curves.real, axis=0) + 1j * np.nanmedian(curves.imag, axis=0)
        return cls(simulated.frequencies[known], np.unwrap(np.angle(median)))

    def phase(self, frequencies: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Degrees."""
        reference = np.interp(np.log(frequencies), np.log(self.frequencies), self.median)
        return np.degrees(reference + np.angle(values * np.exp(-1j * reference)))


@style.styled
def draw(comparison: Comparison, title: str):
    """Magnitude and phase: the simulated band, its median, and the measurement.

    The measurement is a solid line where it is trusted, dots elsewhere, and has crosses where it
    leaves the band.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = style.new_figure(7.0, 6.0)
    axes = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    simulated, measured = comparison.simulated, comparison.measured
    (colour,) = style.ordered_colours(1)
    turned = _Unwrapped.of(simulated)
    f, places = simulated.frequencies, measured.frequencies
    name = f"simulated, {plural(len(simulated.curves), 'realisation')}: median, least to largest"
    style.median_band(axes[0], f, np.abs(simulated.curves), colour, label=name)
    style.median_band(axes[1], f, turned.phase(f, simulated.curves), colour)
    rest = ~measured.trusted
    for ax, shown in zip(axes, (np.abs(measured.values), turned.phase(places, measured.values))):
        ax.plot(places, np.where(rest, np.nan, shown), color=_MEASURED, lw=1.0, label="measured")
        if rest.any():
            ax.plot(places[rest], shown[rest], ".", color=_MEASURED, alpha=0.6, ms=3, mew=0,
                    label="measured, coherence below 0.95")  # fmt: skip
    outside = comparison.excursion != 1
    if outside.any():
        size = np.abs(measured.values)
        axes[0].plot(measured.frequencies[outside], size[outside], "x", color=_MEASURED, ms=3.5,
                     mew=0.7, label="outside of the band")  # fmt: skip
    axes[0].set(xscale="log", yscale="log", title=title)
    axes[0].set_ylabel(f"{simulated.definition} |k| (N/m)")
    axes[1].set(ylabel="phase (°)", xlabel="frequency (Hz)")
    axes[1].yaxis.set_major_locator(MultipleLocator(180))
    style.legend_below(figure, axes, columns_max=2)
    return figure


def drawn(comparison: Comparison, title: str, stem: Path) -> tuple[Path, Path]:
    """Draw and write ``<stem>.png`` and ``<stem>.svg``."""
    return save(draw(comparison, title), stem)
