"""Transfer stiffness of a link: level in narrow band and one-third octaves, and phase."""

from __future__ import annotations

import io
import re

import numpy as np
from matplotlib.ticker import FuncFormatter, MultipleLocator

from foilstudy.bench.transfer_level import level
from foilstudy.plot import style
from foilstudy.present.datasheet.facts import Direction, LinkFacts

__all__ = ["drawn_inline", "draw"]

_HALF_BAND = 10**0.05


@style.styled
def draw(facts: LinkFacts):
    """A column for each direction: level above, phase below.

    Returns
    -------
    matplotlib.figure.Figure
    """
    figure = style.new_figure(7.3, 3.2)
    axes = figure.subplots(
        2, len(facts.directions), sharex=True, sharey="row", height_ratios=(3, 1), squeeze=False
    )
    for column, direction in zip(axes.T, facts.directions):
        _level(column[0], facts, direction)
        _phase(column[1], facts, direction)
    axes[0, 0].set_ylabel("level (dB re 1 N/m)")
    axes[1, 0].set_ylabel("phase (°)")
    style.legend_below(figure, axes[:, :1], columns_max=3)
    return figure


def _level(ax, facts: LinkFacts, direction: Direction) -> None:
    (colour,) = style.ordered_colours(1)
    curves, bands = direction.curves, direction.bands
    known = np.isfinite(curves).any(axis=0)
    frequencies = facts.frequencies[known]
    style.median_band(
        ax, frequencies, level(curves[:, known]), colour,
        label="narrow band: median, least to largest",
    )  # fmt: skip
    left, right = bands.centres / _HALF_BAND, bands.centres * _HALF_BAND
    ax.hlines(bands.mean, left, right, color="#b2182b", lw=1.4, label="one-third octaves: mean")
    ax.set(xscale="log", title=direction.name)
    ax.yaxis.set_major_locator(MultipleLocator(10))


def _phase(ax, facts: LinkFacts, direction: Direction) -> None:
    (colour,) = style.ordered_colours(1)
    for curve in direction.curves:
        turned = np.degrees(np.angle(curve))
        turned[1:][np.abs(np.diff(turned)) > 180] = np.nan  # no line across a whole turn
        ax.plot(facts.frequencies, turned, color=colour, lw=0.6, alpha=0.6)
    ax.set(xlabel="frequency (Hz)", ylim=(-190, 190), yticks=(-180, 0, 180))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def drawn_inline(facts: LinkFacts) -> str:
    """The picture as an SVG element for a page."""
    text = io.StringIO()
    style.styled(draw(facts).savefig)(text, format="svg", metadata={"Date": None})
    return re.sub(r"^.*?(?=<svg )", "", text.getvalue(), flags=re.DOTALL)
