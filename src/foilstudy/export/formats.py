"""Every export format by its name; reading the list loads no library."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.registry import Choice, Registry


@dataclass(frozen=True)
class Format(Choice):
    """A file that other tools read: its writer's place, what it holds and what opens it.

    Attributes
    ----------
    filename : str
        Within the folder of an export.
    """

    filename: str


FORMATS = Registry(
    "export format",
    {
        "nc": Format(
            "export.netcdf:write",
            "reduced model K, M, C and interface map: NetCDF",
            "reduced.nc",
        ),
        "mat": Format(
            "export.matlab:write",
            "reduced model M, C, K, B and state space sys: MATLAB",
            "reduced.mat",
        ),
        "uff": Format(
            "export.universal:write",
            "dynamic stiffness of all pairs of ring motions: Universal File, dataset 58",
            "frequency_response.uff",
        ),
        "csv": Format(
            "export.table:write",
            "dynamic stiffness by definition and direction: any spreadsheet",
            "frequency_response.csv",
        ),
        "vtu": Format(
            "export.vtk:write",
            "crumpled shape with strains, energies and mode shapes: ParaView; read back by "
            "foilstudy.pipeline.surface",
            "shape.vtu",
        ),
        "npz": Format(
            "export.vtk:write_points",
            "grid of surface points: NumPy; read back by foilstudy.pipeline.surface",
            "shape.npz",
        ),
        "inp": Format(
            "export.calculix:write",
            "shell model with static and frequency steps: CalculiX",
            "calculix.inp",
        ),
    },
)
"""Functions ``write(contents, path)``."""
