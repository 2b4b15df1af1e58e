"""Interface stiffness of a sheet between its two rigid rings."""

from foilstudy.stiffness.condensation import InterfaceSystem, StaticCondensation, condense
from foilstudy.stiffness.directional import fixed_stiffness, free_stiffness
from foilstudy.stiffness.mesh_error import mesh_limit
from foilstudy.stiffness.prestressed import prestressed_stiffness
from foilstudy.stiffness.rings import DOF_NAMES, Rings

__all__ = [
    "DOF_NAMES",
    "InterfaceSystem",
    "Rings",
    "StaticCondensation",
    "condense",
    "fixed_stiffness",
    "free_stiffness",
    "mesh_limit",
    "prestressed_stiffness",
]
