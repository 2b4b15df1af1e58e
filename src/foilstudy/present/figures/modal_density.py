"""Modal density against frequency, beside that of a flat plate of the same foil."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.modal_density import (
    ELEMENTS_PER_WAVE,
    counted_modal_density,
    plate_modal_density,
    resolved_up_to,
)

_COLUMNS = 2
_LOWEST_DENSITY = 0.01
"""Bottom of the axis, modes per Hz: less means that a band has just met its first mode."""


@style.styled
def draw(cube):
    """Draw one panel per thickness, one curve per overlength."""
    if "mode_count" not in cube:
        return style.message_figure("no usable mode counts in this study")
    density, plate, limit = (
        function(cube) for function in (counted_modal_density, plate_modal_density, resolved_up_to)
    )
    density = density.sel(frequency=density["frequency"] >= _start(density))
    thicknesses = cube["thickness"].to_numpy()
    figure, axes = style.wrapped_grid(
        thicknesses.size, _COLUMNS, (4.3, 2.7), (0.6, 0.8), sharex=True, sharey=True
    )
    for ax, thickness in zip(axes.flat, thicknesses):
        at = {"thickness": thickness}
        ax.set_title(style.thickness_label(thickness))
        _panel(ax, density.sel(at), None if plate is None else plate.sel(at))
        if limit is not None and np.isfinite(limit.sel(at)):
            _unresolved(ax, float(limit.sel(at)), float(density["frequency"][-1]))
    _label(figure, axes)
    return figure


def _start(density) -> float:
    """Somewhat below the frequency at which the first realisation has modes, Hz."""
    with_modes = density["frequency"].where((density > 0).any(["thickness", "overlength", "seed"]))
    return float(with_modes.min(skipna=True).fillna(0) / 1.5)


def _panel(ax, density, plate) -> None:
    frequency = density["frequency"].to_numpy()
    overlengths = density["overlength"].to_numpy()
    drawn = False
    for j, colour in enumerate(style.ordered_colours(overlengths.size)):
        curves = density.isel(overlength=j).transpose("seed", "frequency").to_numpy()
        curves = curves[np.isfinite(curves).any(axis=1)]
        if not (curves > 0).any():
            continue
        drawn = True
        curves = np.where(curves > 0, curves, np.nan)  # a band without modes leaves a gap
        known = np.isfinite(curves).all(axis=0)
        low, high = (np.where(known, edge(curves, axis=0), np.nan) for edge in (np.min, np.max))
        ax.fill_between(frequency, low, high, color=colour, alpha=style.BAND_ALPHA, lw=0)
        ax.plot(
            frequency,
            np.where(known, np.median(curves, axis=0), np.nan),
            color=colour,
            ls=style.line_style(j),
            label=style.overlength_label(overlengths[j]),
        )
    if not drawn:
        style.message_panel(ax, "no usable realisation")
        return
    if plate is not None:
        _plate(ax, float(plate.min()), float(plate.max()))
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(frequency[0], frequency[-1])
    ax.set_ylim(bottom=_LOWEST_DENSITY)


def _plate(ax, low: float, high: float) -> None:
    """Show the flat plates from the smallest to the largest area."""
    ax.axhspan(low, high, color=style.GREY, alpha=style.BAND_ALPHA, lw=0)
    for level in (low, high):
        ax.axhline(level, color=style.GREY, lw=1, ls="--")
    ax.text(
        0.02, high * 1.12, "flat plate", transform=ax.get_yaxis_transform(), color="0.3", fontsize=9
    )


def _unresolved(ax, start: float, end: float) -> None:
    """Shade where the mesh has too few elements in a bending wave."""
    if ax.axison and start < end:
        ax.axvspan(start, end, color="0.93", lw=0, zorder=0)
        if np.log(end / start) > 0.2 * np.log(end / ax.get_xlim()[0]):
            ax.text(
                end,
                0.02,
                f"under {ELEMENTS_PER_WAVE} elements \nper wave ",
                transform=ax.get_xaxis_transform(),
                ha="right",
                fontsize=9,
            )


def _label(figure, axes) -> None:
    shown = [ax for ax in axes.flat if ax.axison]
    if not shown:
        return
    for ax in axes[-1]:
        ax.set_xlabel("frequency (Hz)")
    for ax in axes[:, 0]:
        ax.set_ylabel("modes per Hz")
    style.value_ticks(shown[0].xaxis, (10, 20, 50, 100, 200, 500, 800, 2000))
    style.decade_ticks(shown[0].yaxis)
    style.legend_below(figure, shown, title="overlength")
