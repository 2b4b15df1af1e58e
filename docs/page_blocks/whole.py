"""Block of a study with the whole model, beside the elastic foil and the measured law."""

from __future__ import annotations

from collections.abc import Iterator
from functools import reduce

import numpy as np
import xarray as xr

from foilstudy.base.reference import published
from foilstudy.present.statistics.cells import Samples, good, realised, samples
from foilstudy.present.statistics.powerlaw import AS_IT_STANDS, SIMULATED, fit_power_law
from page_blocks.study import DIRECTIONS, Study, rows

STATES = {
    "stress-free": SIMULATED["simulation"],
    "stress-free, contacts stuck": "stiffness_contacts_stuck",
    "as it stands": SIMULATED[AS_IT_STANDS],
}
"""Quantities by what they are called here, all on the mesh of the crumple."""


def whole(study: Study, elastic: Study, *thinner: Study) -> Iterator[str]:
    """Stiffness over that of the measured law, and exponents; of the elastic foils the same ones.

    Where a configuration has several values, geometric mean and extremes. Studies of `thinner` foil
    by the same model may lack some of the overlengths.
    """
    cubes = [each.cube for each in (*thinner, study)]
    thicknesses = [thickness for each in (*thinner, study) for thickness in each.thicknesses]
    other = [elastic.cube.sel(thickness=thicknesses)]
    models = [("elastic", other, "stress-free")]
    models += [("whole model", cubes, state) for state in STATES]
    levels, laws = [], []
    for direction in DIRECTIONS:
        for thickness in thicknesses:
            for model, sources, state in models:
                (cube,) = (each for each in sources if thickness in each["thickness"])
                place = {"direction": direction, "thickness": thickness}
                words = [direction, f"{thickness}", f"{model}, {state}"]
                ratios = _over_measured(cube, STATES[state], place)
                levels.append([*words, *(ratios.get(at, "–") for at in study.overlengths)])
        for model, sources, state in models:
            first, *more = (samples(each, STATES[state], direction=direction) for each in sources)
            law = fit_power_law(reduce(Samples.with_those, more, first)).fit
            exponents = (
                f"{law.value[key]:.2f} ({law.low[key]:.2f} to {law.high[key]:.2f})"
                for key in ("overlength", "thickness")
            )
            count = f"{law.n} of {sum(int(realised(each).sum()) for each in sources)}"
            laws.append([direction, f"{model}, {state}", *exponents, count])
    heights = (f"over measured at {value:.3g} %" for value in study.overlengths)
    yield from rows(["", "µm", "model", *heights], levels)
    yield ""
    heads = ["", "model", "exponent of overlength", "exponent of thickness", "realisations"]
    yield from rows(heads, laws)


def _over_measured(cube: xr.Dataset, name: str, place: dict) -> dict[float, str]:
    """By overlength, %."""
    law = published().power_laws[place["direction"]]["experiment"].law
    values = good(cube, name).sel(place).transpose("overlength", "seed")
    words = {}
    for overlength, seeds in zip(values["overlength"].values, values.values, strict=True):
        ratios = seeds[np.isfinite(seeds)] / law.stiffness(overlength, place["thickness"])
        words[overlength] = _told(ratios) if ratios.size else "none positive"
    return words


def _told(ratios: np.ndarray) -> str:
    mean = f"{np.exp(np.log(ratios).mean()):.2f}"
    alone = ratios.size == 1
    return mean if alone else f"{mean} ({ratios.min():.2f} to {ratios.max():.2f})"
