"""Sets of values in three numbers."""

from dataclasses import dataclass

import numpy as np
import xarray as xr


@dataclass(frozen=True)
class Spread:
    """Smallest, middle and largest of a set of values."""

    lowest: float
    median: float
    highest: float

    @classmethod
    def of(cls, values) -> "Spread | None":
        """Summarise the finite ``values``; None when there is none."""
        finite = np.asarray(values, dtype=float).ravel()
        finite = finite[np.isfinite(finite)]
        if finite.size == 0:
            return None
        return cls(float(finite.min()), float(np.median(finite)), float(finite.max()))


def by_thickness(values: xr.DataArray) -> dict[float, Spread]:
    """Summarise by thickness [um]; thicknesses without a finite value are left out."""
    spreads = {float(t): Spread.of(values.sel(thickness=t)) for t in values["thickness"].values}
    return {t: spread for t, spread in spreads.items() if spread is not None}


def by_direction(values: xr.DataArray) -> dict[str, dict[float, Spread]]:
    """Summarise by direction, then thickness [um]; what has no finite value is left out."""
    spreads = {str(d): by_thickness(values.sel(direction=d)) for d in values["direction"].values}
    return {d: found for d, found in spreads.items() if found}
