"""Block of a study with the whole model, beside the elastic foil and the measured law."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr

from foilstudy.base.reference import published
from foilstudy.present.statistics.cells import good, realised, samples
from foilstudy.present.statistics.powerlaw import AS_IT_STANDS, LIMIT, SIMULATED, fit_power_law
from page_blocks.study import DIRECTIONS, Study, rows

STATES = {
    "stress-free": SIMULATED[LIMIT],
    "stress-free, contacts stuck": "stiffness_contacts_stuck",
    "as it stands": SIMULATED[AS_IT_STANDS],
}
"""Quantities by what they are called here."""


def whole(study: Study, elastic: Study) -> Iterator[str]:
    """Stiffness over that of the measured law, and exponents; of the elastic foils the same ones.

    Where a configuration has several values, geometric mean and extremes.
    """
    other = elastic.cube.sel(thickness=study.thicknesses)
    models = [("elastic", other, "stress-free")]
    models += [("whole model", study.cube, state) for state in STATES]
    levels, laws = [], []
    for direction in DIRECTIONS:
        for thickness in study.thicknesses:
            for model, cube, state in models:
                place = {"direction": direction, "thickness": thickness}
                words = [direction, f"{thickness}", f"{model}, {state}"]
                levels.append([*words, *_over_measured(cube, STATES[state], place)])
        for model, cube, state in models:
            law = fit_power_law(samples(cube, STATES[state], direction=direction)).fit
            exponents = (
                f"{law.value[key]:.2f} ({law.low[key]:.2f} to {law.high[key]:.2f})"
                for key in ("overlength", "thickness")
            )
            count = f"{law.n} of {int(realised(cube).sum())}"
            laws.append([direction, f"{model}, {state}", *exponents, count])
    heights = (f"over measured at {value:.3g} %" for value in study.overlengths)
    yield from rows(["", "µm", "model", *heights], levels)
    yield ""
    heads = ["", "model", "exponent of overlength", "exponent of thickness", "realisations"]
    yield from rows(heads, laws)


def _over_measured(cube: xr.Dataset, name: str, place: dict) -> Iterator[str]:
    law = published().power_laws[place["direction"]]["experiment"].law
    values = good(cube, name).sel(place).transpose("overlength", "seed")
    for overlength, seeds in zip(values["overlength"].values, values.values, strict=True):
        ratios = seeds[np.isfinite(seeds)] / law.stiffness(overlength, place["thickness"])
        if not ratios.size:
            yield "none positive"
            continue
        mean = f"{np.exp(np.log(ratios).mean()):.2f}"
        alone = ratios.size == 1
        yield mean if alone else f"{mean} ({ratios.min():.2f} to {ratios.max():.2f})"
