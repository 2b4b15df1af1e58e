"""NetCDF records of a realisation, written whole or not at all."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import netCDF4
import numpy as np

from foilstudy.base.files import written_whole
from foilstudy.base.provenance import git_commit

MACHINE_FAULTS = (MemoryError, OSError, ImportError)
"""Faults of the machine rather than of a realisation: their job fails and is done again, where a
record would be kept as the outcome."""


@dataclass(frozen=True)
class Quantity:
    """An array with its dimension names, unit and meaning."""

    values: np.ndarray | float
    units: str
    long_name: str
    dims: tuple[str, ...] = ()


def write_record(
    path: Path, quantities: Mapping[str, Quantity], attributes: Mapping[str, str | float | int]
) -> None:
    """Write quantities and attributes; the file appears only when it is complete.

    Parameters
    ----------
    path : Path
        Its folder is made if need be.
    quantities : mapping of str to Quantity
    attributes : mapping
        The commit of the code is added to them.
    """
    with written_whole(path) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
        file.setncatts({**attributes, "git_commit": git_commit()})
        for name, quantity in quantities.items():
            values = np.asarray(quantity.values)
            for dimension, length in zip(quantity.dims, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, length)
            options = {"compression": "zlib", "shuffle": True} if values.size > 64 else {}
            variable = file.createVariable(name, values.dtype, quantity.dims, **options)
            variable.units, variable.long_name = quantity.units, quantity.long_name
            variable[...] = values


def read_attributes(path: Path) -> dict:
    """The attributes of a record alone, which costs nothing where its arrays are large."""
    with netCDF4.Dataset(path) as file:
        return {name: file.getncattr(name) for name in file.ncattrs()}


def read_record(path: Path) -> tuple[dict[str, np.ndarray], dict]:
    """Values of every variable and the attributes of a record."""
    with netCDF4.Dataset(path) as file:
        file.set_auto_mask(False)
        values = {name: variable[...] for name, variable in file.variables.items()}
        return values, {name: file.getncattr(name) for name in file.ncattrs()}
