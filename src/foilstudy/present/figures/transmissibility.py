"""Transmissibility of a payload on mounts, without and with foil links, against frequency."""

from __future__ import annotations

import numpy as np
from matplotlib.ticker import MultipleLocator

from foilstudy.measure.isolation import decibels
from foilstudy.plot import style
from foilstudy.present.configuration import isolation_options
from foilstudy.present.statistics.isolation import payload_transmissibility
from foilstudy.present.statistics.mounts import MOUNTS

_THICKNESSES_MAX = 4
"""More curves than this in one panel cannot be told apart."""


@style.styled
def draw(cube):
    """Draw one panel per direction (row) and mount (column), one band per thickness."""
    directions = list(map(str, cube["direction"].values))
    size = (style.PAGE_WIDTH, 3.0), (0, 0.8)
    figure, axes = style.panel_grid(len(directions), len(MOUNTS), *size, sharex=True, sharey=True)
    frequency, thicknesses = cube["frequency"].to_numpy(), cube["thickness"].to_numpy()
    shown = np.arange(thicknesses.size)
    if shown.size > _THICKNESSES_MAX:
        shown = np.linspace(0, shown[-1], _THICKNESSES_MAX).round().astype(int)
    middle = cube.sizes["overlength"] // 2
    for row, direction in zip(axes, directions):
        found = payload_transmissibility(cube, direction)
        for ax, (mount, motion) in zip(row, found.items()):
            if not np.isfinite(motion.linked[:, middle]).any():
                style.message_panel(ax, "no usable realisation at the middle overlength")
                continue
            ax.set_title(f"{direction}, {mount} mount")
            for i, colour in zip(shown, style.ordered_colours(shown.size)):
                curves = decibels(motion.linked[i, middle])
                # A realisation counts as far up as its dynamic stiffness is known.
                if np.isfinite(curves).any():
                    # As many line styles as curves: told apart without colour.
                    look = {"lw": 1.5, "ls": style.line_style(1 + len(ax.get_lines()))}
                    look["label"] = style.thickness_label(thicknesses[i])
                    style.median_band(ax, frequency, curves, colour, **look)
            ax.plot(frequency, decibels(motion.alone), color="black", lw=1.1, label="mount alone")
            ax.set_xscale("log")
            ax.set_xlim(frequency[0], frequency[-1])
            ax.yaxis.set_major_locator(MultipleLocator(20))
        row[0].set_ylabel("payload over floor (dB)")
    for ax in axes[-1]:
        ax.set_xlabel("frequency (Hz)")
    if axes[0, 0].get_xscale() == "log":
        style.decade_ticks(axes[0, 0].xaxis)
    options = isolation_options(cube)
    links = "one link" if options.links == 1 else f"{options.links} links"
    title = (
        f"{options.payload_mass_kg:g} kg on its mounts, with {links} of "
        f"{style.overlength_label(float(cube['overlength'][middle]))} overlength and a thickness of"
    )
    style.legend_below(figure, axes, title=title)
    return figure
