"""Contour map of the mean stiffness over overlength and thickness."""

from __future__ import annotations

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.ticker import LogLocator

from foilstudy.plot import style
from foilstudy.present.statistics.powerlaw import shown_source, simulated_law
from foilstudy.present.statistics.summary import best_mean, stiffness_summary

_COLOUR_MAP = "cividis"
_STEPS_PER_DECADE = 4


@style.styled
def draw(cube):
    """Draw one map per direction with a common colour scale."""
    table = stiffness_summary(cube)
    table["best"] = best_mean(table)
    directions = list(map(str, cube["direction"].values))
    figure = style.new_figure(style.PAGE_WIDTH, 4.3)
    axes = figure.subplots(1, len(directions), sharey=True, squeeze=False)[0]
    mean = table["best"].to_numpy()
    mean = mean[np.isfinite(mean)]
    if not mean.size:
        style.message_panel(axes, "no usable realisation in this study")
        return figure
    exponents = np.log10([mean.min(), mean.max()]) * _STEPS_PER_DECADE
    first, last = int(np.floor(exponents[0])), int(np.ceil(exponents[1]))
    levels = 10 ** (np.arange(first, max(last, first + 1) + 1) / _STEPS_PER_DECADE)
    norm = LogNorm(levels[0], levels[-1])
    thicknesses = cube["thickness"].to_numpy()
    overlengths = cube["overlength"].to_numpy()
    for ax, direction in zip(axes, directions):
        rows = table[table["direction"] == direction]
        grid, trusted = (
            rows.pivot(index="thickness_um", columns="overlength_percent", values=name).to_numpy()
            for name in ("best", "trusted")
        )
        ax.set_title(f"{direction} stiffness")
        ax.grid(False)
        ax.set_yscale("log")
        style.overlength_axis(ax, overlengths)
        ax.set_ylim(style.span(thicknesses, 1.3))
        style.value_ticks(ax.yaxis, thicknesses)
        _means(ax, overlengths, thicknesses, grid, levels, norm)
        _doubts(ax, overlengths, thicknesses, np.isfinite(grid) & ~trusted.astype(bool))
        _fit(ax, simulated_law(cube, direction, shown_source(cube, direction)).law, levels)
    axes[0].set_ylabel("thickness (µm)")
    bar = figure.colorbar(
        ScalarMappable(norm, _COLOUR_MAP),
        ax=list(axes),
        label="mean stiffness (N/m)",
        pad=0.02,
        aspect=28,
    )
    bar.outline.set_visible(False)
    style.decade_ticks(bar.ax.yaxis)
    return figure


def _means(ax, overlengths, thicknesses, grid, levels, norm) -> None:
    if min(grid.shape) > 1 and np.isfinite(grid).sum() > 3:
        x, y, stiffness = _interpolated(overlengths, thicknesses, grid)
        ax.contourf(x, y, stiffness, levels=levels, norm=norm, cmap=_COLOUR_MAP)
    x, y = np.meshgrid(overlengths, thicknesses)
    # flat: a row of three or four would be taken for one colour
    values = {"c": grid.ravel(), "norm": norm, "cmap": _COLOUR_MAP}
    ax.scatter(x.ravel(), y.ravel(), **values, s=42, edgecolor="white", lw=1, zorder=4)
    failed = ~np.isfinite(grid)
    ax.plot(x[failed], y[failed], "x", color="0.5", ms=8)


def _doubts(ax, overlengths, thicknesses, doubted) -> None:
    for i, j in np.argwhere(doubted):
        at = overlengths[j], thicknesses[i]
        ax.plot(*at, "o", color="white", mec="0.3", ms=9, zorder=5)
        ax.text(*at, "?", ha="center", va="center_baseline", fontsize=8, zorder=6)


def _interpolated(overlengths, thicknesses, grid):
    """Bilinear interpolation on logarithmic axes, so that a power law gives straight contours."""
    from scipy.interpolate import RegularGridInterpolator

    x = np.linspace(*np.log(overlengths[[0, -1]]), 120)
    y = np.linspace(*np.log(thicknesses[[0, -1]]), 120)
    between = RegularGridInterpolator((np.log(thicknesses), np.log(overlengths)), np.log(grid))
    value = between(np.stack(np.meshgrid(y, x, indexing="ij"), axis=-1))
    return np.exp(x), np.exp(y), np.ma.masked_invalid(np.exp(value))


def _fit(ax, law, levels) -> None:
    if not np.isfinite(law.beta + law.gamma):
        return
    x = np.geomspace(*ax.get_xlim(), 80)
    y = np.geomspace(*ax.get_ylim(), 80)
    stiffness = law.stiffness(x[None, :], y[:, None])
    decades = LogLocator(subs=(1.0, 3.0)).tick_values(stiffness.min(), stiffness.max())
    lines = ax.contour(
        x, y, stiffness, levels=decades, colors="0.15", linestyles="--", linewidths=1
    )
    ax.clabel(lines, fmt=style.short_number, fontsize=8.5, inline_spacing=3)
