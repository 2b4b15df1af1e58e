"""Interface stiffness of a sheet between its two rigid rings."""

from foilstudy.measure.stiffness.condensation import InterfaceSystem, StaticCondensation, condense
from foilstudy.measure.stiffness.directional import fixed_stiffness, free_stiffness
from foilstudy.measure.stiffness.mesh_error import limit_by_need, mesh_limit
from foilstudy.measure.stiffness.prestressed import prestressed_stiffness
from foilstudy.measure.stiffness.rings import DOF_NAMES, Rings
from foilstudy.measure.stiffness.transfer import transfer_stiffness

__all__ = [
    "DOF_NAMES",
    "InterfaceSystem",
    "Rings",
    "StaticCondensation",
    "condense",
    "fixed_stiffness",
    "free_stiffness",
    "limit_by_need",
    "mesh_limit",
    "prestressed_stiffness",
    "transfer_stiffness",
]
