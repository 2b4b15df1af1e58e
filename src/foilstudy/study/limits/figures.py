"""The map as heat maps, and an example of every kind of failure."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.verdicts import VERDICTS
from foilstudy.plot import style
from foilstudy.plot.single import draw_shape
from foilstudy.study.kernel.plan import Record
from foilstudy.study.limits.map import QUANTITIES, Field, found
from foilstudy.study.published import RADIUS

_ROW, _COLUMN, _LABELS, _TOP = 0.15, 0.58, 2.2, 0.8
"""Of a cell, of the names on the left and of the heads above, inches."""
_FONT = 5.5
_WORST = 0.6
"""Bias at which the colour is full."""
_MARKS = {
    "diverged": "X",
    "budget_spent": "B",
    "not_converged": "N",
    "saddle": "S",
    "singular": "0",
    "folded_globally": "F",
    "hourglassed": "H",
    "locked": "L",
    "rate_dependent": "R",
    "spurious": "?",
}
"""Of what speaks against a method, in the map."""
_SHOWN = (
    "converged",
    "saddle",
    "folded_globally",
    "hourglassed",
    "locked",
    "spurious",
    "not_converged",
)
_PICTURE = 2.3


@style.styled
def chart(fields: list[Field]):
    """Bias by method and foil, with a mark for what speaks against it."""
    settings = list(dict.fromkeys(field.setting for field in fields))
    foils = list(dict.fromkeys(field.foil for field in fields))
    cells = {(field.setting, field.foil): field for field in fields}
    width = _LABELS + _COLUMN * len(foils) * len(QUANTITIES) + 0.4
    figure = style.new_figure(width, _TOP + _ROW * len(settings) + 0.5)
    axes = figure.subplots(1, len(QUANTITIES), sharey=True)
    for ax, quantity in zip(axes, QUANTITIES, strict=True):
        _panel(ax, quantity, settings, foils, cells)
    axes[0].set_yticks(range(len(settings)), [s.words for s in settings], fontsize=_FONT)
    marks = ", ".join(f"{mark} {name.replace('_', ' ')}" for name, mark in _MARKS.items())
    figure.supxlabel(f"per cent over the default; {marks}", fontsize=_FONT, wrap=True)
    return figure


def _panel(ax, quantity, settings, foils, cells) -> None:
    values = np.full((len(settings), len(foils)), np.nan)
    for i, setting in enumerate(settings):
        for j, foil in enumerate(foils):
            field = cells.get((setting, foil))
            if field is None:
                continue
            bias = field.bias[quantity].value
            values[i, j] = bias
            marks = "".join(m for name, m in _MARKS.items() if field.verdicts[name])
            text = f"{100 * bias:+.0f}" if np.isfinite(bias) else ""
            dark = abs(bias) > 0.6 * _WORST
            ax.text(
                j, i, f"{text} {marks}".strip(), ha="center", va="center", fontsize=_FONT,
                color="white" if dark else "black",
            )  # fmt: skip
    ax.imshow(
        np.clip(values, -_WORST, _WORST), cmap="RdBu_r", vmin=-_WORST, vmax=_WORST, aspect="auto"
    )
    ax.set_xticks(range(len(foils)), [f.words.replace(", ", "\n") for f in foils], fontsize=_FONT)
    ax.xaxis.tick_top()
    ax.set_title({"energy": "strain energy"}.get(quantity, f"{quantity} stiffness"), fontsize=8)
    groups = [s.group for s in settings]
    for i in range(1, len(groups)):
        if groups[i] != groups[i - 1]:
            ax.axhline(i - 0.5, color="black", linewidth=0.6)
    ax.grid(False)
    ax.tick_params(length=0)
    for side in ax.spines.values():
        side.set_visible(False)


@style.styled
def gallery(fields: list[Field]):
    """One example of every verdict that leaves a shape."""
    examples = _examples(fields)
    if not examples:
        return style.message_figure("no trial has left a shape")
    figure, axes = style.wrapped_grid(len(examples), 4, (_PICTURE, _PICTURE + 0.4), (0.2, 0.4))
    for ax, (name, field, record) in zip(axes.flat, examples):
        title = f"{name.replace('_', ' ')}: {field.foil.words}, {field.setting.words}"
        draw_shape(np.asarray(record.result["points"], float), RADIUS, title, ax)
        ax.set_title(title.replace(": ", "\n").replace(" mm, ", " mm\n"), fontsize=_FONT)
        ax.set_xlabel("")
        ax.set_xticks([])
        ax.set_yticks([])
    return figure


def _examples(fields: list[Field]) -> list[tuple[str, Field, Record]]:
    """By verdict, the first trial that has it and, if there is one, no other that is rarer."""
    order = [v.name for v in VERDICTS if v.name in _SHOWN]
    examples = []
    for name in order:
        having = [
            (len(found(record)), i, field, record)
            for i, field in enumerate(fields)
            for record in field.records
            if name in found(record) and np.size(record.result["points"])
        ]
        if having:
            _, _, field, record = min(having, key=lambda each: each[:2])
            examples.append((name, field, record))
    return examples
