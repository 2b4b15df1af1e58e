"""Split of the strain energy per configuration."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.cells import PLASTIC_RELIEF, sound

_PARTS = {"bending": ("0.35", ""), "membrane": ("0.65", ""), "stabilisation": ("#d95f02", "///")}
_RELIEF = {"plastic_relief": ("#7570b3", "\\\\")}
"""Negative: it hangs below the axis, and what stands above is that much more than what is left."""


@style.styled
def draw(cube):
    """Draw one panel per thickness, one bar per overlength."""
    usable = sound(cube)
    shown = _PARTS | (_RELIEF if PLASTIC_RELIEF in cube else {})
    parts = {
        name: cube[f"{name}_energy"]
        .where(usable)
        .mean("seed")
        .transpose("thickness", "overlength")
        .to_numpy()
        for name in shown
    }
    thicknesses = cube["thickness"].to_numpy()
    overlengths = cube["overlength"].to_numpy()
    figure, axes = style.wrapped_grid(thicknesses.size, 4, (2.2, 3.0), (2.2, 0.5), sharey=True)
    ends = [(0.0, 100.0)]
    for i, (ax, thickness) in enumerate(zip(axes.flat, thicknesses)):
        ax.set_title(style.thickness_label(thickness), pad=16)
        ends += _bars(ax, {name: values[i] for name, values in parts.items()}, overlengths)
    axes.flat[0].set_ylim(1.05 * min(low for low, _ in ends), max(high for _, high in ends))
    for ax in axes[:, 0]:
        ax.set_ylabel("share of strain energy (%)")
    style.legend_below(figure, axes)
    return figure


def _bars(ax, parts, overlengths) -> list[tuple[float, float]]:
    """Draw one panel; the lowest and the highest share in it, if it has any."""
    total = sum(parts.values())
    known = np.isfinite(total) & (total > 0)
    if not known.any():
        style.message_panel(ax, "no usable realisation")
        return []
    x = np.arange(overlengths.size)
    base, below = np.zeros(overlengths.size), 0.0
    for name, values in parts.items():
        colour, hatch = (_PARTS | _RELIEF)[name]
        share = np.where(known, 100 * values / np.where(known, total, 1), 0)
        ax.bar(
            x, share, 0.78, np.where(share < 0, 0, base), color=colour, hatch=hatch,
            edgecolor="white", lw=0.6, label=name.replace("_", " "),
        )  # fmt: skip
        base, below = base + np.maximum(share, 0), min(below, share.min())
    top = base.max() if below < 0 else 100
    for i in x:
        text = _joules(total[i]) if known[i] else "none\nusable"
        height = 1.02 * top if known[i] else 2
        ax.text(i, height, text, ha="center", va="bottom", fontsize=8, color="0.25")
    ax.grid(axis="x", visible=False)
    ax.set_xticks(x, [style.overlength_label(o)[:-2] for o in overlengths])
    ax.set_xlabel("overlength (%)")
    return [(below, top)]


def _joules(energy: float) -> str:
    factor, unit = next(
        ((f, u) for f, u in ((1, "J"), (1e3, "mJ")) if energy * f >= 0.1), (1e6, "µJ")
    )
    return f"{energy * factor:.2g} {unit}"
