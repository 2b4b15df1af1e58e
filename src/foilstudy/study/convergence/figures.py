"""Figures of the convergence study."""

from __future__ import annotations

import textwrap

import numpy as np

from foilstudy.base.reference import EXPLICIT_CODE, EXPLICIT_CODE_ENERGIES, published
from foilstudy.plot import style
from foilstudy.study.convergence import plan
from foilstudy.study.convergence.analysis import fit, means, slope
from foilstudy.study.convergence.records import ensemble
from foilstudy.study.kernel.plan import Results
from foilstudy.study.published import HEIGHT_MM, THICKNESSES_UM

_ELEMENTS = {"corner": "corner (default)", "one_point": "one point"}
_COLOURS = {"corner": "#222222", "one_point": "#c44e52"}
_OTHER = "#8172b3"
_DIRECTIONS = ("axial", "radial")
_REACHED = 1e-12
"""Differences below this are drawn here: the stiffness at the last stop is its own reference."""


def _panels(columns: int = 2, height: float = 4.4):
    figure = style.new_figure(style.PAGE_WIDTH, height)
    return figure, figure.subplots(1, columns)


def _size_axis(ax) -> None:
    ax.set_xscale("log")
    style.value_ticks(ax.xaxis, plan.SIZES_MM)
    ax.set_xlabel("element size (mm)")


@style.styled
def energy(study: Results):
    """Strain energy of every crumple against element size, with fit, beside those by QEPH."""
    figure, panels = _panels()
    for ax, thickness in zip(panels, THICKNESSES_UM, strict=True):
        for element, label in _ELEMENTS.items():
            _energy_of(ax, study, thickness, element, label)
        for case, levels in study["levels"].items():
            if case.thickness_um == thickness:
                sizes = [record["size_mm"] for record in levels]
                energies = [record["strain_energy"] for record in levels]
                ax.plot(
                    sizes, energies, ls=":", marker="^", color=style.GREY, label="refined, relaxed"
                )
        if thickness == 500:
            for size, energies in EXPLICIT_CODE_ENERGIES.items():
                look = {"ls": "none", "marker": "D", "color": _OTHER}
                label = (
                    textwrap.fill(EXPLICIT_CODE, 40)
                    if size == max(EXPLICIT_CODE_ENERGIES)
                    else None
                )
                ax.plot([size] * len(energies), energies, **look, label=label)
        else:
            ax.set_yscale("log")
        _size_axis(ax)
        ax.set_ylabel("strain energy (J)")
        ax.set_title(f"{thickness} µm, h_ref {HEIGHT_MM} mm")
        ax.legend(fontsize=8.5)
    return figure


def _energy_of(ax, study, thickness, element, label) -> None:
    seeds = ensemble(study, "strain_energy", thickness, element)
    sizes, mean, error = means(seeds)
    colour = _COLOURS[element]
    for size, values in seeds.items():
        ax.plot([size] * len(values), values, ".", color=colour, alpha=0.45, ms=5)
    fitted = fit(seeds)
    curve = np.geomspace(sizes.min(), sizes.max(), 60)
    ax.errorbar(sizes, mean, error, fmt="o", color=colour, capsize=3, ms=5)
    limit = f"{fitted.limit:.3g} ± {fitted.limit_error:.1g} J at size 0"
    ax.plot(curve, fitted(curve), color=colour, lw=1.2, label=f"{label}: {limit}")


@style.styled
def stiffness(study: Results):
    """Stress-free stiffness on the crumple's own mesh and its limit for the same shape."""
    figure, panels = _panels()
    for ax, thickness in zip(panels, THICKNESSES_UM, strict=True):
        for index, direction in enumerate(_DIRECTIONS):
            for element in _ELEMENTS:
                plain = ensemble(study, "static_stiffness", thickness, element, index)
                _line(ax, plain, f"{direction}, {element}", _COLOURS[element], index)
            limit = ensemble(study, "static_limit", thickness, "corner", index)
            limit = {size: v for size, v in limit.items() if np.isfinite(v).all()}
            _line(ax, limit, f"{direction}, limit of the same shape", "#4c72b0", index)
            stressed = ensemble(study, "prestressed_stiffness", thickness, "corner", index)
            _line(ax, stressed, f"{direction}, pre-stressed", "#dd8452", index)
        _size_axis(ax)
        ax.set_yscale("log")
        ax.set_ylabel("stiffness (N/m)")
        ax.set_title(f"{thickness} µm, h_ref {HEIGHT_MM} mm")
    style.legend_below(figure, panels[0], 4, fontsize=8.5)
    return figure


def _line(ax, seeds, label, colour, index) -> None:
    sizes = list(seeds)
    mean = [np.mean(values) for values in seeds.values()]
    ax.plot(
        sizes,
        mean,
        ls=style.line_style(index),
        marker=style.marker(index),
        color=colour,
        label=label,
    )


@style.styled
def stabilisation(study: Results):
    """Share of the strain energy that only holds the in-plane checkerboard."""
    figure, ax = _panels(1)
    for index, thickness in enumerate(THICKNESSES_UM):
        for element in _ELEMENTS:
            total = ensemble(study, "strain_energy", thickness, element)
            part = ensemble(study, "stabilisation_energy", thickness, element)
            share = {size: 100 * part[size] / total[size] for size in total}
            _line(ax, share, f"{thickness} µm, {element}", _COLOURS[element], index)
    _size_axis(ax)
    ax.set_yscale("log")
    ax.set_ylabel("stabilisation energy (%)")
    ax.legend()
    return figure


@style.styled
def run_time(study: Results):
    """Time of a step, and of a whole crumple, against element size."""
    figure, (steps, whole) = _panels()
    colours = style.ordered_colours(len(THICKNESSES_UM))
    exponents = published().run_time_exponents
    for index, thickness in enumerate(THICKNESSES_UM):
        rows = [row for row in study["timing"]["steps"] if row["thickness_um"] == thickness]
        sizes = np.array([row["size_mm"] for row in rows])
        seconds = np.array([row["seconds_per_step"] for row in rows])
        exponent, _ = slope(sizes, seconds)
        steps.plot(sizes, 1e3 * seconds, marker=style.marker(index), color=colours[index],
                   label=f"{thickness} µm: slope {exponent:.2f}")  # fmt: skip
        expected = seconds[-1] * (sizes / sizes[-1]) ** exponents[thickness]
        steps.plot(sizes, 1e3 * expected, ls=":", color=colours[index],
                   label=f"published slope {exponents[thickness]:g}")  # fmt: skip
        relaxing = ensemble(study, "cpu_seconds_relaxing", thickness)
        settling = ensemble(study, "cpu_seconds_settling", thickness)
        total = {size: relaxing[size] + settling[size] for size in relaxing}
        _line(whole, total, f"{thickness} µm", colours[index], index)
    for ax, title in ((steps, "a fixed number of steps"), (whole, "a crumple to 1e-8")):
        _size_axis(ax)
        ax.set_yscale("log")
        ax.set_title(title)
        ax.legend(fontsize=8.5)
    steps.set_ylabel("time per step (ms, one core)")
    whole.set_ylabel("CPU time (s)")
    return figure


@style.styled
def stops(study: Results):
    """How far the stiffness is from that at the last residual, by the residual of the stop."""
    figure, panels = _panels()
    quantities = {"static_stiffness": "stress-free", "prestressed_stiffness": "pre-stressed"}
    colours = style.ordered_colours(len(THICKNESSES_UM))
    for ax, (key, title) in zip(panels, quantities.items(), strict=True):
        for case, records in study["stops"].items():
            residuals = [record["residual"] for record in records]
            values = np.array([record[key] for record in records], float)
            change = np.maximum(np.abs(values / values[-1] - 1), _REACHED)
            colour = colours[THICKNESSES_UM.index(case.thickness_um)]
            for index in range(2):
                ax.plot(residuals[:-1], change[:-1, index], color=colour, lw=1.0, ms=4,
                        ls=style.line_style(index), marker=style.marker(index),
                        label=f"{case.thickness_um} µm, {_DIRECTIONS[index]}")  # fmt: skip
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.invert_xaxis()
        ax.set_xlabel("residual at which the relaxation stops")
        ax.set_ylabel("relative change of the stiffness since")
        ax.set_title(title)
    handles, labels = panels[0].get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    panels[0].legend(unique.values(), unique.keys(), fontsize=8.5)
    return figure
