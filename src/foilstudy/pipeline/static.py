"""Static stiffness of one shape, on its mesh and on finer ones."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from foilstudy.measure.stiffness import (
    InterfaceSystem,
    Rings,
    condense,
    fixed_stiffness,
    limit_by_need,
    mesh_limit,
    transfer_stiffness,
)
from foilstudy.measure.stiffness.stress_removal import Residual
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
    met : bool or None
        Whether the demanded error was met; None where none was demanded.
    """

    stiffness: np.ndarray
    error: np.ndarray
    levels: tuple[np.ndarray, ...]
    met: bool | None = None

    def __repr__(self) -> str:
        parts = (f"{v:.4g} ± {e:.2g}" for v, e in zip(self.stiffness, self.error, strict=True))
        unmet = "" if self.met in (True, None) else ", not as exact as demanded"
        meshes = f"{len(self.levels)} meshes{unmet}"
        return f"<MeshLimit: axial, radial {', '.join(parts)} N/m on {meshes}>"

    @property
    def refinements(self) -> int:
        """How often the shape was refined."""
        return len(self.levels) - 1


def stress_free_stiffness(shape: Shape) -> np.ndarray:
    """Axial and radial stiffness of a shape taken as stress-free, other motions held, N/m.

    Raises
    ------
    SolveError
        If it is singular.
    """
    relieved = shape.relieved()
    if not isinstance(relieved, Residual):
        return transfer_stiffness(relieved)
    # what stress is left may make the stiffness indefinite, and the blocks of a definite one fail
    system = InterfaceSystem.split(relieved.tangent(), Rings.of(shape.patch, shape.points))
    return fixed_stiffness(condense(system).stiffness)


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
            staggered = _staggered(fine)
    if len(levels) == 1:
        return MeshLimit(np.full(2, np.nan), np.full(2, np.nan), tuple(levels))
    return MeshLimit(*mesh_limit(levels, staggered), tuple(levels))


def mesh_limit_within(
    shape: Shape, error: float, most: int, coarsest: np.ndarray | None = None
) -> MeshLimit:
    """Refine the same shape until its stated error is small enough, and no further.

    The second element is asked on the second mesh, before a third one is made.

    Parameters
    ----------
    shape : Shape
    error : float
        Largest stated error of both directions, a share of the value.
    most : int
        How often the elements are halved at most.
    coarsest
        As in `mesh_limit_of`.

    Raises
    ------
    SolveError
        If a stiffness is singular.
    """
    foil, patch = shape.foil, shape.patch
    size = max(patch.size_around, patch.size_along)
    slenderness = size / np.sqrt(foil.diameter / 2 * foil.thickness)
    levels = [stress_free_stiffness(shape) if coarsest is None else coarsest]
    fine, staggered = shape, None
    limit, stated = limit_by_need(levels, staggered, slenderness)
    while stated > error and len(levels) <= most:
        fine = fine.refined()
        levels.append(stress_free_stiffness(fine))
        if staggered is None:
            staggered = _staggered(fine)
        limit, stated = limit_by_need(levels, staggered, slenderness)
    return MeshLimit(limit, stated * np.abs(limit), tuple(levels), stated <= error)


def _staggered(shape: Shape) -> np.ndarray:
    return stress_free_stiffness(replace(shape, element=STAGGERED))
