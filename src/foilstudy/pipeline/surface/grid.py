"""A grid of surface points from a file or an array."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np


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
    if path.suffix not in readers:
        raise ValueError(
            f"{path}: a surface is read from {' or '.join(readers)}, not from "
            f"{path.suffix or 'a file without ending'}; convert it."
        )
    if not path.is_file():
        raise ValueError(f"{path}: there is no such file; check the path.")
    return readers[path.suffix](path, columns)


def _read_archive(path: Path, _) -> SurfaceGrid:
    try:
        with np.load(path) as archive:
            content = {name: archive[name] for name in archive.files}
    except Exception as error:  # zipfile and NumPy raise whatever they stumble upon
        raise ValueError(f"{path}: cannot be read as a NumPy archive ({error}).") from None
    if "points" not in content:
        raise ValueError(
            f"{path}: has no array 'points' but {', '.join(content) or 'nothing'}; save the grid "
            "as points, shape (rows, columns, 3)."
        )
    return SurfaceGrid(content["points"], int(content.get("points_per_element", 1)))


def _read_vtk(path: Path, columns: int | None) -> SurfaceGrid:
    import meshio  # heavy, and not needed for arrays

    try:
        mesh = meshio.read(path)
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
