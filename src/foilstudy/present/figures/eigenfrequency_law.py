"""First eigenfrequency against reference height."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.comparison import comparable
from foilstudy.present.statistics.cells import samples
from foilstudy.present.statistics.eigenfrequency import fit_eigenfrequency_law


@style.styled
def draw(cube):
    """Draw the law of every thickness, beside the published exponent where there is one."""
    data = samples(cube, "first_eigenfrequency")
    reference = comparable(cube)
    published = reference.first_eigenfrequency_exponents if reference else {}
    thicknesses = cube["thickness"].to_numpy()
    heights = cube["reference_height"].to_numpy()
    if not data.value.size:
        return style.message_figure()
    figure = style.new_figure(8.6, 4.8)
    ax = figure.subplots()
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(style.span(heights, 1.06))
    ax.set_ylim(style.span(data.value, 1.25))
    labels = []
    for i, (thickness, colour) in enumerate(style.coloured(thicknesses)):
        mine = data.at_thickness(thickness)
        if mine.value.size:
            known = published.get(float(thickness))
            end = _series(ax, mine, colour, style.marker(i), known)
            labels.append((end, _label(thickness, fit_eigenfrequency_law(mine), known), colour))
    style.value_ticks(ax.xaxis, heights)
    style.decade_ticks(ax.yaxis)
    ax.set_xlabel("reference height (mm)")
    ax.set_ylabel("first eigenfrequency (Hz)")
    style.label_ends(ax, 1.015, labels, gap=0.12, fontsize=9.5)
    return figure


def _series(ax, data, colour, symbol: str, published: float | None) -> float:
    """Draw one thickness; return where its label belongs on the vertical axis."""
    height = np.geomspace(*ax.get_xlim(), 50)
    ax.plot(data.reference_height_mm, data.value, ".", color=colour, ms=4, alpha=0.5)
    for h in np.unique(data.reference_height_mm):
        mean = data.value[data.reference_height_mm == h].mean()
        ax.plot(h, mean, symbol, color=colour, ms=6.5, mec="white", mew=0.6)
    fit = fit_eigenfrequency_law(data)
    centre = np.exp(np.log(data.value).mean())
    if np.isnan(fit.value["reference_height"]):
        return centre
    mean, low, high = fit.predict({"reference_height": np.log(height)})
    ax.plot(height, np.exp(mean), color=colour)
    if np.isfinite(low).all():
        ax.fill_between(
            height, np.exp(low), np.exp(high), color=colour, alpha=style.BAND_ALPHA, lw=0
        )
    if published is not None:
        middle = np.exp(np.log(data.reference_height_mm).mean())
        ax.plot(height, centre * (height / middle) ** published, color="k", ls="--", lw=1.2)
    return float(np.exp(mean[-1]))


def _label(thickness: float, fit, published: float | None) -> str:
    name = style.thickness_label(thickness)
    exponent = fit.value["reference_height"]
    if not np.isfinite(exponent):
        return name
    text = f"{name}: $n$ = {exponent:.2f}"
    if np.isfinite(fit.low["reference_height"]):
        text += f" [{fit.low['reference_height']:.2f}, {fit.high['reference_height']:.2f}]"
    if published is not None:
        text += f"\npublished {published:.2f} (dashed)"
    return text.replace("-", "−")
