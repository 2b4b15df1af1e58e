"""Figures of the dynamics study."""

from __future__ import annotations

import numpy as np

from foilstudy.plot.mac import ModeLabels, draw_mac
from foilstudy.plot.style import GREY, PAGE_WIDTH, decade_ticks, new_figure, styled, value_ticks
from foilstudy.study.dynamics import plan
from foilstudy.study.dynamics.measure import mode_correlation
from foilstudy.study.dynamics.records import METHODS, succeeded
from foilstudy.study.kernel.plan import Results
from foilstudy.study.published import HEIGHT_MM, THICKNESSES_UM

_COLOURS = dict(zip(METHODS, ("0.6", "#4c72b0", "#c44e52", "#222222"), strict=True))
_MARKERS = dict(zip(METHODS, "sv^o", strict=True))
_PUBLISHED_RATIO, _RULE = 1.25, (1.5, 2.0)
"""Cut-off over highest frequency: of the published study, and the rule of thumb."""
_DEFAULT_TOLERANCE = 1e-3


def _tolerance(ax) -> None:
    ax.axhline(_DEFAULT_TOLERANCE, color=GREY, lw=0.9, ls="--")


@styled
def cutoff(study: Results):
    """Largest error in the band against the cut-off, for the methods that have one."""
    figure = new_figure(PAGE_WIDTH, 4.2)
    for ax, thickness in zip(figure.subplots(1, 2, sharey=True), THICKNESSES_UM, strict=True):
        for method in ("craig_bampton", "hintz_herting"):
            rows = succeeded(study, plan.Model(thickness), method)
            rows.sort(key=lambda row: row.order)
            ratio = [row.order / plan.HIGHEST_HZ for row in rows]
            style = {"color": _COLOURS[method], "marker": _MARKERS[method], "ms": 5}
            ax.plot(ratio, [row.error for row in rows], label=METHODS[method], **style)
            ax.plot(
                ratio, [row.estimate for row in rows], ls=":", lw=1.2, mfc="none", **style,
                label=f"{METHODS[method]}, own estimate",
            )  # fmt: skip
        ax.axvspan(*_RULE, color="0.93", zorder=0)
        ax.axvline(_PUBLISHED_RATIO, color=GREY, lw=0.9)
        _tolerance(ax)
        ax.set_yscale("log")
        ax.set_xlabel("cut-off over highest frequency, 800 Hz")
        ax.set_title(f"{thickness} µm, {HEIGHT_MM} mm, 5 mm elements")
    figure.axes[0].set_ylabel("largest relative error, 3 to 800 Hz")
    figure.axes[0].legend(fontsize=8.5)
    return figure


@styled
def cost(study: Results):
    """Largest error in the band against processor time, all methods and meshes."""
    figure = new_figure(PAGE_WIDTH, 7.2)
    panels = figure.subplots(2, 3, sharey=True)
    for axes, thickness in zip(panels, THICKNESSES_UM, strict=True):
        for ax, refinements in zip(axes, (0, 1, 2), strict=True):
            model = plan.Model(thickness, refinements=refinements)
            for method, label in METHODS.items():
                rows = sorted(succeeded(study, model, method), key=lambda row: row.size)
                ax.plot(
                    [row.seconds for row in rows], [row.error for row in rows], lw=1.0, ms=5,
                    color=_COLOURS[method], marker=_MARKERS[method], label=label,
                )  # fmt: skip
            _tolerance(ax)
            ax.set_xscale("log")
            ax.set_yscale("log")
            decade_ticks(ax.xaxis)
            chart = study["charts"][model]
            damping = chart["damping"].removesuffix("Damping").lower()
            ax.set_title(
                f"{thickness} µm, {model.size_mm:g} mm: {chart['unknowns']:,} unknowns,\n"
                f"{damping} damping"
            )
    for ax in panels[1]:
        ax.set_xlabel("processor time of the reduction (s)")
    for ax in panels[:, 0]:
        ax.set_ylabel("largest relative error to 800 Hz")
    panels[0, 0].legend(fontsize=8.5)
    return figure


@styled
def frequency(study: Results):
    """Error against frequency with the published cut-off and the default tolerance."""
    figure = new_figure(PAGE_WIDTH, 7.2)
    panels = figure.subplots(2, 2, sharex=True, sharey=True)
    for axes, prestressed in zip(panels, (False, True), strict=True):
        for ax, thickness in zip(axes, THICKNESSES_UM, strict=True):
            model = plan.Model(thickness, prestressed=prestressed)
            frequencies = study["charts"][model]["frequencies"]
            for row in succeeded(study, model):
                if row.order in (0.0, 1000.0, 1e-3):
                    ax.plot(
                        frequencies, row.errors.max(axis=0), lw=1.2, ms=5,
                        color=_COLOURS[row.method], marker=_MARKERS[row.method],
                        label=f"{METHODS[row.method]}, {row.size} coordinates",
                    )  # fmt: skip
            _tolerance(ax)
            ax.set_xscale("log")
            ax.set_yscale("log")
            value_ticks(ax.xaxis, (3, 10, 30, 100, 300, 800))
            kind = "with its stresses, structural damping" if prestressed else "free of stress"
            ax.set_title(f"{thickness} µm, {kind}")
            ax.legend(fontsize=8)
    for ax in panels[1]:
        ax.set_xlabel("frequency (Hz)")
    for ax in panels[:, 0]:
        ax.set_ylabel("relative error, worst definition")
    return figure


@styled
def mac(study: Results):
    """Clamped modes: of two reductions, and of the same shape on two meshes."""
    figure = new_figure(1.4 * PAGE_WIDTH, 1.4 * PAGE_WIDTH)
    panels = figure.subplots(2, 2)
    for axes, thickness in zip(panels, THICKNESSES_UM, strict=True):
        coarse = study["charts"][plan.Model(thickness)]["modes"]
        fine = study["charts"][plan.Model(thickness, refinements=2)]["modes"]["rational_krylov"]
        ours = coarse["rational_krylov"]
        _correlation(axes[0], ours, coarse["hintz_herting"], ("Krylov", "Hintz-Herting"))
        _correlation(axes[1], ours, fine, ("5 mm", "1.25 mm"))
        for ax in axes:
            ax.set_title(f"{thickness} µm, {HEIGHT_MM} mm")
    return figure


def _correlation(ax, first: dict, second: dict, titles: tuple[str, str]) -> None:
    rows, columns = (
        ModeLabels(title, modes["frequencies"])
        for title, modes in zip(titles, (first, second), strict=True)
    )
    draw_mac(ax, np.asarray(mode_correlation(first, second)), rows, columns)
