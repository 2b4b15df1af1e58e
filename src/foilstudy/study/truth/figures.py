"""What ways of crumpling do to the true stiffness, as ratios with their intervals."""

from __future__ import annotations

from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.plot.style import PAGE_WIDTH, new_figure, styled, value_ticks
from foilstudy.study.truth.influences import SHOWN, Found, Influence

_TICKS = (0.1, 0.2, 0.5, 1, 2, 5)
_MARKS = {SHOWN[0]: ("s", "0.1", 0.15), SHOWN[1]: ("o", "0.55", -0.15)}
"""Mark, grey and place of each state."""


@styled
def chart(found: Found):
    """A panel for each direction, a line for each way that stands beside another."""
    words = {each.step: each.words for each in found.influences}
    ratios = [each for each in found.influences if each.ratio is not None]
    lines = {_place(e): f"{e.words},\n{e.thickness_um} µm, over {words[e.beside]}" for e in ratios}
    places = {line: place for place, line in enumerate(lines)}
    figure = new_figure(PAGE_WIDTH, 1.2 + 0.5 * len(lines))
    panels = figure.subplots(1, len(DIRECTIONS), sharey=True)
    for panel, direction in zip(panels, DIRECTIONS):
        for each in (each for each in ratios if each.direction == direction):
            mark, grey, shift = _MARKS[each.state]
            ratio = each.ratio
            panel.errorbar(
                ratio.value,
                places[_place(each)] - shift,
                xerr=[[ratio.value - ratio.low], [ratio.high - ratio.value]],
                fmt=mark,
                color=grey,
                capsize=2.5,
                label=each.state,
            )
        panel.axvline(1, color="k", lw=0.8, zorder=0)
        panel.set_xscale("log")
        value_ticks(panel.xaxis, _TICKS)
        panel.set_xlabel(f"ratio of mean stiffness, {direction}")
    panels[0].set_yticks(range(len(lines)), lines.values())
    panels[0].set_ylim(len(lines) - 0.5, -0.5)
    handles, labels = panels[0].get_legend_handles_labels()
    known = dict(zip(labels, handles))
    figure.legend(known.values(), known, loc="outside lower center", ncols=len(known))
    return figure


def _place(each: Influence) -> tuple[str, int, int]:
    return each.step, each.thickness_um, each.height_mm
