"""The reduced model as NetCDF."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray

from foilstudy.export.contents import Contents
from foilstudy.measure.dynamics.damping_matrix import damping_matrix
from foilstudy.measure.stiffness import DOF_NAMES

_PAIR = ("coordinate", "coordinate_in")


def write(contents: Contents, path: Path) -> None:
    """Write K, M, C and the interface map.

    Raises
    ------
    Refusal
        If the damping is not viscous.
    """
    model = contents.model
    note = "the first twelve coordinates are the ring motions, in N/m, N and N m"
    variables = {
        "stiffness": (_PAIR, model.stiffness, "N/m", f"reduced stiffness K; {note}"),
        "mass": (_PAIR, model.mass, "kg", "reduced mass M; rotations in kg m and kg m2"),
        "damping": (
            _PAIR,
            damping_matrix(model, contents.damping),
            "N s/m",
            "reduced viscous damping C; rotations in N s and N m s",
        ),
        "interface_map": (
            ("interface_dof", "coordinate"),
            model.interface_map,
            "1",
            "ring motions from the coordinates: translations in m, rotations in rad",
        ),
    }
    dataset = xarray.Dataset(
        {
            name: (dims, values, {"units": units, "long_name": text})
            for name, (dims, values, units, text) in variables.items()
        },
        coords={"interface_dof": ("interface_dof", list(DOF_NAMES))},
        attrs={
            **contents.provenance,
            "title": "Reduced model of a crumpled foil between two rigid rings",
            "equation": "M q'' + C q' + K q = B f, y = B^T q, B the transpose of interface_map",
            "ring_centre_heights_m": np.array(contents.ring_heights),
            "damping_model": str(contents.damping),
            "reduction": model.method,
            "error_estimate": model.error_estimate,
            "valid_to_hz": model.valid_to_hz,
            "rigid_modes": model.rigid_modes,
        },
    )
    dataset.interface_dof.attrs["long_name"] = "ring motion, about the centre of its ring"
    packed = {"zlib": True, "shuffle": True}
    dataset.to_netcdf(path, engine="netcdf4", encoding={name: packed for name in variables})
