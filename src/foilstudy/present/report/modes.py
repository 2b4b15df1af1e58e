"""What the study shows about many modes, in sentences."""

import math

import numpy as np
import xarray as xr

from foilstudy.base.numerals import nominal, number, number_range, percent_range, plural
from foilstudy.present.report.spread import Spread
from foilstudy.present.statistics.cells import measured
from foilstudy.present.statistics.modal_density import (
    ELEMENTS_PER_WAVE,
    plate_modal_density,
    resolved_up_to,
)
from foilstudy.present.statistics.overlength_spread import (
    OverlengthSpread,
    leave_one_out,
    overlength_spread,
    relative_magnitude,
)


def overlength_findings(cube: xr.Dataset) -> list[str]:
    """Say from which frequency on the overlengths are one curve within the scatter of seeds.

    Parameters
    ----------
    cube
        The study's result cube; its ``relative`` dynamic stiffness is used.
    """
    frequency = cube["frequency"].values
    found, starts = [], []
    for direction in map(str, cube["direction"].values):
        for thickness in cube["thickness"].values:
            magnitude = relative_magnitude(cube, thickness, direction)
            try:
                spread = overlength_spread(frequency, magnitude)
            except ValueError:
                continue  # one overlength or one seed: the figure says so
            found.append(spread)
            if math.isfinite(spread.one_curve_from_hz):
                jackknife = leave_one_out(frequency, magnitude)
                starts.append(f"{direction} {nominal(thickness)} µm {_start(spread, jackknife)}")
    if not found:
        return []
    return [_levels(found), _verdict(found, starts)]


def _start(spread: OverlengthSpread, jackknife: tuple[float, float]) -> str:
    text = f"from {number(spread.one_curve_from_hz)} Hz"
    if math.isfinite(jackknife[0]):
        low, high = map(number, jackknife)
        return f"{text} ({low} to {high} Hz with any one seed left out)"
    return f"{text} (but not whichever seed is left out)"


def _levels(found: list[OverlengthSpread]) -> str:
    frequency = found[0].frequency
    half = frequency[-1] / 2
    start = Spread.of([np.exp(spread.between[0]) for spread in found])
    end, seeds = (
        Spread.of([np.exp(spread.average_above(half)[part]) for spread in found]) for part in (0, 1)
    )
    return (
        "One standard deviation over the overlengths is a factor of "
        f"{number_range(start.lowest, start.highest)} at {nominal(frequency[0])} Hz and of "
        f"{number_range(end.lowest, end.highest)} between {nominal(half)} and "
        f"{nominal(frequency[-1])} Hz, where the seeds of one overlength scatter by a factor of "
        f"{number_range(seeds.lowest, seeds.highest)} (all directions and thicknesses)."
    )


def _verdict(found: list[OverlengthSpread], starts: list[str]) -> str:
    frequency = found[0].frequency
    end = f"{nominal(frequency[-1])} Hz"
    apart = [spread for spread in found if not math.isfinite(spread.one_curve_from_hz)]
    ratios = [np.divide(*spread.average_above(frequency[-1] / 2)) for spread in apart]
    if not starts:
        text = f"Nowhere does it stay within the scatter of the seeds up to {end}"
    else:
        cases = plural(len(found), "case")
        text = (
            f"It stays within the scatter of the seeds up to {end} in {len(starts)} of {cases}: "
            f"{'; '.join(starts)}"
        )
    if ratios:
        where = "In the others" if starts else "There"
        text += (
            f". {where} it is {number_range(min(ratios), max(ratios))} times that scatter between "
            f"{nominal(frequency[-1] / 2)} and {end}"
        )
    return f"{text}."


def modal_density_findings(cube: xr.Dataset) -> list[str]:
    """Say how many modes there are at high frequency, beside a flat plate of the same foil.

    Parameters
    ----------
    cube
        The study's result cube; says nothing where it counts no modes.
    """
    if "mode_count" not in cube:
        return []
    frequency = cube["frequency"].values
    first = int(np.searchsorted(frequency, frequency[-1] / 2))
    count = measured(cube, "mode_count").isel(frequency=[first, -1])
    density = count.diff("frequency").squeeze("frequency", drop=True)
    density = (density / (frequency[-1] - frequency[first])).mean("seed")
    spread = Spread.of(density)
    if spread is None:
        return []
    text = (
        f"Between {number(frequency[first])} and {nominal(frequency[-1])} Hz a sheet with held "
        f"rings has {number_range(spread.lowest, spread.highest)} modes per Hz"
    )
    plate = plate_modal_density(cube)
    if plate is not None:
        share = Spread.of(density / plate)
        text += (
            f", {percent_range(share.lowest, share.highest)} of what a flat plate of the same foil "
            "has (means over seeds)"
        )
    return [f"{text}.", *_unresolved(cube, frequency[-1])]


def _unresolved(cube: xr.Dataset, highest_hz: float) -> list[str]:
    limit = resolved_up_to(cube)
    if limit is None:
        return []
    beyond = limit.where(limit < highest_hz).dropna("thickness")
    if not beyond.size:
        return []
    cases = [
        f"{number(float(value))} Hz at {nominal(float(value['thickness']))} µm" for value in beyond
    ]
    return [
        f"A bending wave of that plate is shorter than {ELEMENTS_PER_WAVE} elements above "
        f"{', '.join(cases)}: beyond, the number of modes depends on the mesh."
    ]
