"""Stated mesh error of the stiffness against overlength."""

from __future__ import annotations

import numpy as np

from foilstudy.plot.style import (
    PAGE_WIDTH,
    legend_below,
    line_style,
    marker,
    message_panel,
    new_figure,
    ordered_colours,
    overlength_axis,
    styled,
    thickness_label,
    value_ticks,
)
from foilstudy.present.statistics.cells import relative_mesh_error

_TICKS = [m * 10.0**e for e in range(-4, 4) for m in (1, 3)]


@styled
def draw(cube):
    """Draw one panel per direction, one line per thickness.

    Parameters
    ----------
    cube : xarray.Dataset
    """
    directions = list(map(str, cube["direction"].values))
    percent = 100 * relative_mesh_error(cube)
    figure = new_figure(PAGE_WIDTH, 4.2)
    axes = figure.subplots(1, len(directions), sharey=True, squeeze=False)[0]
    if not (percent > 0).any():
        message_panel(axes, "no usable realisation with a mesh error in this study")
        return figure
    for ax, direction in zip(axes, directions):
        ax.set_title(f"{direction} stiffness")
        ax.set_yscale("log")
        overlength_axis(ax, cube["overlength"].to_numpy())
        _panel(ax, percent.sel(direction=direction))
    axes[0].set_ylabel("stated mesh error (%)")
    value_ticks(axes[0].yaxis, _TICKS)
    legend_below(figure, axes, 7)
    return figure


def _panel(ax, percent) -> None:
    thicknesses, overlengths = percent["thickness"].to_numpy(), percent["overlength"].to_numpy()
    median = percent.median("seed").transpose("thickness", "overlength").to_numpy()
    above = percent.max("seed").transpose("thickness", "overlength").to_numpy() - median
    for i, (thickness, colour) in enumerate(zip(thicknesses, ordered_colours(thicknesses.size))):
        # Thicknesses side by side, so that their bars do not hide each other.
        shift = 1.03 ** (i - (thicknesses.size - 1) / 2)
        ax.errorbar(
            overlengths * shift,
            median[i],
            yerr=[np.zeros_like(above[i]), above[i]],
            fmt=marker(i),
            ls=line_style(i),
            color=colour,
            mec="white",
            mew=0.5,
            ms=6.5,
            lw=1.3,
            elinewidth=1,
            label=thickness_label(thickness),
        )
