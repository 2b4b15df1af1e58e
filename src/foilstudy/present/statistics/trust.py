"""Which stiffnesses of a study can be trusted: resolved crumples with a small stated mesh error."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

import numpy as np

from foilstudy.measure.verdicts import DOUBTS
from foilstudy.model.mesh_size import SLENDERNESS_MAX
from foilstudy.model.shell.folding import FOLD_ANGLE_MAX_DEG
from foilstudy.present.comparison import studied_case
from foilstudy.present.statistics.cells import (
    found_any,
    good,
    measured,
    relative_mesh_error,
    sound,
)

if TYPE_CHECKING:
    import xarray as xr

ERROR_MAX = 0.2
"""Largest stated mesh error, a share of the value, of a stiffness that is trusted."""

_ROUNDING = 1e-6
"""What a size or an error may exceed its bound by."""


@dataclass(frozen=True)
class Trust:
    """Verdict on the stiffness of every configuration.

    Attributes
    ----------
    slenderness : xarray.DataArray (thickness, overlength)
        Element size over sqrt(R t), the largest of the realisations; NaN where it is not known.
    fold_angle : xarray.DataArray (thickness, overlength)
        Degrees from element to element (see `foilstudy.model.shell.folding`), the median of the
        realisations; NaN where it was not recorded.
    mesh_error : xarray.DataArray (thickness, overlength, direction)
        Stated error over the mesh limit, the largest of the realisations; NaN where none is.
    known : xarray.DataArray of bool (thickness, overlength, direction)
        Whether there is any stiffness.
    unresolved, folded, unstated, inaccurate, flawed : xarray.DataArray of bool, as `known`
        Why a known one is not trusted: its elements are wider than folds; its folds turn more than
        `FOLD_ANGLE_MAX_DEG` from one element to the next; a mesh error is not stated; that is
        larger than `ERROR_MAX`; most of its realisations have a verdict that casts doubt
        (`foilstudy.measure.verdicts`).
    """

    slenderness: xr.DataArray
    fold_angle: xr.DataArray
    mesh_error: xr.DataArray
    known: xr.DataArray
    unresolved: xr.DataArray
    folded: xr.DataArray
    unstated: xr.DataArray
    inaccurate: xr.DataArray
    flawed: xr.DataArray

    @property
    def trusted(self):
        """Known stiffnesses that nothing speaks against."""
        return self.known & ~self.doubted

    @property
    def doubted(self):
        """Known stiffnesses that are not trusted."""
        return self.unresolved | self.folded | self.unstated | self.inaccurate | self.flawed

    def at(self, thickness: int, overlength: int) -> Trust:
        """The verdict on one configuration, by its places in the cube."""
        place = {"thickness": thickness, "overlength": overlength}
        return Trust(*(getattr(self, each.name).isel(place) for each in fields(self)))


def assess_trust(cube) -> Trust:
    """Judge the stiffness of every configuration of a cube, direction by direction."""
    value = good(cube, "static_stiffness")
    known = np.isfinite(value).any("seed")
    slenderness = _slenderness(cube)
    unresolved = known & ~(slenderness <= SLENDERNESS_MAX * (1 + _ROUNDING))
    if "static_stiffness_converged" in cube:
        error = relative_mesh_error(cube).where(np.isfinite(value))
    else:
        error = value * np.nan
    unstated = (np.isfinite(value) & ~np.isfinite(error)).any("seed")
    largest = error.max("seed")
    inaccurate = known & (largest > ERROR_MAX * (1 + _ROUNDING))
    fold_angle = _fold_angle(cube)
    folded = known & (fold_angle > FOLD_ANGLE_MAX_DEG)
    order = ("thickness", "overlength", "direction")
    flawed = known & (_doubted_share(cube) > 0.5)
    arrays = (largest, known, unresolved, folded, unstated, inaccurate, flawed)
    return Trust(slenderness, fold_angle, *(array.transpose(*order) for array in arrays))


def _slenderness(cube):
    case = studied_case(cube)
    if case is None or "element_size" not in cube:
        return cube["thickness"] * cube["overlength"] * np.nan
    size = cube["element_size"].max("seed").transpose("thickness", "overlength")
    return size / np.sqrt(case.diameter_mm / 2 * cube["thickness"] * 1e-3)


def _doubted_share(cube):
    """Of the realisations that count: those with a verdict that casts doubt."""
    if "verdict" not in cube:  # of a release before 0.5
        return cube["thickness"] * cube["overlength"] * 0.0
    return found_any(cube, DOUBTS).where(sound(cube)).mean("seed")


def _fold_angle(cube):
    if "fold_angle" not in cube:  # of a release before 0.4
        return cube["thickness"] * cube["overlength"] * np.nan
    return measured(cube, "fold_angle").median("seed").transpose("thickness", "overlength")


def where_trusted(cube, name: str):
    """A stiffness of the cube, with what is not trusted set to NaN.

    Parameters
    ----------
    name
        A quantity with dimensions thickness, overlength, seed, direction.
    """
    return cube[name].where(assess_trust(cube).trusted)
