"""Stated mesh error of the stiffness against overlength."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.cells import relative_mesh_error

_TICKS = [m * 10.0**e for e in range(-4, 4) for m in (1, 3)]


@style.styled
def draw(cube):
    """Draw one panel per direction, one line per thickness."""
    directions = list(map(str, cube["direction"].values))
    percent = 100 * relative_mesh_error(cube)
    figure = style.new_figure(style.PAGE_WIDTH, 4.2)
    axes = figure.subplots(1, len(directions), sharey=True, squeeze=False)[0]
    if not (percent > 0).any():
        style.message_panel(axes, "no usable realisation with a mesh error in this study")
        return figure
    for ax, direction in zip(axes, directions):
        ax.set_title(f"{direction} stiffness")
        ax.set_yscale("log")
        style.overlength_axis(ax, cube["overlength"].to_numpy())
        _panel(ax, percent.sel(direction=direction))
    axes[0].set_ylabel("stated mesh error (%)")
    style.value_ticks(axes[0].yaxis, _TICKS)
    style.legend_below(figure, axes, 7)
    return figure


def _panel(ax, percent) -> None:
    thicknesses, overlengths = percent["thickness"].to_numpy(), percent["overlength"].to_numpy()
    median = percent.median("seed").transpose("thickness", "overlength").to_numpy()
    above = percent.max("seed").transpose("thickness", "overlength").to_numpy() - median
    for i, (thickness, colour) in enumerate(style.coloured(thicknesses)):
        # Thicknesses side by side, so that their bars do not hide each other.
        shift = 1.03 ** (i - (thicknesses.size - 1) / 2)
        ax.errorbar(
            overlengths * shift,
            median[i],
            yerr=[np.zeros_like(above[i]), above[i]],
            fmt=style.marker(i),
            ls=style.line_style(i),
            color=colour,
            mec="white",
            mew=0.5,
            ms=6.5,
            lw=1.3,
            elinewidth=1,
            label=style.thickness_label(thickness),
        )
