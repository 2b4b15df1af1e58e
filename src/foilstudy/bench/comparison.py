"""A measured dynamic stiffness beside the simulated ones of its configuration."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from foilstudy.base.confidence import NORMAL_95, MeanInterval
from foilstudy.base.errors import Refusal
from foilstudy.base.outcome import USABLE
from foilstudy.base.registry import did_you_mean
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.static import STATIC_BAND_HZ, Static

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Comparison", "Configuration", "Excursion", "Simulated", "frac", "placed", "simulated"]


@dataclass(frozen=True)
class Configuration:
    """Which part of a cube a measurement belongs to; None where the cube has one only.

    Attributes
    ----------
    thickness_um, height_mm : float or None
        The height is that of the uncrumpled cylinder.
    direction, definition : str
    """

    thickness_um: float | None = None
    height_mm: float | None = None
    direction: str = "axial"
    definition: str = "transfer"


@dataclass(frozen=True, eq=False)
class Simulated:
    """All usable realisations of a configuration.

    Attributes
    ----------
    thickness_um, height_mm, overlength_percent : float
    direction, definition : str
    frequencies : ndarray, shape (f,)
        Hz.
    curves : ndarray of complex, shape (realisations, f)
        N/m; NaN above where a reduced model is valid.
    static : MeanInterval
        Of the static stiffness, N/m.
    """

    thickness_um: float
    height_mm: float
    overlength_percent: float
    direction: str
    definition: str
    frequencies: np.ndarray
    curves: np.ndarray
    static: MeanInterval

    def at(self, frequencies: np.ndarray) -> np.ndarray:
        """Curves at other frequencies, straight in the logarithm of the frequency."""
        x, own = np.log(frequencies), np.log(self.frequencies)
        return np.array([np.interp(x, own, curve) for curve in self.curves])


def simulated(cube: xr.Dataset, wanted: Configuration) -> Simulated:
    """The realisations of a configuration in a cube, as `open_cube` gives it.

    Raises
    ------
    Refusal
        If the cube does not have it, or none of its realisations is usable.
    """
    for name in ("direction", "definition"):
        known = [str(each) for each in cube[name].values]
        if getattr(wanted, name) not in known:
            hint = did_you_mean(getattr(wanted, name), known)
            raise Refusal(
                f"{getattr(wanted, name)!r} is no {name} of the cube; {hint}use one of "
                f"{', '.join(known)}."
            )
    i, j = placed(cube, wanted.thickness_um, wanted.height_mm)
    cell = cube.isel(thickness=i, overlength=j).sel(direction=wanted.direction)
    cell = cell.isel(seed=np.flatnonzero(cell["status"].isin(USABLE).values))
    curves = cell["dynamic_stiffness"].sel(definition=wanted.definition)
    thickness, height = float(cell["thickness"]), float(cell["reference_height"])
    curves = curves.transpose("seed", "frequency").to_numpy()
    if not np.isfinite(curves).any():
        raise Refusal(
            f"no realisation of {thickness:g} um, {height:g} mm is usable in the cube; see its "
            "status, or choose another configuration."
        )
    return Simulated(
        thickness, height, float(cell["overlength"]), wanted.direction, wanted.definition,
        cell["frequency"].to_numpy(), curves, MeanInterval.of(cell["static_stiffness"].to_numpy()),
    )  # fmt: skip


def placed(
    cube: xr.Dataset, thickness_um: float | None, height_mm: float | None
) -> tuple[int, int]:
    """Where a configuration stands along thickness and overlength of a cube.

    Raises
    ------
    Refusal
        If the cube does not have it, or has several and none is named.
    """
    return (
        _place(cube["thickness"].values, thickness_um, "thickness", "um"),
        _place(cube["reference_height"].values, height_mm, "height", "mm"),
    )


def _place(values: np.ndarray, wanted: float | None, name: str, unit: str) -> int:
    shown = ", ".join(f"{value:g}" for value in values)
    if wanted is None:
        if len(values) == 1:
            return 0
        raise Refusal(f"the cube has {name} {shown} {unit}; say which by --{name}.")
    nearest = int(np.argmin(np.abs(values - wanted)))
    if not np.isclose(values[nearest], wanted, rtol=1e-3):
        raise Refusal(f"the cube has no {name} of {wanted:g} {unit}; choose one of {shown}.")
    return nearest


def frac(one: np.ndarray, other: np.ndarray) -> float:
    """Frequency response assurance criterion |a^H b|^2 / (a^H a b^H b).

    1 where two responses differ by a factor only, at all frequencies the same.
    """
    return float(
        np.abs(np.vdot(one, other)) ** 2 / (np.vdot(one, one).real * np.vdot(other, other).real)
    )


@dataclass(frozen=True)
class Excursion:
    """A run of frequencies at which the measured magnitude is outside of the simulated band.

    Attributes
    ----------
    low_hz, high_hz : float
    above : bool
        Above the band; else below.
    factor : float
        Largest ratio of measured to the edge of the band that it has left, or its inverse.
    """

    low_hz: float
    high_hz: float
    above: bool
    factor: float


@dataclass(frozen=True, eq=False)
class Comparison:
    """Measured and simulated over the band that they share.

    Attributes
    ----------
    measured : Estimate
        Within that band.
    simulated : Simulated
    curves : ndarray of complex, shape (realisations, f)
        Simulated at the measured frequencies.
    static : Static or None
        Measured; None without a trusted value in its band.
    """

    measured: Estimate
    simulated: Simulated
    curves: np.ndarray
    static: Static | None

    @classmethod
    def of(
        cls,
        measured: Estimate,
        simulated: Simulated,
        static_band_hz: tuple[float, float] = STATIC_BAND_HZ,
    ) -> Comparison:
        """Over the frequencies of the measurement within those of the simulation.

        Raises
        ------
        Refusal
            If the two share fewer than two frequencies.
        """
        known = np.isfinite(simulated.curves).any(axis=0)
        low, high = simulated.frequencies[known][[0, -1]]
        inside = (measured.frequencies >= low) & (measured.frequencies <= high)
        if inside.sum() < 2:
            first, last = measured.frequencies[[0, -1]]
            raise Refusal(
                f"measured from {first:g} to {last:g} Hz and simulated from {low:g} to {high:g} Hz "
                f"share {inside.sum()} frequencies; simulate the measured band "
                "(dynamics.shown_min_hz, shown_max_hz)."
            )
        shared = measured.at(inside)
        low, high = static_band_hz
        at_rest = (measured.frequencies >= low) & (measured.frequencies <= high)
        known = (at_rest & measured.trusted).any()
        static = Static.of(measured, static_band_hz) if known else None
        return cls(shared, simulated, simulated.at(shared.frequencies), static)

    @cached_property
    def median(self) -> np.ndarray:
        """Of the simulated curves, real and imaginary part apart."""
        parts = [np.nanmedian(part, axis=0) for part in (self.curves.real, self.curves.imag)]
        return parts[0] + 1j * parts[1]

    @property
    def frac(self) -> float:
        """With the median, over the frequencies at which the measurement is trusted."""
        return self._frac(self.median)

    @property
    def frac_range(self) -> tuple[float, float]:
        """Least and largest with a single realisation."""
        each = [self._frac(curve) for curve in self.curves if np.isfinite(curve).all()]
        return (min(each), max(each)) if each else (np.nan, np.nan)

    def _frac(self, curve: np.ndarray) -> float:
        good = self.measured.trusted & np.isfinite(curve)
        return frac(self.measured.values[good], curve[good]) if good.any() else np.nan

    @property
    def ratio(self) -> float:
        """Median over the trusted frequencies of measured over median simulated magnitude."""
        good = self.measured.trusted
        if not good.any():
            return np.nan
        return float(np.median(np.abs(self.measured.values / self.median)[good]))

    @cached_property
    def excursion(self) -> np.ndarray:
        """How far the measured magnitude, with its interval, is beyond the band: measured over
        edge, above 1 above it, below 1 below; 1 inside and where it is not trusted."""
        size = np.abs(self.measured.values)
        half = NORMAL_95 / np.sqrt(2) * np.nan_to_num(self.measured.deviation)
        low, high = np.nanmin(np.abs(self.curves), axis=0), np.nanmax(np.abs(self.curves), axis=0)
        out = np.ones(size.shape)
        above, below = size - half > high, size + half < low
        out[above], out[below] = (size / high)[above], (size / low)[below]
        out[~self.measured.trusted] = 1.0
        return out

    @property
    def excursions(self) -> list[Excursion]:
        """Runs of neighbouring frequencies outside of the band on one side."""
        sides = np.sign(np.log(self.excursion)).astype(int)
        ends = np.flatnonzero(np.diff(sides)) + 1
        found = []
        for places in np.split(np.arange(sides.size), ends):
            side = sides[places[0]]
            if side:
                beyond = self.excursion[places] ** side
                f = self.measured.frequencies[places]
                found.append(Excursion(f[0], f[-1], side > 0, float(beyond.max())))
        return found
