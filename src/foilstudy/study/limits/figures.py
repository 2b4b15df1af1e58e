"""The map as heat maps, and an example of every kind of failure."""

from __future__ import annotations

from textwrap import fill

import numpy as np
from matplotlib.patches import Rectangle

from foilstudy.plot import style
from foilstudy.plot.single import draw_shape
from foilstudy.study.kernel.plan import Record
from foilstudy.study.limits.map import QUANTITIES, Field, found, is_sound
from foilstudy.study.limits.published import OBSERVATIONS
from foilstudy.study.limits.settings import DEFAULT
from foilstudy.study.published import RADIUS

_ROW, _COLUMN, _LABELS, _TOP = 0.15, 0.43, 2.1, 1.1
"""Of a cell, of the names on the left and of what is above and below, inches."""
_FONT, _LETTERS_PER_INCH = 5.8, 18
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
_CLEAREST = {
    "saddle": lambda result: result["negative_eigenvalues"],
    "folded_globally": lambda result: result["broad_wave_share"],
    "hourglassed": lambda result: result["hidden_energy"],
    "locked": lambda result: result["membrane_energy"] / result["bending_energy"],
    "spurious": lambda result: -result["least_stiffness"],
    "self_crossing": lambda result: result["self_crossing_share"],
    "rate_dependent": lambda result: result["work_over_energy"] or 0.0,
}
"""By verdict that leaves a shape, what is greatest where it is clearest."""
_PICTURE = 2.1


@style.styled
def chart(fields: list[Field]):
    """Bias by method and foil, a mark for what speaks against it, what was published framed."""
    settings = list(dict.fromkeys(field.setting for field in fields))
    foils = list(dict.fromkeys(field.foil for field in fields))
    cells = {(field.setting, field.foil): field for field in fields}
    width = _LABELS + _COLUMN * len(foils) * len(QUANTITIES)
    figure = style.new_figure(width, _TOP + _ROW * len(settings))
    axes = figure.subplots(1, len(QUANTITIES), sharey=True)
    for ax, quantity in zip(axes, QUANTITIES, strict=True):
        _panel(ax, quantity, settings, foils, cells)
    axes[0].set_yticks(range(len(settings)), map(_row_words, settings), fontsize=_FONT)
    marks = ", ".join(f"{mark} {name.replace('_', ' ')}" for name, mark in _MARKS.items())
    seen = "; ".join(f"[{k}] {each.words}" for k, each in enumerate(OBSERVATIONS, 1))
    lines = [f"per cent over the default; {marks}", f"framed: published of it is {seen}"]
    wide = int(_LETTERS_PER_INCH * width)
    figure.supxlabel("\n".join(fill(line, wide) for line in lines), fontsize=_FONT)
    return figure


def _row_words(setting) -> str:
    numbers = [f"[{k}]" for k, each in enumerate(OBSERVATIONS, 1) if each.names(setting)]
    return " ".join([setting.words, *numbers])


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
            if any(each.marks(setting, foil.thickness_um) for each in OBSERVATIONS):
                ax.add_patch(Rectangle((j - 0.5, i - 0.5), 1, 1, fill=False, lw=0.9, zorder=3))
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
    """A sound crumple, and one example of every verdict against one that leaves a shape."""
    examples = _examples(fields)
    if not examples:
        return style.message_figure("no trial has left a shape")
    figure, axes = style.wrapped_grid(len(examples), 4, (_PICTURE, _PICTURE + 0.4), (0.2, 0.4))
    for ax, (name, field, record) in zip(axes.flat, examples):
        title = f"{name.replace('_', ' ')}: {field.foil.words}, {field.setting.words}"
        draw_shape(np.asarray(record.result["points"], float), RADIUS, title, ax)
        ax.set_title(title.replace(": ", "\n").replace(" mm, ", " mm\n"), fontsize=8)
        ax.set_axis_off()
    return figure


def _examples(fields: list[Field]) -> list[tuple[str, Field, Record]]:
    """The default, then by verdict the trial in which it is clearest."""
    shapes = [
        (field, record)
        for field in fields
        for record in field.records
        if np.size(record.result["points"])
    ]
    sound = [each for each in shapes if each[0].setting.method == DEFAULT and is_sound(each[1])]
    examples = [("sound", *each) for each in sound[:1]]
    for name, clear in _CLEAREST.items():
        having = [each for each in shapes if name in found(each[1])]
        if having:
            examples.append((name, *max(having, key=lambda each: clear(each[1].result))))
    return examples
