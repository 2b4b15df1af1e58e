"""Error against cost of every element."""

from __future__ import annotations

import textwrap

import numpy as np

from foilstudy.base.reference import EXPLICIT_CODE, EXPLICIT_CODE_ENERGIES
from foilstudy.plot import style
from foilstudy.study.elements.bending import SLENDERNESS
from foilstudy.study.elements.plan import BASELINE, COARSE_MM, DEFAULT, FROZEN
from foilstudy.study.elements.summary import variant_row
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel.plan import Results

_HEIGHT = 12.5
_COLOURS = {
    "one point": "#c44e52",
    "Gauss": "#dd8452",
    "patch-wise": "#937860",
    "CAS": "#55a868",
    "staggered": "#4c72b0",
    "corner": "#222222",
}
_LEGEND_COLUMNS = 4


@style.styled
def draw(study: Results):
    """Six panels: error against t/h for both kinds of task, then error against cost."""
    figure = style.new_figure(style.PAGE_WIDTH, _HEIGHT)
    axes = figure.subplots(3, 2)
    _against_slenderness(axes[0, 0], study, _ring, SLENDERNESS)
    axes[0, 0].set_title("bending a coarse ring (R = 2.5 h), against theory")
    slenderness = tuple(case.thickness_um * 1e-6 / (COARSE_MM * 1e-3) for case in FROZEN)
    _against_slenderness(axes[0, 1], study, _axial, slenderness)
    axes[0, 1].set_title("axial stiffness of a given crumple, 5 mm against 1.25 mm")
    costs = [(axes[1, 0], "axial_500um", "stiffness of a given crumple, 500 µm")]
    costs.append((axes[1, 1], "axial_50um", "stiffness of a given crumple, 50 µm"))
    costs.append((axes[2, 0], "buckled", "energy of a post-buckled panel, 500 µm"))
    for ax, key, title in costs:
        _against_cost(ax, study, key)
        ax.set_title(title)
    _crumple_energy(axes[2, 1], study)
    style.legend_below(figure, axes[0, 0], _LEGEND_COLUMNS, fontsize=8.5)
    return figure


def _look(name: str) -> dict:
    """Colour by family; line and marker by the place within it."""
    variant = VARIANTS[name]
    family = [key for key, other in VARIANTS.items() if other.family == variant.family]
    place = family.index(name)
    return {
        "color": _COLOURS[variant.family],
        "marker": style.marker(place),
        "ls": style.line_style(place),
        "ms": 8 if name == DEFAULT else 5,
        "lw": 2.6 if name == DEFAULT else 1.2,
    }


def _ring(row: dict, index: int) -> float:
    return row[f"ring_{SLENDERNESS[index]:g}"]


def _axial(row: dict, index: int) -> float:
    return row[f"axial_{FROZEN[index].thickness_um}um"]


def _against_slenderness(ax, study: Results, value, slenderness) -> None:
    for name, variant in VARIANTS.items():
        row = variant_row(study, name)
        errors = [abs(value(row, k)) for k in range(len(slenderness))]
        ax.plot(slenderness, errors, label=variant.label, **_look(name))
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xticks(slenderness, [f"{s:g}" for s in slenderness])
    ax.minorticks_off()
    ax.set_xlabel("thickness / element size")
    ax.set_ylabel("relative error")


def _against_cost(ax, study: Results, key: str) -> None:
    for name in VARIANTS:
        row = variant_row(study, name)
        ax.plot(row["cost"], abs(row[key]), **_look(name))
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("cost of a force evaluation by the general kernel / one point's")
    ax.set_ylabel("relative error")


def _crumple_energy(ax, study: Results) -> None:
    """Energy of crumples against cost, beside finer meshes and those by QEPH."""
    for name in VARIANTS:
        energies = study["crumples"][name]["energies"]
        cost = study["cost"][BASELINE]["relative"][name]
        ax.plot([cost] * len(energies), energies, **_look(name) | {"ls": "none"})
    for (size, energies), look in zip(EXPLICIT_CODE_ENERGIES.items(), ("-", "--"), strict=True):
        for energy in energies:
            label = textwrap.fill(f"{EXPLICIT_CODE}, {size:g} mm", 40)
            ax.axhline(energy, color="#8172b3", lw=1.0, ls=look, label=label)
    for (case, record), look in zip(study["fine"].items(), ("--", "-"), strict=True):
        energy = np.nanmean(record["energies"])
        ax.axhline(energy, color=style.GREY, lw=1.6, ls=look, label=f"default, {case.size_mm:g} mm")
    handles, labels = ax.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    ax.legend(unique.values(), unique.keys(), fontsize=8, loc="upper left")
    ax.set_xscale("log")
    ax.set_xlabel("cost of a force evaluation by the general kernel / one point's")
    ax.set_ylabel("strain energy, J")
    ax.set_title("crumples of 500 µm, h_ref = 170 mm, 5 mm elements")
