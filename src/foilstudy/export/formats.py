"""Every export format by its name; reading the list loads no library."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

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


@dataclass(frozen=True)
class MotionFormat(Format):
    """Receptance or accelerance under one condition, which its writer takes besides."""

    quantity: str
    condition: str

    def load(self) -> Callable:
        """The writer for this quantity and condition."""
        return partial(super().load(), quantity=self.quantity, condition=self.condition)


_QUANTITIES = {"receptance": "displacement per force", "accelerance": "acceleration per force"}
_CONDITIONS = {"free": "both rings free", "bottom_held": "bottom ring held"}
_KINDS = {
    "uff": ("export.universal:write_motion", "Universal File for modal software"),
    "csv": ("export.table:write_motion", "any spreadsheet"),
}
_MOTIONS = {
    f"{kind}_{quantity}_{condition}": MotionFormat(
        place,
        f"{words}, {held}: {opens}",
        f"{quantity}_{condition}.{kind}",
        quantity,
        condition,
    )
    for kind, (place, opens) in _KINDS.items()
    for quantity, words in _QUANTITIES.items()
    for condition, held in _CONDITIONS.items()
}

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
        **_MOTIONS,
        "mat_motion": Format(
            "export.matlab:write_motion",
            "receptance and accelerance, both rings free and bottom ring held: MATLAB",
            "motion_per_force.mat",
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
        "abaqus": Format(
            "export.abaqus:write",
            "reduced model as a superelement with damping: Abaqus, matrix input",
            "superelement_abaqus.inp",
        ),
        "ccx": Format(
            "export.calculix_superelement:write",
            "reduced model as a superelement with damping: CalculiX",
            "superelement.inp",
        ),
    },
)
"""Functions ``write(contents, path)``."""
