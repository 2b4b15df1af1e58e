"""The element study gathered, as one table."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.base.files import written_whole
from foilstudy.study.elements import records
from foilstudy.study.elements.bending import SLENDERNESS
from foilstudy.study.elements.crumpling import FINE_SIZES, PUBLISHED_2MM5, PUBLISHED_5MM
from foilstudy.study.elements.frozen import THICKNESSES as FROZEN
from foilstudy.study.elements.scene import micrometres
from foilstudy.study.elements.variants import VARIANTS

FROZEN_UM = tuple(str(micrometres(t)) for t in FROZEN)


@dataclass(frozen=True)
class Study:
    """All records.

    Attributes
    ----------
    variants, crumples : dict of str to dict
        By variant, see `records.VariantErrors` and `crumpling.Crumples`.
    buckled : float
        Refined post-buckling energy, J.
    fine : dict of float to dict
        Crumples of the default element by element size (m).
    cost : dict
        See `cost.Costs`.
    """

    variants: dict[str, dict]
    crumples: dict[str, dict]
    buckled: float
    fine: dict[float, dict]
    cost: dict

    @classmethod
    def read(cls, folder: Path) -> Study:
        """Read what the jobs have written."""
        return cls(
            {name: records.read(folder / f"variants/{name}.json") for name in VARIANTS},
            {name: records.read(folder / f"crumples/{name}.json") for name in VARIANTS},
            records.read(folder / "buckled.json")["energies"][-1],
            {s: records.read(folder / f"fine_{1e3 * s:g}mm.json") for s in FINE_SIZES},
            records.read(folder / "cost.json"),
        )

    @property
    def fine_energy(self) -> float:
        """Crumple energy of the default element on the finest mesh, J."""
        return float(np.nanmean(self.fine[min(FINE_SIZES)]["energies"]))

    def row(self, name: str) -> dict[str, float]:
        """All numbers of one variant."""
        errors, crumples = self.variants[name], self.crumples[name]
        row = {"cost": self.cost["relative"][name]}
        row["ns_vectorised"] = self.cost["nanoseconds"].get(name, np.nan)
        row |= {f"ring_{s:g}": errors["ring"][f"{s:g}"] for s in SLENDERNESS}
        row["roll_up"] = errors["roll_up"]
        for t in FROZEN_UM:
            row[f"axial_{t}um"], row[f"radial_{t}um"] = errors["frozen"][t]
        row["buckled"] = errors["buckled"] / self.buckled - 1
        settled = np.isfinite(crumples["energies"])
        energies = np.array(crumples["energies"])[settled]
        row["crumple_energy"] = energies.mean() if settled.any() else np.nan
        row["crumple_error"] = row["crumple_energy"] / self.fine_energy - 1
        row["crumples_settled"] = float(settled.mean())
        steps = np.array(crumples["steps"])[settled]
        row["steps"] = steps.mean() if settled.any() else np.nan
        return row


def write_csv(study: Study, path: Path) -> None:
    """One row per variant."""
    rows = {name: study.row(name) for name in VARIANTS}
    with written_whole(path) as partial, partial.open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["variant", "label", *next(iter(rows.values()))])
        for name, row in rows.items():
            numbers = ["" if np.isnan(value) else f"{value:.5g}" for value in row.values()]
            writer.writerow([name, VARIANTS[name].label, *numbers])


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


def table(study: Study) -> str:
    """Markdown table; a dash where an element found no answer."""
    lines = [
        "| element | " + " | ".join(heading for _, heading, _ in _HEADINGS) + " |",
        "|---|" + "---|" * len(_HEADINGS),
    ]
    for name, variant in VARIANTS.items():
        row = study.row(name)
        cells = [
            "-" if np.isnan(row[key]) else pattern.format(row[key]) for key, _, pattern in _HEADINGS
        ]
        lines.append(f"| {variant.label} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def write_markdown(study: Study, path: Path) -> None:
    """The table and what its columns are held against."""
    fine = "; ".join(
        f"{1e3 * size:g} mm: "
        + ", ".join("-" if np.isnan(e) else f"{e:.2f}" for e in record["energies"])
        for size, record in study.fine.items()
    )
    published = ", ".join(f"{energy:.2f}" for energy in PUBLISHED_5MM)
    with written_whole(path) as partial:
        partial.write_text(
            table(study)
            + f"\nCrumple energy of the default element on finer meshes, J: {fine}.\n"
            + f"Published (QEPH), J: {published} at 5 mm; {PUBLISHED_2MM5} at 2.5 mm.\n"
        )
