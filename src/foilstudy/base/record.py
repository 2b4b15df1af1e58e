"""NetCDF records of a realisation, written whole or not at all, and read only if they are whole."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np

from foilstudy.base.digest import digest_of
from foilstudy.base.errors import Refusal
from foilstudy.base.files import written_whole
from foilstudy.base.origin import Origin
from foilstudy.base.provenance import git_commit, package_versions

MACHINE_FAULTS = (MemoryError, OSError, ImportError)
"""Faults of the machine rather than of a realisation: their job fails and is done again, where a
record would be kept as the outcome."""

AGAIN = "run the study again, which makes it anew"
"""Remedy of a record that cannot be used."""

UNREADABLE = (OSError, RuntimeError, AttributeError, UnicodeDecodeError, ValueError)
"""What reading a damaged NetCDF file has ended in."""

_ADDED = ("task", "code", "made_from", "digest", "git_commit", "package_versions")
"""Attributes that `write_record` adds to those it is given."""


@dataclass(frozen=True)
class Quantity:
    """An array with its dimension names, unit and meaning."""

    values: np.ndarray | float
    units: str
    long_name: str
    dims: tuple[str, ...] = ()


def write_record(
    path: Path,
    quantities: Mapping[str, Quantity],
    attributes: Mapping[str, str | float | int],
    origin: Origin | None = None,
) -> None:
    """Write quantities and attributes; the file appears only when it is complete.

    Parameters
    ----------
    path : Path
        Its folder is made if need be.
    quantities : mapping of str to Quantity
    attributes : mapping
        The commit of the code, versions of the libraries and a digest are added to them.
    origin : Origin
        What the record was made of.
    """
    arrays = {name: np.asarray(quantity.values) for name, quantity in quantities.items()}
    added = (origin or Origin()).attributes() | {
        "digest": _digest(arrays, attributes),
        "git_commit": git_commit(),
        "package_versions": package_versions(),
    }
    with written_whole(path) as partial, netCDF4.Dataset(partial, "w", format="NETCDF4") as file:
        file.setncatts({**attributes, **added})
        for name, quantity in quantities.items():
            values = arrays[name]
            for dimension, length in zip(quantity.dims, values.shape, strict=True):
                if dimension not in file.dimensions:
                    file.createDimension(dimension, length)
            options = {"compression": "zlib", "shuffle": True} if values.size > 64 else {}
            variable = file.createVariable(name, values.dtype, quantity.dims, **options)
            variable.units, variable.long_name = quantity.units, quantity.long_name
            variable[...] = values


def read_attributes(path: Path) -> dict[str, Any]:
    """The attributes of a record alone, which costs nothing where its arrays are large.

    Raises
    ------
    Refusal
        If the file is missing, cut off, or no record.
    """
    try:
        with netCDF4.Dataset(path) as file:
            attributes = {name: file.getncattr(name) for name in file.ncattrs()}
    except UNREADABLE as error:
        raise unreadable(path, error) from None
    if "digest" not in attributes:
        raise Refusal(
            f"{path}: is not a record of foilstudy, or one of a release before 0.4; {AGAIN}."
        )
    return attributes


def read_record(path: Path) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Values of every variable and the attributes of a record.

    Raises
    ------
    Refusal
        If the file is missing, cut off, no record, or holds other values than were written.
    """
    attributes = read_attributes(path)
    try:
        with netCDF4.Dataset(path) as file:
            file.set_auto_mask(False)
            values = {name: variable[...] for name, variable in file.variables.items()}
    except UNREADABLE as error:
        raise unreadable(path, error) from None
    if _digest(values, attributes) != attributes["digest"]:
        raise Refusal(f"{path}: holds other values than were written; {AGAIN}.")
    return values, attributes


def unreadable(path: Path, error: Exception) -> Refusal:
    """The refusal of a file that NetCDF cannot read."""
    reason = getattr(error, "strerror", None) or str(error)
    return Refusal(f"{path}: cannot be read as a record ({reason}); {AGAIN}.")


def _digest(values: Mapping[str, np.ndarray], attributes: Mapping[str, Any]) -> str:
    """Of everything that the task decides, and so not of what it has cost."""
    words = {name: str(text) for name, text in attributes.items() if name not in _ADDED}
    return digest_of(values, json.dumps(words, sort_keys=True))
