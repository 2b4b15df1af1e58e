"""Stiffness over amplitude, and backbones."""

from __future__ import annotations

import numpy as np

from foilstudy.measure.amplitude.curve import LINEAR_SHARE
from foilstudy.plot import style
from foilstudy.study.amplitude.plan import MOTIONS
from foilstudy.study.kernel.plan import Results
from foilstudy.study.published import THICKNESSES_UM

_LEAST = 1e-2
"""Change that is shown at least, per cent."""


@style.styled
def stiffness(findings: Results):
    """Change of the secant stiffness against amplitude: a panel per thickness and motion."""
    motions = MOTIONS[THICKNESSES_UM[-1]]
    figure, axes = style.panel_grid(
        len(THICKNESSES_UM), len(motions), (4.5, 3.0), (0.5, 0.3), sharex=True, sharey=True
    )
    for ax, (thickness, motion) in zip(
        axes.flat, ((t, m) for t in THICKNESSES_UM for m in motions), strict=True
    ):
        for case, found in findings["sweeps"].items():
            if (case.thickness_um, case.motion) == (thickness, motion):
                _curve(ax, case, found)
        ax.axhline(100 * LINEAR_SHARE, color=style.GREY, linewidth=0.8)
        ax.set_title(f"{thickness} µm, {motion.replace('_', ' ')}")
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_ylim(_LEAST, 100)
    for ax in axes[-1]:
        ax.set_xlabel("amplitude, mm")
    for ax in axes[:, 0]:
        ax.set_ylabel("change of stiffness, %")
    axes[0, 0].legend(loc="upper left")
    return figure


def _curve(ax, case, found: dict) -> None:
    """The larger change of both sides at each amplitude."""
    changes = [
        np.abs(np.array(side["secant"], float) / found["stiffness"] - 1) for side in found["sides"]
    ]
    if not changes:
        return
    steps = min(map(len, changes))
    ways = 1e3 * np.abs(np.array(found["sides"][0]["motion"][:steps], float))
    most = 100 * np.max([change[:steps] for change in changes], axis=0)
    color = "C1" if case.prestressed else "C0"
    ax.plot(ways, most, color=color, label=case.words.partition(", ")[2])


@style.styled
def backbones(findings: Results):
    """Shift of the frequency against amplitude by normal forms, and by time integration."""
    figure = style.new_figure(style.PAGE_WIDTH, 4.0)
    axes = figure.subplots(1, 2)
    ways = np.geomspace(1e-5, 1e-3, 30)
    for case, found in findings["modes"].items():
        line = "-" if case.prestressed else "--"
        color = f"C{THICKNESSES_UM.index(case.thickness_um)}"
        for k, one in enumerate(found["modes"]):
            square = one["bend"] / one["eigenvalue"] / one["displacement"] ** 2
            shift = np.sqrt(np.maximum(1 + square * ways**2, 0)) - 1
            label = case.words if not k else None
            axes[0].plot(1e3 * ways, 100 * np.abs(shift), line, color=color, label=label)
    axes[0].set_xscale("log")
    axes[0].set_yscale("log")
    axes[0].set_ylim(_LEAST / 10, 100)
    axes[0].set_xlabel("largest displacement, mm")
    axes[0].set_ylabel("shift of the frequency, %")
    axes[0].legend(loc="upper left")
    for name, marker in (("normal_form", "o"), ("condensed", "x")):
        pairs = [
            (100 * found["integrated"], 100 * found[name])
            for found in findings["releases"].values()
            if found["integrated"] is not None
        ]
        if pairs:
            axes[1].plot(*zip(*pairs, strict=True), marker, label=name.replace("_", " "))
    axes[1].axline((0, 0), slope=1, color=style.GREY, linewidth=0.8)
    axes[1].set_xlabel("shift by time integration, %")
    axes[1].set_ylabel("shift by a model of one mode, %")
    axes[1].legend()
    return figure
