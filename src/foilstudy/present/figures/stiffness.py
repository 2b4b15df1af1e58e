"""Static stiffness against overlength."""

from __future__ import annotations

import numpy as np

from foilstudy.plot import style
from foilstudy.present.comparison import comparable
from foilstudy.present.statistics.cells import measured
from foilstudy.present.statistics.powerlaw import (
    AS_IT_STANDS,
    SIMULATED,
    TRUSTED,
    answering_source,
    shown_source,
    simulated_law,
)
from foilstudy.present.statistics.summary import stiffness_summary

_STANDS = SIMULATED[AS_IT_STANDS]
_MINE, _LIMIT = style.ordered_colours(5)[1:4:2]
_LEGEND = (
    "mesh limit, bar: stated error",
    "mesh limit, not trusted",
    "law of the mesh limit",
    "fit to what is not trusted",
    "crumpled mesh: mean, min to max",
    "as it stands: mean, min to max",
    "uncrumpled cylinder (bound)",
    "published simulation (fit)",
    "published experiment (fit)",
)


@style.styled
def draw(cube, direction: str):
    """Draw the stiffness in one direction, one panel per thickness.

    Parameters
    ----------
    direction
        ``axial`` or ``radial``.
    """
    table = stiffness_summary(cube)
    table = table[table["direction"] == direction]
    answer = answering_source(cube, direction)
    fitted = simulated_law(cube, direction, answer or shown_source(cube, direction))
    stands = measured(cube, _STANDS, direction=direction) if _STANDS in cube else None
    reference = comparable(cube)
    thicknesses = cube["thickness"].to_numpy()
    overlengths = cube["overlength"].to_numpy()
    figure, axes = style.wrapped_grid(thicknesses.size, 4, (2.0, 3.6), (4.6, 0.6), sharey=True)
    fine = np.geomspace(*style.span(overlengths, 1.15), 60)
    for ax, thickness in zip(axes.flat, thicknesses):
        ax.set_title(style.thickness_label(thickness))
        ax.set_yscale("log")
        style.overlength_axis(ax, overlengths)
        rows = table[table["thickness_um"] == thickness]
        _panel(ax, rows)
        if stands is not None:
            _as_it_stands(ax, stands.sel(thickness=thickness))
        if answer != TRUSTED or rows["trusted"].any():
            _law(ax, fitted.law, answer is not None, fine, thickness)
        for kind, law in reference.power_laws[direction].items() if reference else ():
            _published(ax, law.law, kind, fine, thickness)
    style.decade_ticks(axes[0, 0].yaxis)
    for ax in axes[:, 0]:
        ax.set_ylabel(f"{direction} stiffness (N/m)")
    by_label = {
        label: handle
        for ax in axes.flat
        for handle, label in zip(*ax.get_legend_handles_labels(), strict=True)
    }
    shown = [label for label in _LEGEND if label in by_label]
    figure.legend(
        [by_label[label] for label in shown],
        shown,
        loc="outside lower center",
        ncols=3 if axes.shape[1] > 2 else 2,
    )
    title = _law_text(fitted.fit)
    if np.isfinite(fitted.fit.value["constant"]):
        if answer is None:
            title = "no configuration is trusted, and no law is stated"
        elif answer == TRUSTED:
            title = f"trusted configurations: {title}"
    figure.suptitle(title, fontsize=10.5)
    return figure


def _panel(ax, rows) -> None:
    x = rows["overlength_percent"].to_numpy()
    mean = rows["mean"].to_numpy()
    ax.plot(
        x,
        rows["cylinder_bound"],
        color="0.6",
        lw=1.2,
        ls=(0, (1, 1)),
        marker="_",
        ms=7,
        label="uncrumpled cylinder (bound)",
    )
    ax.fill_between(x, rows["min"], rows["max"], color=_MINE, alpha=style.BAND_ALPHA, lw=0)
    ax.errorbar(
        x,
        mean,
        yerr=[mean - rows["min"], rows["max"] - mean],
        fmt="o",
        color=_MINE,
        mfc="white",
        ms=4.5,
        elinewidth=1,
        capsize=2,
        label="crumpled mesh: mean, min to max",
    )
    limit, error = rows["mesh_limit_mean"].to_numpy(), rows["mesh_error_mean"].to_numpy()
    trusted = rows["trusted"].to_numpy()
    for chosen, fill, label in (
        (trusted, _LIMIT, "mesh limit, bar: stated error"),
        (~trusted, "white", "mesh limit, not trusted"),
    ):
        if np.isfinite(error[chosen]).any():
            ax.errorbar(
                x[chosen],
                limit[chosen],
                # an error as large as the value would leave a logarithmic axis
                yerr=[np.minimum(error, 0.9 * limit)[chosen], error[chosen]],
                fmt="s",
                color=_LIMIT,
                mfc=fill,
                mew=1.4,
                ms=5.5,
                elinewidth=1.4,
                capsize=3.5,
                label=label,
            )


def _as_it_stands(ax, values) -> None:
    """A little to the right of the others, so that their bars can be told apart."""
    mean = values.mean("seed")
    below, above = mean - values.min("seed"), values.max("seed") - mean
    ax.errorbar(
        1.03 * values["overlength"],
        mean,
        yerr=[below, above],
        fmt="D",
        color="k",
        mfc="white",
        ms=4,
        elinewidth=1,
        capsize=2,
        label="as it stands: mean, min to max",
    )


def _law(ax, law, trusted: bool, overlength, thickness: float) -> None:
    # A single overlength has no law in overlength to draw.
    fit = law.stiffness(overlength, thickness) if np.isfinite(law.beta) else overlength * np.nan
    look = {"color": _LIMIT, "label": "law of the mesh limit"}
    if not trusted:
        look = {"color": _LIMIT, "ls": ":", "label": "fit to what is not trusted"}
    ax.plot(overlength, fit, **look)


def _published(ax, law, kind: str, overlength, thickness: float) -> None:
    ax.plot(
        overlength,
        law.stiffness(overlength, thickness),
        color="k" if kind == "simulation" else style.GREY,
        ls="--" if kind == "simulation" else "-.",
        lw=1.3,
        label=f"published {kind} (fit)",
    )


def _law_text(fit) -> str:
    if not np.isfinite(fit.value["constant"]):
        return fit.note
    if not np.isfinite(list(fit.value.values())).all():
        return f"sweep too small for the law; usable realisations: {fit.n}"

    def term(key):
        half = fit.high[key] - fit.value[key]
        if not np.isfinite(half):
            return f"{fit.value[key]:.2f}"
        return f"{fit.value[key]:.2f} ± {half:.2f}"

    r2 = f", $R^2$ = {fit.r2:.3f}" if np.isfinite(fit.r2) else ""
    return (
        f"stiffness ∝ overlength$^{{\\mathsf{{{term('overlength')}}}}}$ · "
        f"thickness$^{{\\mathsf{{{term('thickness')}}}}}$"
        f"{r2}, $n$ = {fit.n} (± 95 %)"
    ).replace("-", "−")
