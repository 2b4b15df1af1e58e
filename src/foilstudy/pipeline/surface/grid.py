"""A grid of surface points from a file or an array."""

from __future__ import annotations

import math
import re
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

POINTS_MAX = 10_000_000
"""Of a file: some ten times what a shell model could use."""
_HEAD = 65_536
"""Bytes in which a VTK file says how it is made."""


@dataclass(frozen=True)
class SurfaceGrid:
    """Points of a closed surface, row by row from ring to ring.

    Attributes
    ----------
    points : ndarray, shape (rows, columns, 3)
        m. Rows go around and are closed, columns go from the first ring to the last; evenly spaced
        on the undeformed foil.
    points_per_element : int
        Grid cells that make one element, in both directions. One where every point is a
        measurement of its own; two recover an exported shape exactly.
    """

    points: np.ndarray
    points_per_element: int = 1


def read_grid(path: str | Path, columns: int | None = None) -> SurfaceGrid:
    """Read a grid from a NumPy archive (``.npz``) or an unstructured VTK file (``.vtu``).

    Parameters
    ----------
    path : str or Path
        The archive holds ``points`` of shape (rows, columns, 3), and ``points_per_element`` if
        that is not 1. Points of a VTK file are taken in their order, row by row.
    columns : int, optional
        Points per row of a VTK file, needed where the file has no point data ``column``.

    Raises
    ------
    ValueError
        If the file holds no such grid.
    """
    path = Path(path)
    readers = {".npz": _read_archive, ".vtu": _read_vtk}
    ending = path.suffix.lower()
    if ending not in readers:
        raise ValueError(
            f"{path}: a surface is read from {' or '.join(readers)}, not from "
            f"{path.suffix or 'a file without ending'}; convert it."
        )
    if not path.is_file():
        raise ValueError(f"{path}: there is no such file; check the path.")
    return readers[ending](path, columns)


def _read_archive(path: Path, _) -> SurfaceGrid:
    wanted = {"points", "points_per_element"}
    try:
        with zipfile.ZipFile(path) as archive:
            names = [name.removesuffix(".npy") for name in archive.namelist()]
            sizes = [_declared(archive, f"{name}.npy") for name in wanted.intersection(names)]
        if max(sizes, default=0) <= 3 * POINTS_MAX:
            with np.load(path) as archive:
                content = {name: archive[name] for name in wanted.intersection(archive.files)}
    except Exception as error:  # zipfile and NumPy raise whatever they stumble upon
        raise ValueError(f"{path}: cannot be read as a NumPy archive ({error}).") from None
    if max(sizes, default=0) > 3 * POINTS_MAX:
        raise ValueError(_too_many(path, max(sizes) // 3))
    if "points" not in content:
        raise ValueError(
            f"{path}: has no array 'points' but {', '.join(names) or 'nothing'}; save the grid "
            "as points, shape (rows, columns, 3)."
        )
    per_element = np.asarray(content.get("points_per_element", 1))
    if per_element.size != 1 or not np.issubdtype(per_element.dtype, np.integer):
        raise ValueError(f"{path}: its points_per_element is no whole number; save 1 or 2.")
    return SurfaceGrid(content["points"], int(per_element.item()))


def _declared(archive: zipfile.ZipFile, name: str) -> int:
    """How many numbers an array says that it has, without making room for them."""
    with archive.open(name) as file:
        version = np.lib.format.read_magic(file)
        headers = {(1, 0): np.lib.format.read_array_header_1_0}
        read = headers.get(version, np.lib.format.read_array_header_2_0)
        return math.prod(read(file)[0])


def _too_many(path: Path, count: int) -> str:
    return (
        f"{path}: says that it has {count} points, where at most {POINTS_MAX} are read; leave out "
        "rows and columns evenly."
    )


def _read_vtk(path: Path, columns: int | None) -> SurfaceGrid:
    import meshio  # heavy, and not needed for arrays

    with path.open("rb") as file:
        head = file.read(_HEAD)
    if b"vtkLZ4DataCompressor" in head:
        raise ValueError(
            f"{path}: is compressed by LZ4, which is not read; save it with ZLib or uncompressed."
        )
    declared = re.search(rb'NumberOfPoints="(\d{1,20})"', head)
    if declared and int(declared[1]) > POINTS_MAX:
        raise ValueError(_too_many(path, int(declared[1])))
    try:
        mesh = meshio.read(path, file_format="vtu")
    except (Exception, SystemExit) as error:  # meshio ends the process on some broken files
        raise ValueError(f"{path}: cannot be read as a VTK file ({error}).") from None
    if "column" in mesh.point_data:
        recorded = np.asarray(mesh.point_data["column"]).ravel()
        columns = int(recorded.max()) + 1
        if not np.array_equal(recorded, np.arange(len(recorded)) % columns):
            raise ValueError(
                f"{path}: its points are not in the order of its point data 'column'; sort them "
                "row by row."
            )
    if columns is None:
        raise ValueError(
            f"{path}: has no point data 'column' that says how long a row is; give columns=, the "
            "number of points per row."
        )
    count = len(mesh.points)
    if columns < 1 or count % columns:
        raise ValueError(
            f"{path}: {count} points do not make rows of {columns}; check columns=, or remove "
            "points that are not part of the grid."
        )
    biquadratic = any(block.type == "quad9" for block in mesh.cells)
    return SurfaceGrid(mesh.points.reshape(-1, columns, 3), 2 if biquadratic else 1)
