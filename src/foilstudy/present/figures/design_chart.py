"""Which thickness and overlength stays soft beside a mount, and up to which frequency."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.patches import Patch, Rectangle

from foilstudy.plot import style
from foilstudy.present.configuration import isolation_options
from foilstudy.present.statistics.isolation import isolation_table
from foilstudy.present.statistics.mounts import MOUNTS

_COLOUR_MAP = "cividis"
_HATCH = {"facecolor": "0.95", "hatch": "////", "edgecolor": "0.87", "lw": 0}
_FRAME = {"facecolor": "none", "edgecolor": "black", "lw": 2.4}
_COLUMNS_WITH_WORST = 9
"""With more overlengths a cell is too narrow for a second number."""


@style.styled
def draw(cube):
    """Draw one panel per direction (row) and mount (column), one cell per configuration."""
    table = isolation_table(cube)
    directions = list(map(str, cube["direction"].values))
    rows = cube.sizes["thickness"]
    figure = style.new_figure(style.PAGE_WIDTH, len(directions) * (0.9 + 0.48 * rows) + 0.9)
    axes = figure.subplots(len(directions), len(MOUNTS), sharex=True, sharey=True, squeeze=False)
    if not table["n"].any():
        style.message_panel(axes, "no usable realisation in this study")
        return figure
    norm = _norm(table)
    for row, direction in zip(axes, directions):
        for ax, mount in zip(row, MOUNTS):
            cells = table[(table["direction"] == direction) & (table["mount"] == mount)]
            ax.set_title(f"{direction}, {mount} mount")
            _panel(ax, cells, norm)
        row[0].set_ylabel("thickness")
    for ax in axes[-1]:
        ax.set_xlabel("overlength")
    if (table["kept_to_hz_median"] > 0).any():
        _colour_bar(figure, axes, norm)
    _legend(figure, isolation_options(cube), table["up_to_hz"].iloc[0])
    return figure


def _norm(table) -> LogNorm:
    """Colours from the decade of the lowest frequency to the end of the computed band."""
    band_end = table["band_end_hz"].iloc[0]
    kept = table["kept_to_hz_median"]
    lowest = kept[kept > 0].min() if (kept > 0).any() else band_end
    return LogNorm(10 ** (np.ceil(np.log10(lowest)) - 1), band_end)


def _colour_bar(figure, axes, norm) -> None:
    bar = figure.colorbar(
        ScalarMappable(norm, _COLOUR_MAP),
        ax=axes,
        label="kept up to (Hz): median (worst)",
        pad=0.02,
        aspect=30,
    )
    bar.outline.set_visible(False)
    steps = [m * 10.0**e for e in range(-2, 7) for m in (1, 2, 5)]
    ticks = [tick for tick in steps if norm.vmin <= tick < 0.9 * norm.vmax]
    style.value_ticks(bar.ax.yaxis, [*ticks, norm.vmax], style.short_number)


def _panel(ax, cells, norm) -> None:
    thicknesses = sorted(cells["thickness_um"].unique())
    overlengths = sorted(cells["overlength_percent"].unique())
    framed = []
    for cell in cells.itertuples():
        corner = overlengths.index(cell.overlength_percent), thicknesses.index(cell.thickness_um)
        _cell(ax, cell, corner, norm, len(overlengths) <= _COLUMNS_WITH_WORST)
        if cell.kept:
            framed.append(corner)
    # After all cells, so that no neighbour covers a frame.
    for x, y in framed:
        ax.add_patch(Rectangle((x + 0.04, y + 0.06), 0.92, 0.88, zorder=3, **_FRAME))
    ax.grid(False)
    ax.set_xlim(0, len(overlengths))
    ax.set_ylim(0, len(thicknesses))
    ax.set_xticks(
        np.arange(len(overlengths)) + 0.5, [style.overlength_label(o) for o in overlengths]
    )
    ax.set_yticks(
        np.arange(len(thicknesses)) + 0.5, [style.thickness_label(t) for t in thicknesses]
    )
    ax.tick_params(length=0)
    ax.tick_params(axis="x", labelsize=9 if len(overlengths) <= _COLUMNS_WITH_WORST else 7)
    ax.spines[:].set_visible(False)


def _cell(ax, cell, corner, norm, with_worst: bool) -> None:
    colour, text = "0.35", "–"
    look = {"facecolor": "white", "edgecolor": "0.85", "lw": 0.5}
    if cell.n and cell.kept_to_hz_median > 0:
        fill = colormaps[_COLOUR_MAP](norm(cell.kept_to_hz_median))
        colour = "white" if np.dot(fill[:3], (0.3, 0.59, 0.11)) < 0.5 else "black"
        look = {"facecolor": fill, "edgecolor": "white", "lw": 1}
        text = _hertz(cell.kept_to_hz_median, cell.band_end_hz)
        if with_worst and cell.n > 1:
            text += f"\n({_hertz(cell.kept_to_hz_worst, cell.band_end_hz)})"
    elif cell.n:
        look, colour = _HATCH, "black"
        percent = 100 * cell.static_share_median
        text = f"{percent:.0f} %" if percent >= 10 else f"{percent:.2g} %"
    ax.add_patch(Rectangle(corner, 1, 1, **look))
    ax.text(
        corner[0] + 0.5,
        corner[1] + 0.5,
        text,
        color=colour,
        ha="center",
        va="center",
        fontsize=8.5 if with_worst else 7,
        zorder=4,
        linespacing=1.05,
    )


def _hertz(value: float, band_end: float) -> str:
    text = f"{value:.0f}" if value >= 10 else f"{value:.2g}"
    return f"≥ {text}" if value >= band_end else text


def _legend(figure, options, up_to: float) -> None:
    links = "one link" if options.links == 1 else f"{options.links} links"
    figure.legend(
        [Patch(**_HATCH), Patch(**_FRAME)],
        [
            "exceeded at rest (median static share)",
            f"kept up to {up_to:g} Hz by every realisation",
        ],
        title=f"Transfer stiffness of {links} at most {options.stiffness_share_percent:g} % of the "
        f"mount's ({options.payload_mass_kg:g} kg at {options.suspension_axial_hz:g} Hz axial, "
        f"{options.suspension_radial_hz:g} Hz radial)",
        loc="outside lower center",
        ncols=2,
    )
