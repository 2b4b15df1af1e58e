"""One figure per benchmark: convergence of every element, published points, and shapes."""

from __future__ import annotations

from collections.abc import Sequence

import matplotlib as mpl
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.ticker import NullFormatter

from foilstudy.plot import style
from foilstudy.plot.render import COLOUR_MAP, View
from foilstudy.study.verification.records import Benchmark, Picture, Plot

_PANEL_HEIGHT = 4.0
_LEGEND_LINE = 0.19
_TALLEST_PICTURE = 3.6
"""Inches."""
_PICTURES_PER_ROW = 4
_FEW_LINES = 45
"""Up to so many lines in both directions a picture shows its mesh."""
_LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])
_BELOW = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.15), "fontsize": 8.5}
_BESIDE = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)}
_SMALLEST_ERROR = 1e-6
"""Errors below this are left out of the plot: rounding, not convergence."""


def draw_one(benchmarks: Sequence[Benchmark], name: str):
    """Draw the benchmark of a name with all its elements."""
    return draw([benchmark for benchmark in benchmarks if benchmark.name == name])


@style.styled
def draw(benchmarks: Sequence[Benchmark]):
    """Draw one benchmark with several elements.

    Parameters
    ----------
    benchmarks : sequence of Benchmark
        The same one, an element each; curves and shapes are drawn of the first.
    """
    plot, pictures = benchmarks[0].plot, benchmarks[0].pictures
    across = min(len(pictures), _PICTURES_PER_ROW)
    panels = [_Panel(picture) for picture in pictures]
    rows = -(-len(panels) // across) if panels else 0
    tallest = max((panel.aspect for panel in panels), default=0.0)
    heights = [_PANEL_HEIGHT]
    if plot:  # the legends stand below the axes
        heights[0] += _LEGEND_LINE * max(len(benchmarks[0].quantities) + 1, 2 * len(plot.curves))
    if rows:
        heights.append(rows * (min(style.PAGE_WIDTH / across * tallest, _TALLEST_PICTURE) + 0.3))
    figure = style.new_figure(style.PAGE_WIDTH, sum(heights))
    parts = np.atleast_1d(figure.subfigures(len(heights), 1, height_ratios=heights))
    count = len(benchmarks)
    axes = parts[0].subplots(1, count + bool(plot), squeeze=False)[0]
    for ax, benchmark in zip(axes, benchmarks):
        _convergence(ax, benchmark)
    _share_errors(axes[:count])
    axes[0].set_ylabel("relative error")
    if plot:
        axes[0].legend(**_BELOW)
        _curves(axes[-1], plot, benchmarks[0].element)
    else:
        axes[-1].legend(**_BESIDE)
    if rows:
        grid = parts[1].subplots(rows, across, squeeze=False).ravel()
        for ax in grid:
            ax.set_axis_off()
        for ax, panel in zip(grid, panels):
            panel.draw(ax)
    return figure


def _convergence(ax, benchmark: Benchmark) -> None:
    """Relative error against elements, both logarithmic, with the slope that theory expects."""
    ax.set_xscale("log")
    ax.set_yscale("log")
    colours = style.ordered_colours(len(benchmark.quantities))
    shown = []
    for i, (quantity, colour) in enumerate(zip(benchmark.quantities, colours)):
        error = np.abs(quantity.errors)
        error[error < _SMALLEST_ERROR] = np.nan
        ax.plot(
            quantity.meshes, error, color=colour, marker=style.marker(i), ms=5,
            ls=style.line_style(i), label=quantity.name,
        )  # fmt: skip
        if quantity.expected_rate is not None and np.isfinite(error).any():
            shown.append((quantity, np.nanmax(error)))
    if shown:
        quantity, largest = max(shown, key=lambda pair: pair[1])
        ends = np.array([quantity.meshes[0], quantity.meshes[-1]], float)
        slope = 1.6 * largest * (ends / ends[0]) ** -quantity.expected_rate
        ax.plot(ends, slope, color=style.GREY, lw=1.0, label="order expected")
        ax.annotate(
            f"order {quantity.expected_rate:g}", (ends[0], slope[0]), (4, 2),
            textcoords="offset points", color=style.GREY, fontsize=8.5,
        )  # fmt: skip
    ticks = sorted({mesh for quantity in benchmark.quantities for mesh in quantity.meshes})
    ax.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.tick_params(axis="x", which="minor", length=0)
    sides = dict.fromkeys(quantity.side for quantity in benchmark.quantities)
    ax.set_xlabel(f"elements along the {', the '.join(sides)}")
    ax.set_title(f"element {benchmark.element.replace('_', ' ')}")


def _share_errors(axes) -> None:
    """The same limits for all elements, so that heights compare."""
    limits = np.array([ax.get_ylim() for ax in axes])
    for ax in axes:
        ax.set_ylim(limits[:, 0].min(), limits[:, 1].max())


def _curves(ax, plot: Plot, element: str) -> None:
    for i, (curve, colour) in enumerate(style.coloured(plot.curves)):
        ax.plot(curve.x, curve.y, color=colour, label=curve.label)
        if len(curve.published_x):
            ax.plot(
                curve.published_x, curve.published_y, style.marker(i), color=colour, mfc="white",
                ms=6, label=f"{curve.label}, published",
            )  # fmt: skip
    ax.set_xlabel(plot.x_label)
    ax.set_ylabel(plot.y_label)
    ax.set_title(f"finest mesh, element {element.replace('_', ' ')}")
    ax.legend(**_BELOW)


class _Panel:
    """A surface as quadrilaterals, to be painted from the back to the front."""

    def __init__(self, picture: Picture):
        self._title = picture.title
        points, colour = np.array(picture.points), np.array(picture.colour)
        screen = np.einsum("ij,jrc->irc", View(elevation_deg=25.0).axes(), points)
        self._size = np.ptp(screen[:2].reshape(2, -1), axis=1)
        self._corner = screen[:2].min(axis=(1, 2))
        low, high = slice(None, -1), slice(1, None)
        corners = [(low, low), (low, high), (high, high), (high, low)]
        quads = np.stack([screen[(slice(None), *c)] for c in corners], axis=-1)
        order = np.argsort(quads[2].mean(axis=-1).ravel())
        normal = np.cross(quads[..., 2] - quads[..., 0], quads[..., 3] - quads[..., 1], axis=0)
        light = np.abs(np.tensordot(_LIGHT, normal, axes=1)) / np.linalg.norm(normal, axis=0)
        value = np.mean([colour[c] for c in corners], axis=0)
        rgb = mpl.colormaps[COLOUR_MAP](0.5 + 0.5 * value)[..., :3]
        shaded = rgb * (0.55 + 0.45 * light)[..., None]
        self._rgb = shaded.reshape(-1, 3)[order]
        self._quads = quads[:2].reshape(2, -1, 4).transpose(1, 2, 0)[order]
        self._mesh = max(colour.shape) <= _FEW_LINES

    @property
    def aspect(self) -> float:
        """Height over width as seen."""
        return self._size[1] / self._size[0]

    def draw(self, ax) -> None:
        """Paint into axes that are off."""
        edges = {"edgecolors": (0, 0, 0, 0.25)} if self._mesh else {"edgecolors": "face"}
        ax.add_collection(
            PolyCollection(
                self._quads, facecolors=self._rgb, linewidths=0.25, rasterized=True, **edges
            )
        )
        margin = 0.02 * self._size.max()
        ax.set_xlim(self._corner[0] - margin, self._corner[0] + self._size[0] + margin)
        ax.set_ylim(self._corner[1] - margin, self._corner[1] + self._size[1] + margin)
        ax.set_aspect("equal")
        ax.set_title(self._title, fontsize=9)
