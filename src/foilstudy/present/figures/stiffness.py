"""Static stiffness against overlength."""

from __future__ import annotations

import numpy as np

from foilstudy.base.reference import published
from foilstudy.plot import style
from foilstudy.present.statistics.powerlaw import simulated_law
from foilstudy.present.statistics.summary import stiffness_summary

_MINE, _LIMIT = style.ordered_colours(5)[1:4:2]
_LEGEND = (
    "this study: mean, min to max",
    "this study: fit",
    "same shapes, mesh limit ± error",
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
    fitted = simulated_law(cube, direction)
    thicknesses = cube["thickness"].to_numpy()
    overlengths = cube["overlength"].to_numpy()
    figure, axes = style.wrapped_grid(thicknesses.size, 4, (2.0, 3.6), (4.6, 0.6), sharey=True)
    fine = np.geomspace(*style.span(overlengths, 1.15), 60)
    for ax, thickness in zip(axes.flat, thicknesses):
        ax.set_title(style.thickness_label(thickness))
        ax.set_yscale("log")
        style.overlength_axis(ax, overlengths)
        _panel(ax, table[table["thickness_um"] == thickness])
        _laws(ax, fitted.law, direction, fine, thickness)
    style.decade_ticks(axes[0, 0].yaxis)
    for ax in axes[:, 0]:
        ax.set_ylabel(f"{direction} stiffness (N/m)")
    by_label = dict(zip(*axes[0, 0].get_legend_handles_labels()[::-1]))
    figure.legend(
        [by_label[label] for label in _LEGEND],
        _LEGEND,
        loc="outside lower center",
        ncols=3 if axes.shape[1] > 2 else 2,
    )
    figure.suptitle(_law_text(fitted.fit), fontsize=10.5)
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
        ms=5.5,
        elinewidth=1,
        capsize=2,
        label="this study: mean, min to max",
    )
    limit, error = rows["mesh_limit_mean"].to_numpy(), rows["mesh_error_mean"].to_numpy()
    ax.errorbar(
        x,
        limit,
        # an error as large as the value would leave a logarithmic axis
        yerr=[np.minimum(error, 0.9 * limit), error],
        fmt="s",
        color=_LIMIT,
        mfc="white",
        mew=1.4,
        ms=5.5,
        elinewidth=1.4,
        capsize=3.5,
        label="same shapes, mesh limit ± error",
    )


def _laws(ax, law, direction: str, overlength, thickness: float) -> None:
    # A single overlength has no law in overlength to draw.
    fit = law.stiffness(overlength, thickness) if np.isfinite(law.beta) else overlength * np.nan
    ax.plot(overlength, fit, color=_MINE, label="this study: fit")
    for source, look in (("simulation", "--"), ("experiment", "-.")):
        other = published().power_laws[direction][source].law
        ax.plot(
            overlength,
            other.stiffness(overlength, thickness),
            color="k" if source == "simulation" else style.GREY,
            ls=look,
            lw=1.3,
            label=f"published {source} (fit)",
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
