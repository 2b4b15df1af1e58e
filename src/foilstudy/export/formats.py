"""Every export format by its name; reading the list loads no library."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Format:
    """A file that other tools read.

    Attributes
    ----------
    filename : str
        Within the folder of an export.
    content : str
        What it holds and what opens it.
    module, function : str
        Of this package, ``function(contents, path)``; loaded on use, as each brings its library.
    """

    filename: str
    content: str
    module: str
    function: str = "write"

    def writer(self) -> Callable[[Any, Path], None]:
        """The function that writes the file."""
        return getattr(import_module(f"foilstudy.export.{self.module}"), self.function)


FORMATS: dict[str, Format] = {
    "nc": Format("reduced.nc", "reduced model K, M, C and interface map: NetCDF", "netcdf"),
    "mat": Format("reduced.mat", "reduced model M, C, K, B and state space sys: MATLAB", "matlab"),
    "uff": Format(
        "frequency_response.uff",
        "dynamic stiffness of all pairs of ring motions: Universal File, dataset 58",
        "universal",
    ),
    "csv": Format(
        "frequency_response.csv",
        "dynamic stiffness by definition and direction: any spreadsheet",
        "table",
    ),
    "vtu": Format(
        "shape.vtu",
        "crumpled shape with strains, energies and mode shapes: ParaView; read back by "
        "foilstudy.pipeline.surface",
        "vtk",
    ),
    "npz": Format(
        "shape.npz",
        "grid of surface points: NumPy; read back by foilstudy.pipeline.surface",
        "vtk",
        "write_points",
    ),
    "inp": Format(
        "calculix.inp", "shell model with static and frequency steps: CalculiX", "calculix"
    ),
}


def check_format(name: str) -> None:
    """Refuse an unknown format.

    Raises
    ------
    ValueError
        Naming the known ones.
    """
    if name not in FORMATS:
        known = ", ".join(FORMATS)
        raise ValueError(f"{name!r} is not an export format; use one of {known}.")
