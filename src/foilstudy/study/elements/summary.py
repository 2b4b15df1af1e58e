"""The element study gathered, as one table."""

from __future__ import annotations

import numpy as np

from foilstudy.base.reference import EXPLICIT_CODE, EXPLICIT_CODE_ENERGIES
from foilstudy.base.tables import markdown_table
from foilstudy.study.elements.bending import SLENDERNESS
from foilstudy.study.elements.plan import BASELINE, DEFAULT, FINE, FROZEN
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel.plan import Results


def variant_row(study: Results, name: str) -> dict[str, float]:
    """All numbers of one variant."""
    errors, crumples = study["variants"][name], study["crumples"][name]
    cost = study["cost"][BASELINE]
    row = {"cost": cost["relative"][name], "ns_vectorised": cost["nanoseconds"].get(name, np.nan)}
    row |= {f"ring_{s:g}": _number(errors["ring"][f"{s:g}"]) for s in SLENDERNESS}
    row["roll_up"] = _number(errors["roll_up"])
    for case in FROZEN:
        t = case.thickness_um
        row[f"axial_{t}um"], row[f"radial_{t}um"] = errors["frozen"][str(t)]
    row["buckled"] = _number(errors["buckled"]) / study["buckled"][DEFAULT]["energies"][-1] - 1
    settled = np.isfinite(crumples["energies"])
    energies, steps = crumples["energies"][settled], crumples["steps"][settled]
    row["crumple_energy"] = energies.mean() if settled.any() else np.nan
    finest = float(np.nanmean(study["fine"][FINE[-1]]["energies"]))
    row["crumple_error"] = row["crumple_energy"] / finest - 1
    row["crumples_settled"] = float(settled.mean())
    row["steps"] = steps.mean() if settled.any() else np.nan
    return row


def _number(value: float | None) -> float:
    """NaN for what a record has as None."""
    return np.nan if value is None else value


def rows(study: Results) -> list[dict]:
    """One row per variant."""
    return [
        {"variant": name, "label": variant.label} | variant_row(study, name)
        for name, variant in VARIANTS.items()
    ]


_HEADINGS = (
    ("cost", "cost", "{:.2f}"),
    ("ns_vectorised", "ns vectorised", "{:.0f}"),
    ("ring_0.01", "ring, t/h 0.01", "{:.1%}"),
    ("ring_0.1", "ring, t/h 0.1", "{:.1%}"),
    ("roll_up", "roll-up", "{:.2%}"),
    ("axial_50um", "axial 50 µm", "{:+.0%}"),
    ("axial_250um", "axial 250 µm", "{:+.0%}"),
    ("axial_500um", "axial 500 µm", "{:+.0%}"),
    ("radial_500um", "radial 500 µm", "{:+.0%}"),
    ("buckled", "buckled", "{:+.1%}"),
    ("crumple_energy", "crumple, J", "{:.2f}"),
    ("steps", "steps", "{:.0f}"),
)


def page(study: Results) -> str:
    """The table, a dash where an element found no answer, and what it is held against."""
    rows = []
    for name, variant in VARIANTS.items():
        row = variant_row(study, name)
        cells = (
            "-" if np.isnan(row[key]) else pattern.format(row[key]) for key, _, pattern in _HEADINGS
        )
        rows.append([variant.label, *cells])
    fine = "; ".join(
        f"{case.size_mm:g} mm: "
        + ", ".join("-" if np.isnan(e) else f"{e:.2f}" for e in record["energies"])
        for case, record in study["fine"].items()
    )
    explicit = "; ".join(
        ", ".join(f"{energy:.2f}" for energy in energies) + f" at {size:g} mm"
        for size, energies in EXPLICIT_CODE_ENERGIES.items()
    )
    return (
        markdown_table(["element", *(heading for _, heading, _ in _HEADINGS)], rows)
        + f"\nCrumple energy of the default element on finer meshes, J: {fine}.\n"
        + f"{EXPLICIT_CODE}, J: {explicit}.\n"
    )
