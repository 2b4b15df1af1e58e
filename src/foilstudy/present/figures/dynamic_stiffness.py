"""Magnitude of the dynamic stiffness against frequency."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.cells import good, sound


@style.styled
def draw(cube, definition: str):
    """Draw one panel per direction (row) and thickness (column), one curve per overlength.

    Parameters
    ----------
    definition
        ``transfer``, ``driving`` or ``relative``.
    """
    magnitude = np.abs(cube["dynamic_stiffness"].sel(definition=definition))
    magnitude = magnitude.where(sound(cube))
    directions = list(map(str, cube["direction"].values))
    thicknesses = cube["thickness"].to_numpy()
    figure, axes = style.panel_grid(
        len(directions), thicknesses.size, (2.2, 2.9), (2.2, 0.6), sharex=True, sharey=True
    )
    for row, direction in zip(axes, directions):
        static = good(cube, "static_stiffness", direction=direction).mean("seed")
        for ax, thickness in zip(row, thicknesses):
            at = {"thickness": thickness}
            _panel(ax, magnitude.sel(at | {"direction": direction}), static.sel(at))
        row[0].set_ylabel(f"{direction} |k| (N/m)")
    for ax, thickness in zip(axes[0], thicknesses):
        ax.set_title(style.thickness_label(thickness))
    for ax in axes[-1]:
        ax.set_xlabel("frequency (Hz)")
        style.value_ticks(ax.xaxis, (1, 10, 100, 800))
    if axes[0, 0].get_yscale() == "log":
        style.decade_ticks(axes[0, 0].yaxis)
    style.legend_below(figure, axes, title="overlength")
    return figure


def _panel(ax, magnitude, static) -> None:
    frequency = magnitude["frequency"].to_numpy()
    left, right = frequency[0] / 1.6, frequency[-1] * 1.1
    overlengths = magnitude["overlength"].to_numpy()
    drawn = False
    for j, colour in enumerate(style.ordered_colours(overlengths.size)):
        curves = magnitude.isel(overlength=j).transpose("seed", "frequency").to_numpy()
        if not np.isfinite(curves).any():
            continue
        drawn = True
        # a reduced model that is not valid up to the end of the band leaves the rest out
        name = style.overlength_label(overlengths[j])
        look = {"lw": 1.4, "ls": style.line_style(j), "label": name}
        style.median_band(ax, frequency, curves, colour, **look)
        ax.plot(
            left * 1.17, static.isel(overlength=j), ">", color=colour, ms=5.5, mec="white", mew=0.4,
            clip_on=False,
        )  # fmt: skip
    if not drawn:
        style.message_panel(ax, "no usable realisation")
        return
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(left, right)
