"""Split of the strain energy per configuration."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.statistics.cells import sound

_PARTS = {"bending": ("0.35", ""), "membrane": ("0.65", ""), "stabilisation": ("#d95f02", "///")}


@style.styled
def draw(cube):
    """Draw one panel per thickness, one bar per overlength."""
    usable = sound(cube)
    parts = {
        name: cube[f"{name}_energy"]
        .where(usable)
        .mean("seed")
        .transpose("thickness", "overlength")
        .to_numpy()
        for name in _PARTS
    }
    thicknesses = cube["thickness"].to_numpy()
    overlengths = cube["overlength"].to_numpy()
    figure, axes = style.wrapped_grid(thicknesses.size, 4, (2.2, 3.0), (2.2, 0.5), sharey=True)
    for i, (ax, thickness) in enumerate(zip(axes.flat, thicknesses)):
        ax.set_title(style.thickness_label(thickness), pad=16)
        _bars(ax, {name: values[i] for name, values in parts.items()}, overlengths)
    for ax in axes[:, 0]:
        ax.set_ylabel("share of strain energy (%)")
    style.legend_below(figure, axes)
    return figure


def _bars(ax, parts, overlengths) -> None:
    total = sum(parts.values())
    known = np.isfinite(total) & (total > 0)
    if not known.any():
        style.message_panel(ax, "no usable realisation")
        return
    x = np.arange(overlengths.size)
    base = np.zeros(overlengths.size)
    for name, (colour, hatch) in _PARTS.items():
        share = np.where(known, 100 * parts[name] / np.where(known, total, 1), 0)
        ax.bar(
            x, share, 0.78, base, color=colour, hatch=hatch, edgecolor="white", lw=0.6, label=name
        )
        base = base + share
    for i in x:
        text = _joules(total[i]) if known[i] else "none\nusable"
        ax.text(i, 102 if known[i] else 2, text, ha="center", va="bottom", fontsize=8, color="0.25")
    ax.set_ylim(0, 100)
    ax.grid(axis="x", visible=False)
    ax.set_xticks(x, [style.overlength_label(o)[:-2] for o in overlengths])
    ax.set_xlabel("overlength (%)")


def _joules(energy: float) -> str:
    factor, unit = next(
        ((f, u) for f, u in ((1, "J"), (1e3, "mJ")) if energy * f >= 0.1), (1e6, "µJ")
    )
    return f"{energy * factor:.2g} {unit}"
