"""How well the fitted power law describes the realisations."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.powerlaw import (
    NORMAL_95,
    fit_power_law,
    law_samples,
    shown_source,
)


@style.styled
def draw(cube):
    """Draw observed against fitted stiffness, and their ratio against overlength."""
    directions = list(map(str, cube["direction"].values))
    figure = style.new_figure(8.2, 6.6)
    axes = figure.subplots(2, len(directions), squeeze=False, height_ratios=[1.25, 1], sharey="row")
    for column, direction in zip(axes.T, directions):
        data = law_samples(cube, direction, shown_source(cube, direction))
        fit = fit_power_law(data).fit
        column[0].set_title(direction)
        if not np.isfinite(fit.value["constant"]):
            style.message_panel(column, fit.note)
            continue
        _pair(column, data, fit, cube["thickness"].to_numpy(), cube["overlength"].to_numpy())
        style.decade_ticks(column[0].xaxis)
        style.decade_ticks(column[0].yaxis)
    axes[0, 0].set_ylabel("stiffness (N/m)")
    axes[1, 0].set_ylabel("stiffness / fitted law")
    style.legend_below(figure, axes[0], 6)
    return figure


def _pair(column, data, fit, thicknesses, overlengths) -> None:
    top, bottom = column
    fitted = np.exp(fit.fitted)
    ratio = data.value / fitted
    limits = style.span(np.concatenate([data.value, fitted]))
    factor = np.exp(NORMAL_95 * fit.residual_std)
    for ax in column:
        ax.set_yscale("log")
    top.set_xscale("log")
    top.plot(limits, limits, color="0.3", lw=1)
    if np.isfinite(factor):
        top.fill_between(
            limits,
            np.divide(limits, factor),
            np.multiply(limits, factor),
            color="0.5",
            alpha=style.BAND_ALPHA,
            lw=0,
        )
        bottom.axhspan(1 / factor, factor, color="0.5", alpha=style.BAND_ALPHA, lw=0)
    bottom.axhline(1, color="0.3", lw=1)
    for i, (thickness, colour) in enumerate(style.coloured(thicknesses)):
        mine = data.thickness_um == thickness
        look = {"ls": "", "marker": style.marker(i), "mfc": "none", "mec": colour, "ms": 5}
        look["mew"] = 1.1
        top.plot(fitted[mine], data.value[mine], label=style.thickness_label(thickness), **look)
        # Thicknesses side by side, so that their dots do not hide each other.
        shift = 1.035 ** (i - (thicknesses.size - 1) / 2)
        bottom.plot(data.overlength_percent[mine] * shift, ratio[mine], **look)
    top.set_xlabel("fitted law (N/m)")
    style.overlength_axis(bottom, overlengths)
    ends = max(ratio.max(), 1 / ratio.min(), factor if np.isfinite(factor) else 1, 1.05) * 1.05
    low, high = bottom.get_ylim()
    bottom.set_ylim(min(low, 1 / ends), max(high, ends))
    choices = [0.2, 0.33, 0.5, 0.67, 0.8, 1, 1.25, 1.5, 2, 3, 5]
    style.value_ticks(bottom.yaxis, [c for c in choices if 1 / ends <= c <= ends])
