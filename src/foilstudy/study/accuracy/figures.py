"""How far off every word is, against its time."""

from __future__ import annotations

from foilstudy.base.confidence import Ratio
from foilstudy.plot.style import PAGE_WIDTH, marker, new_figure, styled, value_ticks
from foilstudy.study.accuracy.summary import QUANTITIES, Found

_TICKS = (0.5, 0.7, 1, 1.5, 2, 3, 5)
_GREYS = ("0.1", "0.45", "0.65", "0.3")


@styled
def chart(found: Found):
    """A panel for each quantity: ratio to what stands above, with its interval, over time."""
    words = {each.step: each.words for each in found.words}
    figure = new_figure(PAGE_WIDTH, 4.2)
    panels = figure.subplots(1, len(QUANTITIES), sharex=True, sharey=True)
    for panel, quantity in zip(panels, QUANTITIES):
        for k, each in enumerate(found.words):
            mean, ratio = each.means[quantity], each.ratios.get(quantity)
            # what others stand beside shows how well it is known itself
            shown = ratio or Ratio(1.0, mean.low / mean.mean, mean.high / mean.mean)
            beside = f" (over {words[each.beside]})" if each.beside else ""
            panel.errorbar(
                each.cpu_seconds,
                shown.value,
                yerr=[[shown.value - shown.low], [shown.high - shown.value]],
                fmt=marker(k),
                color=_GREYS[k % len(_GREYS)],
                capsize=2.5,
                label=f"{each.words}, {each.thickness_um} µm{beside}",
            )
        panel.axhline(1, color="k", lw=0.8, zorder=0)
        panel.set_xscale("log")
        panel.set_yscale("log")
        value_ticks(panel.yaxis, _TICKS)
        panel.set_title(quantity)
        panel.set_xlabel("processor time of a realisation, s")
    panels[0].set_ylabel("ratio of means")
    handles, labels = panels[0].get_legend_handles_labels()
    known = dict(zip(labels, handles))
    figure.legend(known.values(), known, loc="outside lower center", ncols=2)
    return figure
