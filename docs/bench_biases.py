"""The table of biases of docs/bench.md: what the virtual rig reads from foils that are known.

``python docs/bench_biases.py`` crumples the foils on 5 mm and writes results/bench/biases.csv; a
thickness (um) and a height (mm) behind it do one foil alone, and leave the other rows. Of a radial
bias it says which share of the published discrepancy it explains: ln(read / true) over
ln(measured / simulated), negative where the bias makes it greater.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pandas as pd

from foilstudy import DynamicsOptions, Foil, Mesh, Method, crumple
from foilstudy.base.files import written_whole
from foilstudy.bench.rig.biases import Drive, biases
from foilstudy.bench.rig.rig import Rig
from foilstudy.bench.rig.shaker import Shaker
from foilstudy.bench.rig.specimens.foil import ReducedFoil
from foilstudy.bench.rig.specimens.spring import Spring
from foilstudy.pipeline.structures import stress_free_structure

TABLE = Path(__file__).parents[1] / "results/bench/biases.csv"
GAP = 0.13
FOILS = [(t, h) for t in (50, 130, 250, 500) for h in (135, 170, 250)]
SPRING = Spring(198.0, 2000.0, 50.0, 50.0, GAP)
MOTIONS = {"axial": 2, "radial": 0}
RAMP_SLOWNESS = 10.0
"""Of all foils of the table; any crumple will do."""
DISCREPANCY = 3.7
"""Published radial stiffness, measured over simulated."""
KEYS = ["thickness_um", "height_mm", "direction"]


def specimen(thickness_um: int, height_mm: int):
    """A foil of the published material as its reduced model; 0 and 0 is the spring of 198 N/m."""
    if not thickness_um:
        return SPRING
    foil = Foil(0.2, 1e-3 * height_mm, GAP, 1e-6 * thickness_um, "FEP")
    options = DynamicsOptions()
    structure = stress_free_structure(
        crumple(foil, Mesh(5e-3), method=Method.following(foil, RAMP_SLOWNESS))
    )
    return ReducedFoil(options.reduced(structure), options.damping)


def rows(thickness_um: int, height_mm: int) -> pd.DataFrame:
    """All biases of one specimen."""
    link, found = specimen(thickness_um, height_mm), []
    for direction, motion in MOTIONS.items():
        rig = Rig(link, GAP, shaker=Shaker(motion=motion))
        for bias in biases(rig, Drive(realisations=3, rate_hz=500.0)):
            found.append(
                {
                    "thickness_um": thickness_um,
                    "height_mm": height_mm,
                    "direction": direction,
                    "rig": bias.rig,
                    "processing": bias.processing,
                    "truth_N_per_m": float(f"{bias.truth:.5g}"),
                    "bias_percent": round(bias.percent, 2),
                    "deviation_percent": round(100 * bias.deviation / bias.truth, 2),
                    "coherence": round(bias.coherence, 4),
                }
            )
    return pd.DataFrame(found)


def explained(table: pd.DataFrame) -> pd.DataFrame:
    """With the overlength, and the share of the radial discrepancy that each bias explains."""
    height = 1e-3 * table["height_mm"]
    overlength = (100 * (height / GAP - 1)).round(1).where(height > 0)
    share = 100 * np.log1p(0.01 * table["bias_percent"]) / np.log(DISCREPANCY)
    radial = (table["direction"] == "radial") & (height > 0)
    return table.assign(
        overlength_percent=overlength, explains_percent=share.round(2).where(radial)
    )


def main(words: list[str]) -> None:
    """Compute one specimen or all, and write them into the table."""
    for case in [tuple(map(int, words))] if words else [(0, 0), *FOILS]:
        fresh = rows(*case)
        if TABLE.exists():
            fresh = pd.concat([pd.read_csv(TABLE), fresh])
        fresh = fresh.drop_duplicates([*KEYS, "rig", "processing"], keep="last")
        fresh = fresh.sort_values(KEYS, kind="stable")
        with written_whole(TABLE) as partial:
            explained(fresh).to_csv(partial, index=False)
        print(f"wrote {TABLE}: {case}")


if __name__ == "__main__":
    main(sys.argv[1:])
