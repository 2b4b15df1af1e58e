"""Transmissibility of a payload on mounts, without and with foil links, against frequency."""

from __future__ import annotations

import numpy as np
from matplotlib.ticker import MultipleLocator

from foilstudy.measure.isolation import decibels
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
)
from foilstudy.present.configuration import isolation_options
from foilstudy.present.statistics.isolation import payload_transmissibility
from foilstudy.present.statistics.mounts import MOUNTS

_THICKNESSES_MAX = 4
"""More curves than this in one panel cannot be told apart."""


@styled
def draw(cube):
    """Draw one panel per direction (row) and mount (column), one band per thickness.

    Parameters
    ----------
    cube : xarray.Dataset
    """
    directions = list(map(str, cube["direction"].values))
    figure = new_figure(PAGE_WIDTH, 3.0 * len(directions) + 0.8)
    axes = figure.subplots(len(directions), len(MOUNTS), sharex=True, sharey=True, squeeze=False)
    frequency, thicknesses = cube["frequency"].to_numpy(), cube["thickness"].to_numpy()
    shown = np.arange(thicknesses.size)
    if shown.size > _THICKNESSES_MAX:
        shown = np.linspace(0, shown[-1], _THICKNESSES_MAX).round().astype(int)
    middle = cube.sizes["overlength"] // 2
    for row, direction in zip(axes, directions):
        found = payload_transmissibility(cube, direction)
        for ax, (mount, motion) in zip(row, found.items()):
            if not np.isfinite(motion.linked[:, middle]).any():
                message_panel(ax, "no usable realisation at the middle overlength")
                continue
            ax.set_title(f"{direction}, {mount} mount")
            for i, colour in zip(shown, ordered_colours(shown.size)):
                label = thickness_label(thicknesses[i])
                _band(ax, frequency, decibels(motion.linked[i, middle]), (colour, label))
            ax.plot(frequency, decibels(motion.alone), color="black", lw=1.1, label="mount alone")
            ax.set_xscale("log")
            ax.set_xlim(frequency[0], frequency[-1])
            ax.yaxis.set_major_locator(MultipleLocator(20))
        row[0].set_ylabel("payload over floor (dB)")
    for ax in axes[-1]:
        ax.set_xlabel("frequency (Hz)")
    if axes[0, 0].get_xscale() == "log":
        decade_ticks(axes[0, 0].xaxis)
    _legend(figure, axes, isolation_options(cube), float(cube["overlength"][middle]))
    return figure


def _band(ax, frequency, curves, look) -> None:
    colour, label = look
    # A realisation counts as far up as its dynamic stiffness is known.
    known = np.isfinite(curves).any(axis=0)
    if not known.any():
        return
    frequency, curves = frequency[known], curves[:, known]
    low, high = np.nanmin(curves, axis=0), np.nanmax(curves, axis=0)
    ax.fill_between(frequency, low, high, color=colour, alpha=BAND_ALPHA, lw=0)
    # As many line styles as curves: told apart without colour.
    style = line_style(1 + len(ax.get_lines()))
    ax.plot(frequency, np.nanmedian(curves, axis=0), color=colour, lw=1.5, ls=style, label=label)


def _legend(figure, axes, options, overlength: float) -> None:
    handles, labels = max(
        (ax.get_legend_handles_labels() for ax in axes.flat), key=lambda pair: len(pair[0])
    )
    if not handles:
        return
    links = "one link" if options.links == 1 else f"{options.links} links"
    figure.legend(
        handles,
        labels,
        title=f"{options.payload_mass_kg:g} kg on its mounts, with {links} of "
        f"{overlength_label(overlength)} overlength and a thickness of",
        loc="outside lower center",
        ncols=len(labels),
    )
