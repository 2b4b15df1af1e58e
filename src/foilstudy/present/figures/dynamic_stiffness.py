"""Magnitude of the dynamic stiffness against frequency."""

from __future__ import annotations

import numpy as np

from foilstudy.base.outcome import USABLE
from foilstudy.plot.style import (
    BAND_ALPHA,
    PAGE_WIDTH,
    decade_ticks,
    line_style,
    message_panel,
    new_figure,
    ordered_colours,
    overlength_label,
    styled,
    thickness_label,
    value_ticks,
)
from foilstudy.present.statistics.cells import good


@styled
def draw(cube, definition: str):
    """Draw one panel per direction (row) and thickness (column), one curve per overlength.

    Parameters
    ----------
    cube : xarray.Dataset
    definition
        ``transfer``, ``driving`` or ``relative``.
    """
    magnitude = np.abs(cube["dynamic_stiffness"].sel(definition=definition))
    magnitude = magnitude.where(cube["status"].isin(USABLE))
    directions = list(map(str, cube["direction"].values))
    thicknesses = cube["thickness"].to_numpy()
    figure = new_figure(min(PAGE_WIDTH, 2.2 * thicknesses.size + 2.2), 2.9 * len(directions) + 0.6)
    axes = figure.subplots(
        len(directions), thicknesses.size, sharex=True, sharey=True, squeeze=False
    )
    for row, direction in zip(axes, directions):
        static = good(cube, "static_stiffness", direction=direction).mean("seed")
        for ax, thickness in zip(row, thicknesses):
            at = {"thickness": thickness}
            _panel(ax, magnitude.sel(at | {"direction": direction}), static.sel(at))
        row[0].set_ylabel(f"{direction} |k| (N/m)")
    frequency = cube["frequency"].to_numpy()
    for ax, thickness in zip(axes[0], thicknesses):
        ax.set_title(thickness_label(thickness))
    for ax in axes[-1]:
        ax.set_xlabel("frequency (Hz)")
        ticks = [f for f in (1, 10, 100, 800) if frequency[0] <= f <= frequency[-1]]
        value_ticks(ax.xaxis, ticks)
    if axes[0, 0].get_yscale() == "log":
        decade_ticks(axes[0, 0].yaxis)
    handles, labels = max(
        (ax.get_legend_handles_labels() for ax in axes.flat), key=lambda pair: len(pair[0])
    )
    if handles:
        figure.legend(
            handles,
            labels,
            title="overlength",
            loc="outside lower center",
            ncols=min(8, len(labels)),
        )
    return figure


def _panel(ax, magnitude, static) -> None:
    frequency = magnitude["frequency"].to_numpy()
    left, right = frequency[0] / 1.6, frequency[-1] * 1.1
    overlengths = magnitude["overlength"].to_numpy()
    drawn = False
    for j, colour in enumerate(ordered_colours(overlengths.size)):
        curves = magnitude.isel(overlength=j).transpose("seed", "frequency").to_numpy()
        curves = curves[np.isfinite(curves).any(axis=1)]
        # a reduced model that is not valid up to the end of the band leaves the rest out
        known = np.isfinite(curves).any(axis=0)
        if not known.any():
            continue
        drawn = True
        curves = curves[:, known]
        ax.fill_between(
            frequency[known],
            np.nanmin(curves, axis=0),
            np.nanmax(curves, axis=0),
            color=colour,
            alpha=BAND_ALPHA,
            lw=0,
        )
        ax.plot(
            frequency[known],
            np.nanmedian(curves, axis=0),
            color=colour,
            lw=1.4,
            ls=line_style(j),
            label=overlength_label(overlengths[j]),
        )
        ax.plot(
            left * 1.17,
            static.isel(overlength=j),
            ">",
            color=colour,
            ms=5.5,
            mec="white",
            mew=0.4,
            clip_on=False,
        )
    if not drawn:
        message_panel(ax, "no usable realisation")
        return
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(left, right)
