"""The element study gathered, as one table."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.reference import EXPLICIT_CODE_ENERGIES
from foilstudy.base.tables import markdown_table
from foilstudy.study.elements.bending import SLENDERNESS
from foilstudy.study.elements.plan import BASELINE, DEFAULT, FINE, FROZEN, VARIANT_NAMES
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel.files import Records


@dataclass(frozen=True)
class Findings:
    """All results.

    Attributes
    ----------
    variants, crumples : dict of str to dict
        By variant, see `errors.VariantErrors` and `crumpling.Crumples`.
    buckled : float
        Refined post-buckling energy, J.
    fine : dict of float to dict
        Crumples of the default element by element size (mm).
    cost : dict
        See `cost.Costs`.
    """

    variants: dict[str, dict]
    crumples: dict[str, dict]
    buckled: float
    fine: dict[float, dict]
    cost: dict

    @classmethod
    def of(cls, records: Records) -> Findings:
        """From the records of a run."""
        return cls(
            {name: records["variants"][name].result for name in VARIANT_NAMES},
            {name: records["crumples"][name].result for name in VARIANT_NAMES},
            records["buckled"][DEFAULT].result["energies"][-1],
            {case.size_mm: records["fine"][case].result for case in FINE},
            records["cost"][BASELINE].result,
        )

    @property
    def fine_energy(self) -> float:
        """Crumple energy of the default element on the finest mesh, J."""
        return float(np.nanmean(self.fine[min(self.fine)]["energies"]))

    def row(self, name: str) -> dict[str, float]:
        """All numbers of one variant."""
        errors, crumples = self.variants[name], self.crumples[name]
        row = {"cost": self.cost["relative"][name]}
        row["ns_vectorised"] = self.cost["nanoseconds"].get(name, np.nan)
        row |= {f"ring_{s:g}": _number(errors["ring"][f"{s:g}"]) for s in SLENDERNESS}
        row["roll_up"] = _number(errors["roll_up"])
        for case in FROZEN:
            t = case.thickness_um
            row[f"axial_{t}um"], row[f"radial_{t}um"] = errors["frozen"][str(t)]
        row["buckled"] = _number(errors["buckled"]) / self.buckled - 1
        settled = np.isfinite(crumples["energies"])
        energies = crumples["energies"][settled]
        row["crumple_energy"] = energies.mean() if settled.any() else np.nan
        row["crumple_error"] = row["crumple_energy"] / self.fine_energy - 1
        row["crumples_settled"] = float(settled.mean())
        steps = crumples["steps"][settled]
        row["steps"] = steps.mean() if settled.any() else np.nan
        return row


def _number(value: float | None) -> float:
    """NaN for what a record has as None."""
    return np.nan if value is None else value


def rows(study: Findings) -> list[dict]:
    """One row per variant."""
    return [
        {"variant": name, "label": variant.label} | study.row(name)
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


def page(study: Findings) -> str:
    """The table, a dash where an element found no answer, and what it is held against."""
    rows = []
    for name, variant in VARIANTS.items():
        row = study.row(name)
        cells = (
            "-" if np.isnan(row[key]) else pattern.format(row[key]) for key, _, pattern in _HEADINGS
        )
        rows.append([variant.label, *cells])
    fine = "; ".join(
        f"{size:g} mm: " + ", ".join("-" if np.isnan(e) else f"{e:.2f}" for e in record["energies"])
        for size, record in study.fine.items()
    )
    explicit = "; ".join(
        ", ".join(f"{energy:.2f}" for energy in energies) + f" at {size:g} mm"
        for size, energies in EXPLICIT_CODE_ENERGIES.items()
    )
    return (
        markdown_table(["element", *(heading for _, heading, _ in _HEADINGS)], rows)
        + f"\nCrumple energy of the default element on finer meshes, J: {fine}.\n"
        + f"QEPH, computed for this project, J: {explicit}.\n"
    )
