"""Height, reaction force, energies and residual of one crumpling history."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.plot.crumples import catalogue, read_history, typical_configuration

_SHELL = ("bending", "membrane", "stabilisation")
_LINES = ("-", "--", "-.", ":", (0, (5, 1)))


@style.styled
def draw(crumple_paths):
    """Draw the history of one realisation of the thickest foil at its middle overlength."""
    crumples = typical_configuration(catalogue(crumple_paths))
    if not crumples:
        return style.message_figure()
    crumple = crumples[0]
    history = read_history(crumple)
    figure = style.new_figure(8.2, 7.6)
    axes = figure.subplots(4, 1, sharex=True, height_ratios=[0.8, 1, 1.5, 0.9])
    figure.suptitle(
        f"{style.thickness_label(crumple.thickness_um)}, "
        f"overlength {style.overlength_label(crumple.overlength_percent)}, seed {crumple.seed}",
        fontsize=11,
    )
    step = history["step"]
    ramp_end = step[np.argmax(np.isclose(history["height"], history["height"][-1], rtol=1e-9))]
    for ax in axes:
        ax.axvline(ramp_end, color="0.6", lw=1)
        ax.set_xlim(step[0], step[-1])
    colour = style.ordered_colours(5)[1]
    axes[0].plot(step, 1e3 * history["height"], color=colour)
    axes[0].set_ylabel("height (mm)")
    axes[1].plot(step, history["reaction_force"], color=colour)
    axes[1].set_ylabel("reaction force (N)")
    _energies(axes[2], history)
    residual = history["residual"]
    measured = np.isfinite(residual) & (residual > 0)
    axes[3].plot(step[measured], residual[measured], color=colour)
    axes[3].set_yscale("log")
    axes[3].set_ylabel("relative residual")
    axes[3].set_xlabel("step")
    axes[0].text(
        ramp_end,
        1.02,
        "end of ramp ",
        transform=axes[0].get_xaxis_transform(),
        ha="center",
        va="bottom",
        color="0.4",
        fontsize=9,
    )
    figure.align_ylabels(axes)
    return figure


def _energies(ax, history) -> None:
    ax.set_yscale("log")
    energies = {name: history[f"{name}_energy"] for name in (*_SHELL, "kinetic")}
    if "plastic_relief_energy" in history:  # negative, so what it leaves is drawn
        of_shell = sum(energies[name] for name in _SHELL)
        energies["left"] = of_shell + history["plastic_relief_energy"]
    largest = max(np.nanmax(energy) for energy in energies.values())
    if not largest > 0:
        style.message_panel(ax, "no energy recorded")
        return
    ax.set_ylim(largest * 1e-8, largest * 3)
    labels = []
    colours = style.ordered_colours(len(energies))
    for (name, energy), colour, line in zip(energies.items(), colours, _LINES):
        ax.plot(history["step"], np.where(energy > 0, energy, np.nan), color=colour, ls=line)
        labels.append((np.clip(energy[-1], largest * 2e-8, None), name, colour))
    style.label_ends(ax, 1.01, labels, gap=0.11)
    ax.set_ylabel("energy (J)")
