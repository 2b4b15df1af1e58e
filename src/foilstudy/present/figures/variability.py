"""Coefficient of variation of the stiffness against overlength."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.variability import (
    fit_variability,
    plain_scatter,
    variability_table,
)


@style.styled
def draw(cube):
    """Draw one panel per direction."""
    table = plain_scatter(variability_table(cube))
    directions = list(map(str, cube["direction"].values))
    thicknesses = cube["thickness"].to_numpy()
    figure = style.new_figure(style.PAGE_WIDTH, 4.2)
    axes = figure.subplots(1, len(directions), sharey=True, squeeze=False)[0]
    for ax, direction in zip(axes, directions):
        rows = table[(table["direction"] == direction) & table["cv"].notna()]
        ax.set_title(f"{direction} stiffness")
        if rows.empty:
            style.message_panel(ax, "scatter needs two usable realisations of one configuration")
            continue
        _panel(ax, rows, thicknesses)
        _regression(ax, fit_variability(table, direction), rows["overlength_percent"])
        ax.set_xlabel("overlength (%)")
    values = table["cv"].dropna()
    if not values.empty:
        # Confidence limits of few realisations are wide: let the largest leave the figure.
        axes[0].set_ylim(0, 1.08 * max(values.max(), min(table["cv_high"].max(), 2 * values.max())))
        axes[0].set_ylabel("coefficient of variation")
        style.legend_below(figure, axes, 7)
    return figure


def _panel(ax, rows, thicknesses) -> None:
    step = 0.009 * np.ptp(rows["overlength_percent"]) or 0.3
    for i, (thickness, colour) in enumerate(style.coloured(thicknesses)):
        mine = rows[rows["thickness_um"] == thickness]
        if mine.empty:
            continue
        # Thicknesses side by side, so that their intervals do not hide each other.
        x = mine["overlength_percent"] + step * (i - (thicknesses.size - 1) / 2) * 2
        above = (mine["cv_high"] - mine["cv"]).clip(upper=10)
        ax.errorbar(
            x,
            mine["cv"],
            yerr=[mine["cv"] - mine["cv_low"], above],
            fmt=style.marker(i),
            color=colour,
            mec="white",
            mew=0.5,
            ms=6.5,
            elinewidth=0.9,
            alpha=0.95,
            label=style.thickness_label(thickness),
        )


def _regression(ax, fit, overlengths) -> None:
    if not np.isfinite(fit.value["overlength"]):
        return
    x = np.linspace(overlengths.min(), overlengths.max(), 60)
    mean, low, high = fit.predict({"overlength": x})
    ax.plot(x, mean, color="0.2", label="regression")
    if np.isfinite(low).all():
        ax.fill_between(x, low, high, color="0.5", alpha=style.BAND_ALPHA, lw=0, label="95 % band")
        half = 100 * (fit.high["overlength"] - fit.value["overlength"])
        text = f"slope {100 * fit.value['overlength']:+.3f} ± {half:.3f} per 100 % overlength"
        ax.text(
            0.02,
            0.98,
            text.replace("-", "−"),
            transform=ax.transAxes,
            va="top",
            color="0.2",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 2, "alpha": 0.85},
        )
