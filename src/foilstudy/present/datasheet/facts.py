"""What a data sheet says of one configuration."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from foilstudy.base.confidence import MeanInterval
from foilstudy.base.errors import Refusal
from foilstudy.base.numerals import percent
from foilstudy.bench.comparison import placed
from foilstudy.bench.transfer_level import band_levels
from foilstudy.measure.stiffness import DOF_NAMES
from foilstudy.measure.stiffness.contacts import CONTACT_SPRINGS
from foilstudy.present.statistics.cells import closed_contacts, good, measured, realised
from foilstudy.present.statistics.trust import ERROR_MAX, Trust, assess_trust

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Bands", "Direction", "LinkFacts", "Value", "link_facts"]

LINEAR_AMPLITUDE = "amplitude_1_percent"
"""Variable of a cube with the amplitude at which the stiffness has changed by 1 %."""

BESIDE = {
    "stiffness_contacts_ignored": "contacts open",
    "stiffness_contacts_stuck": "contacts stuck",
    "true_stiffness": "as it stands",
    "stiffness_loading": "as it stands, {0}",
    "stiffness_unloading": "as it stands, {1}",
}
"""Variables of a cube with another static stiffness of a direction, where it holds them, and what
they are of."""
_WAYS = {
    "axial": ("pushed together", "pulled apart"),
    "radial": ("along x and y", "the other way"),
}


@dataclass(frozen=True)
class Value:
    """A quantity over the realisations.

    Attributes
    ----------
    interval : MeanInterval
        Mean with its 95 % interval, scatter and number of values.
    least, most : float
        Of the realisations; NaN of none.
    """

    interval: MeanInterval
    least: float
    most: float

    @classmethod
    def of(cls, values: np.ndarray) -> Self:
        """Of positive values; those that are not finite do not count."""
        values = np.asarray(values, float).ravel()
        finite = values[np.isfinite(values)]
        ends = (float(finite.min()), float(finite.max())) if finite.size else (np.nan, np.nan)
        return cls(MeanInterval.of(values), *ends)

    @classmethod
    def of_any_sign(cls, values: np.ndarray) -> Self:
        """Of values that may be negative; then no interval and no scatter are told."""
        values = values[np.isfinite(values)]
        if (values > 0).all():
            return cls.of(values)
        plain = MeanInterval(values.size, float(values.mean()), np.nan, np.nan, np.nan)
        return cls(plain, float(values.min()), float(values.max()))

    @property
    def known(self) -> bool:
        """Whether there is any."""
        return self.interval.n > 0


@dataclass(frozen=True, eq=False)
class Bands:
    """Levels of one-third octaves, dB re 1 N/m.

    Attributes
    ----------
    centres : ndarray, shape (bands,)
        Hz.
    mean, least, most : ndarray, shape (bands,)
        Over the realisations of which the level is known; NaN where it is of none.
    """

    centres: np.ndarray
    mean: np.ndarray
    least: np.ndarray
    most: np.ndarray

    @classmethod
    def of(cls, frequencies: np.ndarray, curves: np.ndarray) -> Self:
        """Of the transfer stiffness of several realisations, shape (realisations, f), N/m."""
        centres, levels = band_levels(frequencies, curves)
        known = np.isfinite(levels)
        count = known.sum(axis=0)
        least = np.where(known, levels, np.inf).min(axis=0, initial=np.inf)
        most = np.where(known, levels, -np.inf).max(axis=0, initial=-np.inf)
        mean = np.where(known, levels, 0.0).sum(axis=0) / np.maximum(count, 1)
        kept = count > 0
        return cls(centres[kept], mean[kept], least[kept], most[kept])


@dataclass(frozen=True, eq=False)
class Direction:
    """Axial or radial.

    Attributes
    ----------
    name : str
    static : Value
        On the mesh that was crumpled, N/m.
    limit : Value
        The same shapes at element size zero, N/m; of none where no mesh error is stated.
    mesh_error : float
        Largest stated one of a realisation over its value; NaN where none is.
    doubts : tuple of str
        Why the values are not trusted; empty where they are.
    amplitude : Value or None
        At which the stiffness has changed by 1 %, in `LinkFacts.amplitude_unit`; None where the
        cube does not hold it.
    curves : ndarray of complex, shape (realisations, f)
        Transfer stiffness, N/m; NaN where it is not valid.
    bands : Bands
    beside : dict of str to Value
        Other static stiffnesses on the mesh that was crumpled, by what they are of, N/m; those of
        contacts where any is closed.
    """

    name: str
    static: Value
    limit: Value
    mesh_error: float
    doubts: tuple[str, ...]
    amplitude: Value | None
    curves: np.ndarray
    bands: Bands
    beside: dict[str, Value]


@dataclass(frozen=True, eq=False)
class LinkFacts:
    """One configuration.

    Attributes
    ----------
    thickness_um, height_mm, overlength_percent : float
        The height is that of the uncrumpled cylinder.
    realisations, counted : int
        How many there are, and how many of them enter the numbers.
    not_converged : int
        Of those that enter.
    directions : tuple of Direction
    motions : dict of str to Value
        Static stiffness of each motion of the bottom ring, all others and the top ring held: N/m
        along x, y, z, N m/rad about them.
    first_hz : Value
        First eigenfrequency with both rings clamped.
    frequencies : ndarray, shape (f,)
        Hz.
    valid_to_hz : float
        Least of the realisations; infinite where a reduced model has no such bound.
    amplitude_unit : str
    """

    thickness_um: float
    height_mm: float
    overlength_percent: float
    realisations: int
    counted: int
    not_converged: int
    directions: tuple[Direction, ...]
    motions: dict[str, Value]
    first_hz: Value
    frequencies: np.ndarray
    valid_to_hz: float
    amplitude_unit: str = ""

    @property
    def band_hz(self) -> tuple[float, float]:
        """From where to where all realisations are valid."""
        low, high = self.frequencies[[0, -1]]
        return float(low), float(min(high, self.valid_to_hz))


def link_facts(
    cube: xr.Dataset, thickness_um: float | None = None, height_mm: float | None = None
) -> LinkFacts:
    """Read a configuration from a cube, as `open_cube` gives it.

    Raises
    ------
    Refusal
        If the cube does not have it, or none of its realisations counts.
    """
    i, j = placed(cube, thickness_um, height_mm)
    trust = assess_trust(cube).at(i, j)
    there = realised(cube)[i, j]
    cell = cube.isel(thickness=[i], overlength=[j])
    if not np.isfinite(good(cell, "static_stiffness")).any():
        raise Refusal(
            f"no realisation of {float(cube['thickness'][i]):g} um, "
            f"{float(cube['reference_height'][j]):g} mm counts in the cube; see its status and "
            "verdicts, or choose another configuration."
        )
    static = _by_seed(good(cell, "static_stiffness", direction=cube["direction"].values[0]))
    counted = np.isfinite(static)
    status = cube["status"].isel(thickness=i, overlength=j).values
    names = [str(name) for name in cube["direction"].values]
    return LinkFacts(
        float(cube["thickness"][i]),
        float(cube["reference_height"][j]),
        float(cube["overlength"][j]),
        int(there.sum()),
        int(counted.sum()),
        int((status[counted] == "not_converged").sum()),
        tuple(_direction(cell, name, trust, counted) for name in names),
        _motions(cell),
        Value.of(_by_seed(good(cell, "first_eigenfrequency"))),
        cube["frequency"].to_numpy(),
        _valid_to(cell, counted),
        cube[LINEAR_AMPLITUDE].attrs.get("units", "") if LINEAR_AMPLITUDE in cube else "",
    )


def _valid_to(cell: xr.Dataset, counted: np.ndarray) -> float:
    """Infinite where no realisation states a bound, as in cubes of old."""
    if "valid_to_frequency" not in cell:
        return np.inf
    valid = _by_seed(measured(cell, "valid_to_frequency"))[counted]
    return float(np.min(valid[np.isfinite(valid)], initial=np.inf))


def _by_seed(values: xr.DataArray) -> np.ndarray:
    """Values of one cell, shape (seeds,)."""
    return values.isel(thickness=0, overlength=0).to_numpy()


def _direction(cell: xr.Dataset, name: str, trust: Trust, counted: np.ndarray) -> Direction:
    limit, amplitude = Value.of(np.empty(0)), None
    if "static_stiffness_converged" in cell:
        limit = Value.of(_by_seed(good(cell, "static_stiffness_converged", direction=name)))
    if LINEAR_AMPLITUDE in cell:
        amplitude = Value.of(_by_seed(good(cell, LINEAR_AMPLITUDE, direction=name)))
    dynamic = measured(cell, "dynamic_stiffness", direction=name, definition="transfer")
    curves = dynamic.isel(thickness=0, overlength=0).transpose("seed", "frequency").to_numpy()
    curves = curves[counted]
    return Direction(
        name,
        Value.of(_by_seed(good(cell, "static_stiffness", direction=name))),
        limit,
        float(trust.mesh_error.sel(direction=name)),
        tuple(_doubts(trust, name)),
        amplitude,
        curves,
        Bands.of(cell["frequency"].to_numpy(), curves),
        dict(_beside(cell, name)),
    )


def _beside(cell: xr.Dataset, name: str) -> Iterator[tuple[str, Value]]:
    bracket = [f"stiffness_contacts_{kind}" for kind in CONTACT_SPRINGS]
    if "contact_pairs" in cell and not (closed_contacts(cell) > 0).any():
        cell = cell.drop_vars(bracket)  # it is a point
    for variable, words in BESIDE.items():
        if variable in cell:
            value = Value.of_any_sign(_by_seed(measured(cell, variable, direction=name)))
            if value.known:
                yield words.format(*_WAYS[name]), value


def _doubts(trust: Trust, direction: str) -> Iterator[str]:
    words = {
        "unresolved": "its elements are wider than its folds: the crumple is not resolved",
        "folded": "its folds turn too far from one element to the next",
        "flawed": "most of its realisations have hourglassed or locked",
        "inaccurate": f"its mesh error is above {percent(ERROR_MAX)}",
        "unstated": "its mesh error is not stated for all realisations",
    }
    for name, text in words.items():
        if bool(getattr(trust, name).sel(direction=direction)):
            yield text


def _motions(cell: xr.Dataset) -> dict[str, Value]:
    """Of the bottom ring; along x, y and z the transfer stiffness, too, as a motion of both rings
    alike costs nothing."""
    if "interface_stiffness" not in cell:
        return {}
    matrix = measured(cell, "interface_stiffness")
    return {
        name: Value.of(_by_seed(matrix.sel(interface_dof=name, interface_dof_in=name)))
        for name in DOF_NAMES[:6]
    }
