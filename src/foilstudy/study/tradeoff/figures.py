"""Error against processor time, a panel for each family of settings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.plot import style
from foilstudy.study.tradeoff.points import Gathered, Row
from foilstudy.study.tradeoff.powers import EXPONENTS, Power, crumple_powers, step_powers

_ROW, _PER_POINT, _MARGIN = 2.1, 0.28, 0.6
"""Least height of a row of panels, what a point in it needs, and what stands around, inches."""
_LEAST = 1e-6
"""Errors below are drawn here."""
_SPAN = 4.0
"""Least ratio of the ends of a time axis; thrice that of errors."""
_FONT = 7.5
_OFFSETS = tuple((right, up) for up in (6, -6, 15, -15, 24, -24) for right in (5, -5))
"""Of labels from their points, size of both in points."""
_TITLES = {
    "energy": "strain energy",
    "shape": "shape",
    "axial": "axial stiffness",
    "radial": "radial stiffness",
    "reduction": "dynamic stiffness, largest error to 800 Hz",
    "grid": "magnitude between the frequencies, largest error",
}


@style.styled
def panel(study: Gathered):
    """The deterministic panel."""
    return _chart(study, _by_quantity(study, ["panel"]))


@style.styled
def static(study: Gathered):
    """Static stiffness of frozen shapes."""
    return _chart(study, _by_quantity(study, _ladders(study, "static")))


@style.styled
def dynamic(study: Gathered):
    """Dynamic stiffness of frozen shapes, one beside the other."""
    cells = _by_quantity(study, _ladders(study, "dynamic"))
    families = dict.fromkeys(cell.family for (cell,) in cells)
    return _chart(study, [[c for (c,) in cells if c.family == family] for family in families])


@style.styled
def ensemble(study: Gathered, ladder: str):
    """Means of an ensemble."""
    return _chart(study, _by_quantity(study, [ladder]))


@dataclass(frozen=True)
class _Cell:
    """What a panel shows."""

    ladder: str
    family: str
    quantity: str


def _ladders(study: Gathered, part: str) -> list[str]:
    names = dict.fromkeys(row.ladder for row in study.rows)
    return [name for name in names if name.split(",")[0] == part]


def _by_quantity(study: Gathered, ladders: list[str]) -> list[list[_Cell]]:
    """A row of panels for each ladder and family, a column for each quantity."""
    rows: dict[tuple[str, str], dict[_Cell, None]] = {}
    for row in study.rows:
        if row.ladder in ladders:
            cell = _Cell(row.ladder, row.family, row.quantity)
            rows.setdefault((row.ladder, row.family), {})[cell] = None
    return [list(cells) for cells in rows.values()]


def _chart(study: Gathered, cells: list[list[_Cell]]):
    columns = max(map(len, cells))
    height = max(_ROW, _PER_POINT * max(len(_shown(study, cell)) for row in cells for cell in row))
    figure = style.new_figure(style.PAGE_WIDTH, height * len(cells) + _MARGIN)
    axes = figure.subplots(len(cells), columns, squeeze=False)
    size = 72 * (style.PAGE_WIDTH - 1) / columns * 0.85, 72 * (height - 0.6)
    several = len({cell.ladder for row in cells for cell in row}) > 1
    for row, panels in zip(cells, axes, strict=True):
        for cell, ax in zip(row, panels, strict=True):
            _draw(ax, study.of(ladder=cell.ladder, quantity=cell.quantity), cell.family, size)
            where = cell.ladder.split(", ")[-1].replace("um", "µm") + ": " if several else ""
            ax.set_title(f"{where}{_TITLES[cell.quantity]}", fontsize=9)
        panels[0].set_ylabel(f"{row[0].family}\n\nerror (%)", fontsize=9)
    for ax in axes[-1]:
        ax.set_xlabel("processor time (s)")
    style.legend_below(figure, axes, 6, fontsize=8.5)
    return figure


def _shown(study: Gathered, cell: _Cell) -> list[Row]:
    return study.of(ladder=cell.ladder, family=cell.family, quantity=cell.quantity)


def _draw(ax, ladder: list[Row], family: str, size: tuple[float, float]) -> None:
    """The rows of one family, with the front of the whole ladder behind them.

    `size` is about that of the panel, points.
    """
    rows = [r for r in ladder if r.family == family and np.isfinite([r.error.bound, r.ratio]).all()]
    truths = {row.truth for row in rows}
    front = [row for row in ladder if row.front and row.truth in truths]
    front.sort(key=lambda row: row.seconds)
    ax.step(
        [row.seconds for row in front], [_ends(row)[1] for row in front], where="post",
        color="0.7", lw=1.0, ls="--", label="front of all settings, upper ends", zorder=1,
    )  # fmt: skip
    scatter = next((row.error.scatter for row in rows if np.isfinite(row.error.scatter)), None)
    if scatter is not None:
        ax.axhline(100 * scatter, color=style.GREY, lw=1.0, ls=":", label="scatter of realisations")
    for row in rows:
        _mark(ax, row)
    ends = [end for row in rows for end in _ends(row)]
    # labels stand to the right of their points
    times = [row.seconds for row in rows]
    _log_axis(ax.xaxis, [*times, 1.6 * max(times)], _SPAN)
    _log_axis(ax.yaxis, [*ends, *([] if scatter is None else [100 * scatter])], 3 * _SPAN)
    ax.tick_params(labelsize=8)
    _label(ax, rows, size)


def _log_axis(axis, values: list[float], least: float) -> None:
    """Limits with room for labels, at least a factor apart, and few ticks."""
    middle = np.sqrt(min(values) * max(values))
    half = max(1.6 * np.sqrt(max(values) / min(values)), np.sqrt(least))
    getattr(axis.axes, f"set_{axis.axis_name}scale")("log")
    getattr(axis.axes, f"set_{axis.axis_name}lim")(middle / half, middle * half)
    style.decade_ticks(axis)


def _ends(row: Row) -> tuple[float, float]:
    """Where a point is drawn, and the upper end of its interval, %."""
    bound = max(row.error.bound, _LEAST)
    # the reference has no error of its own, and chance may make others as small
    return 100 * max(abs(row.error.value), 0.1 * bound), 100 * bound


def _mark(ax, row: Row) -> None:
    error, high = _ends(row)
    if row.error.interval:
        low = max(100 * (abs(row.error.value) - row.error.interval), 0.1 * high)
        ax.plot([row.seconds] * 2, [low, high], color="0.5", lw=1.1)
    look = {"marker": "o", "mfc": "white", "ms": 5}
    if row.default:
        look = {"marker": "D", "mfc": "black", "ms": 7, "label": "default"}
    elif row.reference:
        look = {"marker": "s", "mfc": "0.75", "ms": 6, "label": "reference"}
    ax.plot(
        row.seconds,
        error,
        color="black",
        mec="black",
        ls="none",
        zorder=5 if row.default else 3,
        **look,
    )


def _label(ax, rows: list[Row], size: tuple[float, float]) -> None:
    """Values beside their points, where nothing stands yet; limits must be final, `size` in points.

    Labels and points are taken for boxes. The first of `_OFFSETS` that hits none is taken, or else
    the one that hits the fewest.
    """
    to_axes = ax.transData + ax.transAxes.inverted()
    points = {row: to_axes.transform((row.seconds, _ends(row)[0])) * size for row in rows}
    taken = [(x - 3, y - 3, x + 3, y + 3) for x, y in points.values()]
    for row, (x, y) in points.items():
        width, tries = 0.62 * _FONT * len(row.value), []
        for right, up in _OFFSETS:
            left = x + right - (width if right < 0 else 0.0)
            box = (left, y + up - _FONT / 2, left + width, y + up + _FONT / 2)
            outside = min(box[:2]) < 0 or box[2] > size[0] or box[3] > size[1]
            hits = sum(_overlap(box, other) for other in taken)
            tries.append((hits + outside, (right, up), box))
        _, offset, box = min(tries, key=lambda each: each[0])
        taken.append(box)
        ax.annotate(
            row.value, (row.seconds, _ends(row)[0]), xytext=offset, textcoords="offset points",
            fontsize=_FONT, va="center", ha="right" if offset[0] < 0 else "left", zorder=4,
            fontweight="bold" if row.default else "normal",
        )  # fmt: skip


def _overlap(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    across = one[0] < other[2] and other[0] < one[2]
    return across and one[1] < other[3] and other[1] < one[3]


@style.styled
def run_time(study: Gathered):
    """Time of a step, and of a whole crumple, against element size."""
    figure = style.new_figure(style.PAGE_WIDTH, 4.4)
    steps, whole = figure.subplots(1, 2)
    for index, power in enumerate(step_powers(study)):
        _draw_power(steps, power, index)
    for power in crumple_powers(study):
        _draw_power(whole, power, 0)
        for index, (name, exponent) in enumerate(EXPONENTS.items(), start=1):
            line = power.seconds[-1] * (power.sizes_mm / power.sizes_mm[-1]) ** exponent
            whole.plot(power.sizes_mm, line, color=style.GREY, lw=1.0, ls=style.line_style(index),
                       label=f"{name}: {exponent:g}")  # fmt: skip
    for ax, title in ((steps, "a step"), (whole, "a crumple, mean of the seeds")):
        ax.set_xscale("log")
        ax.set_yscale("log")
        style.value_ticks(ax.xaxis, sorted({x for line in ax.lines for x in line.get_xdata()}))
        ax.set_xlabel("element size (mm)")
        ax.set_ylabel("processor time (s)")
        ax.set_title(title)
        ax.legend(fontsize=8.5)
    return figure


def _draw_power(ax, power: Power, index: int) -> None:
    ax.plot(power.sizes_mm, power.seconds, color="black", marker=style.marker(index),
            ls=style.line_style(index), label=power.words)  # fmt: skip
