"""Which cells of the cube count, and the cube as flat arrays for fitting."""

from __future__ import annotations

from dataclasses import astuple, dataclass

import numpy as np

from foilstudy.base.outcome import NOT_NEEDED, USABLE
from foilstudy.measure.verdicts import FAULTS

PLASTIC_RELIEF = "plastic_relief_energy"
"""Share of the energy that plastic strains take off: negative, and only where foil may yield."""


@dataclass(frozen=True)
class Samples:
    """Usable values of one variable, one entry per realisation.

    Attributes
    ----------
    thickness_um, overlength_percent, reference_height_mm, value : ndarray, shape (n,)
    """

    thickness_um: np.ndarray
    overlength_percent: np.ndarray
    reference_height_mm: np.ndarray
    value: np.ndarray

    @property
    def configuration(self) -> np.ndarray:
        """Integer label of each sample's thickness and overlength, shape (n,)."""
        pairs = np.column_stack([self.thickness_um, self.overlength_percent])
        return np.unique(pairs, axis=0, return_inverse=True)[1].ravel()

    def with_those(self, others: Samples) -> Samples:
        """Return these samples and others."""
        both = zip(astuple(self), astuple(others), strict=True)
        return Samples(*(np.concatenate(pair) for pair in both))

    def at_thickness(self, thickness_um: float) -> Samples:
        """Return the samples of one thickness."""
        keep = self.thickness_um == thickness_um
        return Samples(
            self.thickness_um[keep],
            self.overlength_percent[keep],
            self.reference_height_mm[keep],
            self.value[keep],
        )


def realised(cube):
    """Return which realisations there are, failed ones among them.

    Where each configuration took as many as it needed, the cube is as long as the longest.

    Returns
    -------
    xarray.DataArray of bool
        With dimensions thickness, overlength, seed.
    """
    return (cube["status"] != NOT_NEEDED).transpose("thickness", "overlength", "seed")


def usable(values):
    """Return `values` with NaN wherever they are not finite and positive."""
    return values.where(np.isfinite(values) & (values > 0))


def sound(cube):
    """Return which realisations left a shape and have no fault among their verdicts.

    A cube of a release before 0.5 tells no verdict; there the status decides alone.

    Returns
    -------
    xarray.DataArray of bool
        With dimensions thickness, overlength, seed.
    """
    left_shape = cube["status"].isin(USABLE)
    return left_shape & ~found_any(cube, FAULTS) if "verdict" in cube else left_shape


def found_any(cube, names):
    """Return where one of these verdicts was found, by the bits that the cube itself declares."""
    what = cube["verdict"]
    known = dict(zip(what.attrs["flag_meanings"].split(), what.attrs["flag_masks"], strict=True))
    return (what & sum(int(known.get(name, 0)) for name in names)) != 0


def measured(cube, name: str, **selection):
    """Return variable `name`, of either sign, where the realisation left a shape.

    Parameters
    ----------
    name
        A quantity with dimensions thickness, overlength, seed and maybe others.
    selection
        Passed to ``sel``, for example ``direction="axial"``.

    Returns
    -------
    xarray.DataArray
        NaN where the realisation is not `sound`, or the value is not finite.
    """
    values = cube[name]
    return values.where(np.isfinite(values) & sound(cube)).sel(**selection)


def good(cube, name: str, **selection):
    """Return variable `name` with every cell that must not enter the statistics set to NaN.

    Parameters
    ----------
    name
        A positive quantity with dimensions thickness, overlength, seed and maybe others.
    selection
        Passed to ``sel``, for example ``direction="axial"``.

    Returns
    -------
    xarray.DataArray
        NaN where the realisation is not `sound`, or the value is not finite and positive.
    """
    return usable(measured(cube, name, **selection))


def closed_contacts(cube):
    """Return how many pairs of the foil and knots at the planes of the rings are in contact.

    Returns
    -------
    xarray.DataArray
        With dimensions thickness, overlength, seed; of a cube with contact.
    """
    closed, at_rings = measured(cube, "contact_pairs"), "contact_knots_at_rings"
    return closed + measured(cube, at_rings).fillna(0) if at_rings in cube else closed


def energy_left(cube):
    """Return the elastic energy in each shape, J: what plastic strains take off is taken off.

    Returns
    -------
    xarray.DataArray
        With dimensions thickness, overlength, seed.
    """
    total = cube["membrane_energy"] + cube["bending_energy"] + cube["stabilisation_energy"]
    return total + cube[PLASTIC_RELIEF] if PLASTIC_RELIEF in cube else total


def relative_mesh_error(cube):
    """Return the stated mesh error of the stress-free stiffness over its mesh limit.

    Returns
    -------
    xarray.DataArray
        Share of one, with dimensions thickness, overlength, seed, direction; NaN where it was not
        measured.
    """
    return measured(cube, "static_stiffness_mesh_error") / good(cube, "static_stiffness_converged")


def samples(cube, name: str, **selection) -> Samples:
    """Return the usable values of variable `name` as flat arrays; see `good`."""
    values = good(cube, name, **selection).transpose("thickness", "overlength", "seed")
    array = values.to_numpy()
    i, j, _ = np.nonzero(np.isfinite(array))
    return Samples(
        thickness_um=cube["thickness"].to_numpy()[i].astype(float),
        overlength_percent=cube["overlength"].to_numpy()[j].astype(float),
        reference_height_mm=cube["reference_height"].to_numpy()[j].astype(float),
        value=array[np.isfinite(array)],
    )
