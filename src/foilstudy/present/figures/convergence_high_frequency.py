"""Do the overlengths share one dynamic stiffness at high frequency, within the scatter of seeds?"""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.modal_density import resolved_up_to
from foilstudy.present.statistics.overlength_spread import (
    RATIO_MAX,
    OverlengthSpread,
    overlength_spread,
    relative_magnitude,
)

_UNRESOLVED = {"color": "0.93", "lw": 0, "zorder": 0}
_DIRECTION_STYLES = (("-", "0.1"), ((0, (4, 1.5)), "0.45"))


@style.styled
def draw(cube):
    """Draw a row per direction and one of the criterion; one column per thickness."""
    directions = list(map(str, cube["direction"].values))
    thicknesses = cube["thickness"].to_numpy()
    figure, axes = style.panel_grid(
        len(directions) + 1, thicknesses.size, (2.2, 2.2), (2.2, 0.7), sharex=True, sharey="row"
    )
    frequency = cube["frequency"].to_numpy()
    limit = resolved_up_to(cube)
    for column, thickness in zip(axes.T, thicknesses):
        column[0].set_title(style.thickness_label(thickness))
        found = {}
        for ax, direction in zip(column, directions):
            magnitude = relative_magnitude(cube, thickness, direction)
            try:
                found[direction] = overlength_spread(frequency, magnitude)
            except ValueError as reason:
                style.message_panel(ax, str(reason))
            else:
                _curves(ax, found[direction], cube["overlength"].to_numpy())
        _criterion(column[-1], found, directions)
        if limit is not None and limit.sel(thickness=thickness) < frequency[-1]:
            for ax in (ax for ax in column if ax.axison):
                ax.axvspan(float(limit.sel(thickness=thickness)), frequency[-1], **_UNRESOLVED)
    _label(figure, axes, directions)
    return figure


def _curves(ax, spread: OverlengthSpread, overlengths) -> None:
    """Each overlength over the mean of all, and the scatter of the seeds about 1."""
    low, high = np.exp(-spread.within), np.exp(spread.within)
    ax.fill_between(spread.frequency, low, high, color=style.GREY, alpha=2 * style.BAND_ALPHA, lw=0)
    for j, colour in enumerate(style.ordered_colours(overlengths.size)):
        if np.isfinite(spread.deviation[j]).all():
            ax.plot(
                spread.frequency,
                np.exp(spread.deviation[j]),
                color=colour,
                lw=1.3,
                ls=style.line_style(j),
                label=style.overlength_label(overlengths[j]),
            )
    start = spread.one_curve_from_hz
    if np.isfinite(start):
        ax.axvline(start, color="0.2", lw=1)
        ax.text(
            start, 0.98, f"{start:.0f} Hz ", transform=ax.get_xaxis_transform(), ha="right",
            va="top", fontsize=9,
        )  # fmt: skip
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(spread.frequency[0], spread.frequency[-1])


def _criterion(ax, found: dict[str, OverlengthSpread], directions) -> None:
    """Spread of the overlengths over that of the seeds."""
    if not found:
        ax.set_axis_off()
        return
    for direction, (look, colour) in zip(directions, _DIRECTION_STYLES):
        if direction in found:
            spread = found[direction]
            ax.plot(spread.frequency, spread.ratio, ls=look, color=colour, lw=1.4, label=direction)
    ax.axhline(RATIO_MAX, color="0.2", lw=0.9, ls=":")


def _label(figure, axes, directions) -> None:
    for ax in axes.flat:
        if ax.axison:
            style.value_ticks(ax.xaxis, (1, 10, 100, 800))
    for row, direction in zip(axes, directions):
        row[0].set_ylabel(f"{direction} |k| over\nmean of overlengths")
        shown = next((ax for ax in row if ax.axison), None)
        if shown is not None:
            style.value_ticks(shown.yaxis, (0.1, 0.2, 0.5, 1, 2, 5, 10))
    axes[-1, 0].set_ylabel("spread of overlengths\nover that of seeds")
    for ax in axes[-1]:
        ax.set_xlabel("frequency (Hz)")
    criteria = [ax for ax in axes[-1] if ax.axison]
    if criteria:
        criteria[0].set_ylim(bottom=0)
        criteria[0].legend(loc="upper right", handlelength=2.5)
    style.legend_below(figure, axes[:-1], title="overlength")
