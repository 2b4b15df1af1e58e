"""The cube of a study as a file: how it is recognised and opened."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from foilstudy.base.digest import digest_of
from foilstudy.base.errors import Refusal

if TYPE_CHECKING:
    import xarray as xr

CONVENTION = "foilstudy cube 1"
CONTENT = "content"
"""Attribute with the digest of all values, coordinates included."""
_REAL = "_re"
"""Ending of the real part of a variable, whose imaginary part ends in ``_im``."""


def verified_attributes(path: Path) -> dict[str, Any]:
    """Attributes of a cube whose values are those that were written.

    Raises
    ------
    Refusal
        If the file is unreadable, no cube of a release from 0.4 on, or holds other values.
    """
    # a tenth of a second; only those who doubt a cube wait for it
    import netCDF4

    from foilstudy.base.record import AGAIN, UNREADABLE, read_attributes, unreadable

    attributes = read_attributes(path)
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_maskandscale(False)
            values = {name: variable[...] for name, variable in file.variables.items()}
    except UNREADABLE as error:
        raise unreadable(path, error) from None
    if digest_of(values) != attributes.get(CONTENT):
        raise Refusal(f"{path}: holds other values than were written; {AGAIN}.")
    return attributes


def open_cube(path: str | Path) -> xr.Dataset:
    """Open a cube with its dynamic stiffness as one complex variable.

    Parameters
    ----------
    path : str or Path
        ``results/NAME/cube.nc``.

    Returns
    -------
    xarray.Dataset
        Loaded; ``dynamic_stiffness`` replaces its real and imaginary parts, and so do
        ``true_dynamic_stiffness`` and those of closed contacts where there are any.

    Raises
    ------
    Refusal
        If there is no such file, or if it is not a cube of this package.
    """
    import xarray as xr  # half a second; only those who open a cube wait for it

    path = Path(path)
    if not path.exists():
        raise Refusal(f"{path} does not exist; run the study first or correct the path.")
    if not path.is_file():
        raise Refusal(f"{path} is not a file; give the cube.nc of a study.")
    try:
        with xr.open_dataset(path, engine="netcdf4") as file:
            cube = file.load()
    except (OSError, ValueError, RuntimeError) as error:
        raise Refusal(
            f"{path} is not a NetCDF file that can be read ({error}); give the cube.nc of a study."
        ) from error
    parts = {"dynamic_stiffness_re", "dynamic_stiffness_im"}
    if cube.attrs.get("Conventions") != CONVENTION or not parts <= set(cube):
        raise Refusal(
            f"{path} is a NetCDF file but not a cube of foilstudy; give the cube.nc of a study, "
            "not the record of one realisation."
        )
    for name in [str(each).removesuffix(_REAL) for each in cube if str(each).endswith(_REAL)]:
        if f"{name}_im" not in cube:
            continue
        real, imaginary = cube[f"{name}{_REAL}"], cube[f"{name}_im"]
        words = real.attrs.get("long_name", "").removesuffix(", real part")
        whole = (real + 1j * imaginary).assign_attrs(real.attrs | {"long_name": words})
        cube = cube.assign({name: whole}).drop_vars([f"{name}{_REAL}", f"{name}_im"])
    return cube
