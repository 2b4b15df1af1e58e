"""Block of one study beside the same in another ramp."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.special import stdtrit

from foilstudy.base.confidence import CONFIDENCE, MeanInterval, Ratio
from foilstudy.present.statistics.cells import good
from foilstudy.present.statistics.powerlaw import LIMIT, SIMULATED, fit_power_law, samples
from page_blocks.study import DIRECTIONS, Study, rows


def ramps(slow: Study, usual: Study) -> Iterator[str]:
    """Means of a study over those of another, cell by cell and over all, and both laws."""
    body, laws = [], []
    for direction in DIRECTIONS:
        logarithms = []
        for thickness in slow.thicknesses:
            cells = []
            for overlength in slow.cube["overlength"].values:
                place = {"direction": direction, "thickness": thickness, "overlength": overlength}
                means = [
                    MeanInterval.of(good(each.cube, SIMULATED[LIMIT]).sel(place).values)
                    for each in (slow, usual)
                ]
                ratio = Ratio.of(*means)
                logarithms.append((thickness, np.log(ratio.value)))
                cells.append(f"{ratio.value:.2f}")
            mine = np.array([value for of, value in logarithms if of == thickness])
            body.append([direction, f"{thickness}", *cells, _mean(mine)])
        every = np.array([value for _, value in logarithms])
        body.append([direction, "all", *("" for _ in cells), _mean(every)])
        for study in (slow, usual):
            law = fit_power_law(samples(study.cube, SIMULATED[LIMIT], direction=direction)).fit
            exponents = (
                f"{law.value[key]:.2f} ({law.low[key]:.2f} to {law.high[key]:.2f})"
                for key in ("overlength", "thickness")
            )
            laws.append([direction, f"`results/{study.folder.name}`", *exponents, f"{law.n}"])
    heads = ["", "µm", *(f"{value:.3g} %" for value in slow.overlengths), "geometric mean (95 %)"]
    yield from rows(heads, body)
    yield ""
    yield from rows(["", "law of", "exponent of overlength", "exponent of thickness", "n"], laws)


def _mean(logarithms: np.ndarray) -> str:
    """Of ratios of cells, each counted once, with Student's interval over the cells."""
    n = len(logarithms)
    half = stdtrit(n - 1, 0.5 + CONFIDENCE / 2) * logarithms.std(ddof=1) / np.sqrt(n)
    low, value, high = np.exp(logarithms.mean() + half * np.array([-1, 0, 1]))
    return f"{value:.2f} ({low:.2f} to {high:.2f})"
