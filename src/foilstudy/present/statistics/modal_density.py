"""Modal density: counted from the study, and what a flat plate of the same foil has."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.materials import Material
from foilstudy.present.configuration import configuration, material
from foilstudy.present.statistics.cells import sound

BANDWIDTH_OCTAVES = 0.5
"""Width of the band over which a modal density is counted."""

ELEMENTS_PER_WAVE = 4
"""Fewest elements in a bending wave that is still resolved: uniform quadratic B-splines with
consistent mass raise the frequency of such a wave on a beam by 11 %, with six elements by 5 %."""


@dataclass(frozen=True)
class Plate:
    """A flat thin plate.

    Attributes
    ----------
    thickness : float or ndarray
        m.
    """

    material: Material
    thickness: float | np.ndarray

    @property
    def _k2_over_omega(self):
        """Squared wave number over omega: sqrt(rho t / D), s/m2."""
        material = self.material
        bending = material.youngs_modulus * self.thickness**3
        bending = bending / (12 * (1 - material.poisson_ratio**2))
        return np.sqrt(material.density * self.thickness / bending)

    def modal_density(self, area):
        """Modes per Hz of bending of a plate of any outline, asymptotically for many modes.

        The number of modes below omega is A k^2 / (4 pi), the area that a circle with the bending
        wave number k covers in the wave number plane, with k^2 = omega sqrt(rho t / D): the density
        A / 2 sqrt(rho t / D) is the same at all frequencies. R. H. Lyon and R. G. DeJong, Theory
        and Application of Statistical Energy Analysis, 2nd ed., 1995.

        Parameters
        ----------
        area : float or ndarray
            m2.
        """
        return 0.5 * area * self._k2_over_omega

    def frequency_of_wave(self, length):
        """Frequency in Hz at which a bending wave has the given length in m."""
        wave_number = 2 * np.pi / length
        return wave_number**2 / self._k2_over_omega / (2 * np.pi)


def modal_density(
    frequency: np.ndarray, count: np.ndarray, octaves: float = BANDWIDTH_OCTAVES
) -> np.ndarray:
    """Modes per Hz, counted in a band about each frequency.

    Parameters
    ----------
    frequency : ndarray, shape (f,)
        Hz, ascending and positive.
    count : ndarray, shape (..., f)
        Number of modes below each frequency; it is interpolated linearly between them.
    octaves : float
        Width of the band; at the ends of the grid, where a part of the band lies outside, the rest
        of it.

    Returns
    -------
    ndarray, shape (..., f)

    Raises
    ------
    ValueError
        If the frequencies are not positive and ascending, or fit the counts badly.
    """
    frequency, count = np.asarray(frequency, float), np.asarray(count, float)
    if frequency.size < 2 or frequency[0] <= 0 or (np.diff(frequency) <= 0).any():
        raise ValueError("modal_density: give two or more positive frequencies in ascending order.")
    if count.shape[-1:] != frequency.shape:
        raise ValueError(
            f"modal_density: {count.shape[-1:]} counts do not fit {frequency.size} frequencies; "
            "give one per frequency, in the last dimension."
        )
    half = 2 ** (octaves / 2)
    lower = np.maximum(frequency / half, frequency[0])
    upper = np.minimum(frequency * half, frequency[-1])
    rows = count.reshape(-1, frequency.size)
    inside = [np.interp(upper, frequency, row) - np.interp(lower, frequency, row) for row in rows]
    return (np.array(inside) / (upper - lower)).reshape(count.shape)


def counted_modal_density(cube):
    """Modal density of every realisation with both rings held.

    Parameters
    ----------
    cube : xarray.Dataset
        With ``mode_count``.

    Returns
    -------
    xarray.DataArray
        Modes per Hz, dimensions thickness, overlength, seed, frequency; NaN where the realisation
        diverged or failed.
    """
    dims = ("thickness", "overlength", "seed", "frequency")
    count = cube["mode_count"].where(sound(cube)).transpose(*dims)
    return count.copy(data=modal_density(cube["frequency"].to_numpy(), count.to_numpy()))


def plate_modal_density(cube):
    """Modal density of a flat plate of the same foil, or None where the cube does not tell it.

    Parameters
    ----------
    cube : xarray.Dataset
        With the study's configuration in its attributes.

    Returns
    -------
    xarray.DataArray or None
        Modes per Hz, dimensions thickness, overlength.
    """
    plate, sheet = _plate(cube), configuration(cube).get("sheet", {})
    if plate is None or "diameter_mm" not in sheet:
        return None
    area = np.pi * 1e-3 * sheet["diameter_mm"] * 1e-3 * cube["reference_height"]
    return plate.modal_density(area)


def resolved_up_to(cube):
    """Frequency above which the shortest bending waves have too few elements, or None.

    That of a flat plate, whose bending waves are the shortest that the foil can have at a
    frequency; above it the number of modes depends on the mesh.

    Parameters
    ----------
    cube : xarray.Dataset
        With the study's configuration in its attributes, and ``element_size`` in mm.

    Returns
    -------
    xarray.DataArray or None
        Hz, dimension thickness; NaN where no realisation tells its element size.
    """
    plate = _plate(cube)
    if plate is None or "element_size" not in cube:
        return None
    size = 1e-3 * cube["element_size"].max(["overlength", "seed"])
    return plate.frequency_of_wave(ELEMENTS_PER_WAVE * size)


def _plate(cube) -> Plate | None:
    """A flat plate of the study's foil, of every thickness."""
    known = material(cube)
    return None if known is None else Plate(known, 1e-6 * cube["thickness"])
