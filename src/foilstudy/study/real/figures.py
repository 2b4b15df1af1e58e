"""The chart that explains: levels and exponents of all models beside the measured ones."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.plot.style import PAGE_WIDTH, new_figure, styled, value_ticks
from foilstudy.study.real.laws import EXPONENTS, Found, Law, levels

_MARKS = {"stress-free": "o", "stress-free, contacts stuck": "^", "with its stresses": "s"}
_LEVELS = (0.03, 0.1, 0.3, 1, 3, 10, 30)
_OFFSET = 0.22


@styled
def chart(found: Found):
    """A row of panels for each direction, a line for each model."""
    models = list(dict.fromkeys(law.words for law in found.laws if law.step != "experiment"))
    figure = new_figure(PAGE_WIDTH, 1.6 + 0.62 * len(models) * len(DIRECTIONS))
    titles = {term: f"over measured,\nat {at:.3g} %" for term, at in levels().items()}
    titles |= {name: f"exponent of\n{name}" for name in EXPONENTS}
    panels = figure.subplots(len(DIRECTIONS), len(titles), sharey=True)
    for row, direction in zip(panels, DIRECTIONS):
        laws = [law for law in found.laws if law.direction == direction]
        for panel, term in zip(row, titles):
            _panel(panel, laws, models, term)
            if term in levels():
                panel.set_xscale("log")
                value_ticks(panel.xaxis, _LEVELS)
        row[0].set_ylabel(direction)
        row[0].set_yticks(range(len(models)), models)
        row[0].set_ylim(len(models) - 0.5, -0.5)
    for panel, title in zip(panels[0], titles.values()):
        panel.set_title(title)
    handles = {
        label: handle
        for panel in panels.ravel()
        for handle, label in zip(*panel.get_legend_handles_labels())
    }
    figure.legend(handles.values(), handles, loc="outside lower center", ncols=len(handles))
    return figure


def _panel(panel, laws: list[Law], models: list[str], term: str) -> None:
    for law in laws:
        known = law.terms[term]
        if law.step == "experiment":
            panel.axvline(known.value, color="k", lw=1.2, label="measured")
            if np.isfinite(known.low):
                panel.axvspan(known.low, known.high, color="0.85", zorder=0)
            continue
        states = list(_MARKS)
        shift = _OFFSET * (states.index(law.state) - 1) if law.of else 0.0
        ends = np.array([[known.value - known.low], [known.high - known.value]])
        panel.errorbar(
            known.value,
            models.index(law.words) + shift,
            xerr=ends if np.isfinite(ends).all() else None,
            fmt=_MARKS[law.state],
            color="0.45" if law.state == states[-1] else "0.1",
            mfc=None if law.state == states[-1] else "w",
            capsize=2.5,
            label=law.state,
        )
