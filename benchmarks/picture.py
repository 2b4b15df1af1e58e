"""The roofline: operations a second against operations per byte, with the limits of the machine."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from peak import Machine

from foilstudy.plot import style
from foilstudy.plot.save import PNG_DPI

_SIZE = (7.0, 4.6)
_INTENSITIES = (0.05, 30.0)
"""Ends of the axis, operations per byte."""


@dataclass(frozen=True)
class Point:
    """A kernel on one mesh.

    Attributes
    ----------
    name, level : str
        Of the mesh, and of the cache that holds what is moved.
    operations, bytes : float
        Per element.
    flops, flops_most : float
        Operations in a second, by the median and the least time.
    """

    name: str
    level: str
    operations: float
    bytes: float
    flops: float
    flops_most: float

    @property
    def intensity(self) -> float:
        """Operations per byte."""
        return self.operations / self.bytes

    @property
    def bandwidth(self) -> float:
        """Bytes in a second."""
        return self.flops / self.intensity


@style.styled
def draw(points: Sequence[Point], limits: Machine, path: Path) -> None:
    """Write the picture as PNG."""
    figure = style.new_figure(*_SIZE)
    ax = figure.subplots()
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(_INTENSITIES)
    slowest = min(point.flops for point in points) / 1e9
    ax.set_ylim(min(1.0, 0.3 * slowest), 3 * limits.peak / 1e9)
    _limits(ax, limits)
    look = {"fontsize": 8.5, "title_fontsize": 8.5, "alignment": "left"}
    ax.add_artist(ax.legend(title="bandwidths", loc="upper left", **look))
    marks = [_mark(ax, point, index) for index, point in enumerate(points)]
    ax.legend(handles=marks, title="force kernel", loc="lower right", **look)
    style.decade_ticks(ax.xaxis)
    style.decade_ticks(ax.yaxis)
    ax.set_xlabel("operations per byte that must be moved (flop/B)")
    ax.set_ylabel("operations in a second (Gflop/s)")
    figure.savefig(path, dpi=PNG_DPI)


def _limits(ax, limits: Machine) -> None:
    """Sloping lines of the bandwidths up to the peak, level ones of what units can do."""
    peak = limits.peak / 1e9
    for index, (name, bandwidth) in enumerate(limits.bandwidths.items()):
        speed = bandwidth / 1e9
        x = np.array([_INTENSITIES[0], peak / speed])
        ax.plot(x, speed * x, color="0.35", lw=1.2, ls=style.line_style(index),
                label=f"{name}, {speed:.0f} GB/s")  # fmt: skip
    heights = {
        f"matrix product, {limits.product_flops / 1e9:.0f} Gflop/s": limits.product_flops,
        f"multiply-adds, vectors of {limits.vector_bits} bits, {limits.flops / 1e9:.0f} Gflop/s":
            limits.flops,
        "the same, additions and multiplications apart": limits.flops / 2,
    }  # fmt: skip
    for name, flops in heights.items():
        y = flops / 1e9
        ax.plot([y / max(limits.bandwidths.values()) * 1e9, _INTENSITIES[1]], [y, y], "k", lw=1.2)
        ax.annotate(name, (_INTENSITIES[1], y), xytext=(-2, 3), textcoords="offset points",
                    ha="right", fontsize=8.5,
                    bbox={"color": "white", "pad": 0.5})  # fmt: skip


def _mark(ax, point: Point, index: int):
    """A point from its median to its best time."""
    speeds = np.array([point.flops, point.flops_most]) / 1e9
    words = f"{point.name}, in {point.level}: {speeds[0]:.1f} Gflop/s"
    ax.plot([point.intensity] * 2, speeds, color="0.5", lw=1.1)
    (line,) = ax.plot(
        point.intensity, speeds[0], color="black", mfc="white", mec="black", ms=7, ls="none",
        marker=style.marker(index), label=words,
    )  # fmt: skip
    return line
