"""Stiffness with the stress left in, beside the stress-free one and the measured one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.plot import style
from foilstudy.present.comparison import comparable
from foilstudy.present.statistics.cells import measured
from foilstudy.present.statistics.powerlaw import PRESTRESSED, SIMULATED

_DARK, _LIGHT = style.ordered_colours(2)
_BOTTOM = 0.045
"""Height of the marks of values that a logarithmic axis cannot show, in axes fractions."""


@dataclass(frozen=True)
class _Series:
    """One stiffness of the cube and how it looks; `shift` keeps the series side by side."""

    source: str
    label: str
    symbol: str
    colour: object
    fill: object
    shift: float

    @property
    def marks(self) -> dict:
        """Keywords of matplotlib for its marks."""
        return {"color": self.colour, "mfc": self.fill, "mew": 1.3}


_SERIES = (
    _Series("simulation mesh limit", "stress-free, mesh limit", "s", _DARK, "white", 0.92),
    _Series(PRESTRESSED, "pre-stressed, crumpled mesh", "o", _DARK, _DARK, 1.0),
    _Series(
        "simulation pre-stressed refined", "pre-stressed, relaxed again", "^", "k", _LIGHT, 1.09
    ),
)


@style.styled
def draw(cube):
    """Draw one row per direction and one panel per thickness."""
    directions = list(map(str, cube["direction"].values))
    thicknesses = cube["thickness"].to_numpy()
    overlengths = cube["overlength"].to_numpy()
    series = [s for s in _SERIES if _known(cube, s)]
    reference = comparable(cube)
    figure, axes = style.panel_grid(
        len(directions), thicknesses.size, (2.2, 3.0), (2.6, 0.7), sharey="row"
    )
    if not any(s.source.startswith(PRESTRESSED) for s in series):
        style.message_panel(axes, "no usable realisation with a pre-stressed stiffness")
        return figure
    for row, direction in zip(axes, directions):
        for ax, thickness in zip(row, thicknesses):
            ax.set_yscale("log")
            style.overlength_axis(ax, overlengths)
            at = {"direction": direction, "thickness": thickness}
            for s in series:
                _draw_series(ax, s, measured(cube, SIMULATED[s.source], **at), overlengths)
            if reference:
                law = reference.power_laws[direction]["experiment"].law
                _experiment(ax, law, thickness, overlengths)
            ax.set_xlabel(ax.get_xlabel() if direction == directions[-1] else "")
        # Room for the marks at the bottom, which lie in no data range.
        low, high = row[0].get_ylim()
        row[0].set_ylim(low / (high / low) ** (2 * _BOTTOM), high)
        style.decade_ticks(row[0].yaxis)
        row[0].set_ylabel(f"{direction} stiffness (N/m)")
    for ax, thickness in zip(axes[0], thicknesses):
        ax.set_title(style.thickness_label(thickness))
    by_label = {
        label: handle
        for ax in axes.flat
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)
    }
    figure.legend(by_label.values(), by_label, loc="outside lower center", ncols=2)
    return figure


def _known(cube, series: _Series) -> bool:
    name = SIMULATED[series.source]
    return name in cube and bool(np.isfinite(measured(cube, name)).any())


def _draw_series(ax, series: _Series, values, overlengths) -> None:
    columns = [
        column[np.isfinite(column)] for column in values.transpose("overlength", "seed").values
    ]
    drawn = [(x, c) for x, c in zip(overlengths, columns) if c.size and np.median(c) > 0]
    if drawn:
        middle = np.array([np.median(column) for _, column in drawn])
        lowest = np.array([column[column > 0].min() for _, column in drawn])
        highest = np.array([column.max() for _, column in drawn])
        ax.errorbar(
            np.array([x for x, _ in drawn]) * series.shift,
            middle,
            # the middle of a value above zero and one below may lie under all that are above
            yerr=[np.maximum(middle - lowest, 0), highest - middle],
            fmt=series.symbol,
            ms=5.5,
            elinewidth=1,
            label=series.label,
            **series.marks,
        )
    for overlength, column in zip(overlengths, columns):
        if count := int((column <= 0).sum()):
            _mark_hidden(ax, overlength, count, series)


def _mark_hidden(ax, overlength: float, count: int, series: _Series) -> None:
    """Mark at the bottom how many values are not positive."""
    if not ax.texts:
        ax.text(0.01, 2 * _BOTTOM, "≤ 0", transform=ax.transAxes, va="center", fontsize=8)
    transform = ax.get_xaxis_transform()
    x = overlength * series.shift
    ax.plot(
        x, 2 * _BOTTOM, series.symbol, ms=4.5, transform=transform, clip_on=False, **series.marks
    )
    # Away from each other, so that two counts do not read as one.
    side = "left" if series.shift > 1 else "right"
    ax.text(x, 0, f"{count}", transform=transform, ha=side, va="bottom", fontsize=7)


def _experiment(ax, law, thickness: float, overlengths) -> None:
    fine = np.geomspace(*style.span(overlengths, 1.15), 60)
    ax.plot(
        fine,
        law.stiffness(fine, thickness),
        color=style.GREY,
        ls="-.",
        lw=1.3,
        label="published experiment (fit)",
    )
