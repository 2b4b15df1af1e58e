"""Common look of the figures: fonts, ordered colours, labels, and panels without data."""

from __future__ import annotations

import functools
import textwrap

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter, NullLocator
from scipy.optimize import isotonic_regression

PAGE_WIDTH = 10.0
"""Width of a full-width figure, inches."""

GREY = "0.45"
BAND_ALPHA = 0.22

_RC = {
    "font.family": "DejaVu Sans",
    "font.size": 10,
    "axes.titlesize": 10.5,
    "axes.labelsize": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "0.3",
    "axes.linewidth": 0.8,
    "xtick.color": "0.2",
    "ytick.color": "0.2",
    "xtick.labelsize": 9,
    "ytick.labelsize": 9,
    "axes.grid": True,
    "grid.color": "0.9",
    "grid.linewidth": 0.7,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "legend.fontsize": 9.5,
    "lines.linewidth": 1.6,
    "svg.hashsalt": "foilstudy",
    "svg.fonttype": "path",
}

_MARKERS = "osD^vPX*<>"
_LINE_STYLES = ("-", "--", "-.", ":", (0, (5, 1)), (0, (3, 1, 1, 1, 1, 1)))


def styled(function):
    """Decorator: run `function` under the study's matplotlib settings."""

    @functools.wraps(function)
    def wrapper(*args, **kwargs):
        with mpl.rc_context({**mpl.rcParamsDefault, **_RC, "backend": "agg"}):
            return function(*args, **kwargs)

    return wrapper


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure (inches) that is independent of pyplot's global state."""
    return Figure(figsize=(width, height), layout="constrained", facecolor="white")


def panel_grid(rows: int, columns: int, cell, margin, **shared):
    """Return a figure at most as wide as the page, and its axes, shape (rows, columns).

    Parameters
    ----------
    cell, margin : tuple of float
        Width and height of a panel, and what the figure has beyond its panels, inches.
    shared
        ``sharex``, ``sharey``.
    """
    width = min(PAGE_WIDTH, cell[0] * columns + margin[0])
    figure = new_figure(width, cell[1] * rows + margin[1])
    return figure, figure.subplots(rows, columns, squeeze=False, **shared)


def wrapped_grid(count: int, columns_max: int, cell, margin, **shared):
    """A `panel_grid` of `count` panels, filled row by row; the spare ones are off."""
    columns = min(columns_max, count)
    figure, axes = panel_grid(-(-count // columns), columns, cell, margin, **shared)
    for spare in axes.flat[count:]:
        spare.set_axis_off()
    return figure, axes


def ordered_colours(n: int) -> list:
    """`n` colours of evenly rising lightness, dark enough for lines on white."""
    return list(mpl.colormaps["viridis"](np.linspace(0.0, 0.76, n) if n > 1 else [0.25]))


def coloured(values) -> list[tuple]:
    """Values, each with its colour of `ordered_colours`."""
    return list(zip(values, ordered_colours(len(values)), strict=True))


def marker(index: int) -> str:
    """Marker of the series at `index`."""
    return _MARKERS[index % len(_MARKERS)]


def line_style(index: int):
    """Line style of the series at `index`."""
    return _LINE_STYLES[index % len(_LINE_STYLES)]


def thickness_label(thickness_um: float) -> str:
    """For example ``500 µm``."""
    return f"{thickness_um:g} µm"


def overlength_label(overlength_percent: float) -> str:
    """For example ``31 %``; one decimal below 10 %."""
    return (
        f"{overlength_percent:.0f} %"
        if overlength_percent >= 10
        else (f"{overlength_percent:.2g} %")
    )


def span(values, margin: float = 1.18) -> tuple[float, float]:
    """Limits of a logarithmic axis around positive `values`."""
    values = np.asarray(values, float)
    return float(values.min() / margin), float(values.max() * margin)


def overlength_axis(axes, overlengths) -> None:
    """Logarithmic overlength axis with ticks at the simulated overlengths."""
    axes.set_xscale("log")
    axes.set_xlim(span(overlengths, 1.3))
    _ticks_at(axes.xaxis, overlengths, lambda value: overlength_label(value)[:-2])
    axes.set_xlabel("overlength (%)")


def value_ticks(axis, values, label="{:g}".format) -> None:
    """Ticks of a logarithmic axis at `values` only, written with `label`."""
    _ticks_at(axis, values, label)


def decade_ticks(axis) -> None:
    """Ticks 100, 1k, 10k, ... of a logarithmic axis with final limits; 1-2-5 in a short range."""
    low, high = axis.get_view_interval()
    steps = (1,) if high / low >= 150 else (1, 2, 5)
    candidates = [m * 10.0**e for e in range(-9, 13) for m in steps]
    value_ticks(axis, [c for c in candidates if low <= c <= high], short_number)


def short_number(value: float) -> str:
    """For example ``300``, ``3k`` or ``0.2M``."""
    for factor, suffix in ((1e6, "M"), (1e3, "k")):
        if value >= 0.999 * factor:
            return f"{value / factor:.3g}{suffix}"
    return f"{value:.3g}"


def _ticks_at(axis, values, label) -> None:
    axis.set_major_locator(FixedLocator(_thinned(values)))
    axis.set_major_formatter(FuncFormatter(lambda value, _: label(value)))
    axis.set_minor_locator(NullLocator())
    axis.set_minor_formatter(NullFormatter())


def _thinned(values, ratio: float = 1.08) -> list[float]:
    kept: list[float] = []
    for value in sorted(map(float, values)):
        if not kept or value / kept[-1] > ratio:
            kept.append(value)
    return kept


def message_panel(axes, text: str, width: int = 26) -> None:
    """Turn one or several axes into panels that say why there is nothing to see."""
    for ax in np.ravel(axes):
        ax.set_axis_off()
        ax.text(
            0.5, 0.5, textwrap.fill(text, width), transform=ax.transAxes, ha="center", va="center",
            color=GREY, fontsize=9.5, style="italic",
        )  # fmt: skip


def message_figure(text: str = "no usable realisation in this study") -> Figure:
    """Return a figure that says why there is nothing to see."""
    figure = new_figure(6, 2)
    message_panel(figure.subplots(), text, 60)
    return figure


def legend_below(figure: Figure, axes, columns_max: int = 8, **options) -> None:
    """One legend for all axes below them: that of the axes which has the most entries."""
    handles, labels = max(
        (ax.get_legend_handles_labels() for ax in np.ravel(axes)), key=lambda pair: len(pair[0])
    )
    if handles:
        columns = min(columns_max, len(labels))
        figure.legend(handles, labels, loc="outside lower center", ncols=columns, **options)


def median_band(ax, x: np.ndarray, curves: np.ndarray, colour, **line) -> None:
    """Median of curves as a line, from the smallest to the largest as a band.

    Parameters
    ----------
    x : ndarray, shape (n,)
    curves : ndarray, shape (m, n)
        NaN where a curve is not known; places where none is are left out.
    line
        Passed on to ``ax.plot``.
    """
    known = np.isfinite(curves).any(axis=0)
    x, curves = x[known], curves[:, known]
    low, high = np.nanmin(curves, axis=0), np.nanmax(curves, axis=0)
    ax.fill_between(x, low, high, color=colour, alpha=BAND_ALPHA, lw=0)
    ax.plot(x, np.nanmedian(curves, axis=0), color=colour, **line)


def label_ends(axes, x: float, labels, gap: float = 0.062, **text) -> None:
    """Write labels beside the ends of lines, moved apart so that none overlap.

    Parameters
    ----------
    axes
        Its limits must be final.
    x : float
        Position in axes fractions.
    labels : iterable of (y in data units, text, colour)
    gap : float
        Smallest distance between two labels, in axes fractions.
    text
        Passed on to ``axes.text``.
    """
    to_axes = axes.transData + axes.transAxes.inverted()
    items = sorted(
        (float(to_axes.transform((axes.get_xlim()[0], y))[1]), content, colour)
        for y, content, colour in labels
        if np.isfinite(y)
    )
    positions = spread([min(max(item[0], 0.0), 1.0) for item in items], gap)
    for position, (_, content, colour) in zip(positions, items):
        axes.text(x, position, content, color=colour, transform=axes.transAxes, va="center", **text)


def spread(positions, gap: float) -> np.ndarray:
    """Move sorted positions the least (in the sense of squares) so that they stay `gap` apart."""
    offset = gap * np.arange(len(positions))
    return isotonic_regression(np.asarray(positions, float) - offset).x + offset
