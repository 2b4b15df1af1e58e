"""Static stiffness of one shape, on its mesh and on finer ones."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.measure.stiffness import mesh_limit, transfer_stiffness
from foilstudy.model.shell.elements.sampled import STAGGERED
from foilstudy.pipeline.shape import Shape


@dataclass(frozen=True, eq=False)
class MeshLimit:
    """Stiffness of a shape at element size zero.

    Attributes
    ----------
    stiffness, error : ndarray, shape (2,)
        Axial and radial, and their estimated errors, N/m; NaN where nothing was refined.
    levels : tuple of ndarray
        On the meshes, from coarse to fine.
    """

    stiffness: np.ndarray
    error: np.ndarray
    levels: tuple[np.ndarray, ...]

    def __repr__(self) -> str:
        parts = (f"{v:.4g} ± {e:.2g}" for v, e in zip(self.stiffness, self.error, strict=True))
        return f"<MeshLimit: axial, radial {', '.join(parts)} N/m on {len(self.levels)} meshes>"


def stress_free_stiffness(shape: Shape) -> np.ndarray:
    """Axial and radial stiffness of a shape taken as stress-free, other motions held, N/m.

    Raises
    ------
    SolveError
        If it is singular.
    """
    return transfer_stiffness(shape.relieved())


def mesh_limit_of(shape: Shape, refinements: int, coarsest: np.ndarray | None = None) -> MeshLimit:
    """Refine the same shape, measure it on every mesh, and extrapolate.

    Parameters
    ----------
    shape : Shape
    refinements : int
        How often the elements are halved.
    coarsest : ndarray, shape (2,), optional
        Its own stiffness, where that is known already, N/m.

    Raises
    ------
    SolveError
        If a stiffness is singular.
    """
    levels = [stress_free_stiffness(shape) if coarsest is None else coarsest]
    fine, staggered = shape, np.full(2, np.nan)
    for level in range(refinements):
        fine = fine.refined()
        levels.append(stress_free_stiffness(fine))
        if level == 0:
            staggered = stress_free_stiffness(replace(fine, element=STAGGERED))
    if len(levels) == 1:
        return MeshLimit(np.full(2, np.nan), np.full(2, np.nan), tuple(levels))
    return MeshLimit(*mesh_limit(levels, staggered), tuple(levels))
