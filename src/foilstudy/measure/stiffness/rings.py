"""The two end rings as rigid bodies with six motions each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.model.patch import RING_ROWS, Patch

DOF_NAMES = tuple(
    f"{ring}_{motion}"
    for ring in ("bottom", "top")
    for motion in ("ux", "uy", "uz", "rx", "ry", "rz")
)
"""The twelve interface motions: translations (m) and rotations (rad) about the ring centres."""


@dataclass(frozen=True)
class Rings:
    """Rigid-body maps of the ring rows.

    Attributes
    ----------
    interior, boundary : ndarray of int
        Degrees of freedom of the free and of the ring-owned control points.
    motion : ndarray, shape (boundary size, 12)
        Displacement of the boundary per interface motion.
    """

    interior: np.ndarray
    boundary: np.ndarray
    motion: np.ndarray

    def __repr__(self) -> str:
        return f"<Rings: own {self.boundary.size} unknowns, {self.interior.size} are free>"

    @classmethod
    def of(cls, patch: Patch, points: np.ndarray) -> Rings:
        """Rings of a shape; a ring's centre lies on the axis of the patch at the edge's height."""
        per_row = 3 * patch.columns
        owned = RING_ROWS * per_row
        size = patch.rows * per_row
        bottom, top = np.arange(owned), np.arange(size - owned, size)
        motion = np.zeros((2 * owned, 12))
        for ring, rows in enumerate((slice(0, RING_ROWS), slice(-RING_ROWS, None))):
            position = points[:, rows].reshape(3, -1).T
            centre = np.array([0.0, 0.0, position[:, 2].mean()])
            block = motion[ring * owned : (ring + 1) * owned, 6 * ring : 6 * ring + 6]
            block[:] = rigid_motion(position - centre)
        return cls(np.arange(owned, size - owned), np.concatenate([bottom, top]), motion)


def rigid_motion(arms: np.ndarray) -> np.ndarray:
    """Displacements of points per rigid-body motion about the origin of their arms.

    Parameters
    ----------
    arms : ndarray, shape (points, 3)
        m.

    Returns
    -------
    ndarray, shape (3 * points, 6)
        u = translation + rotation x arm.
    """
    motion = np.zeros((len(arms), 3, 6))
    motion[:, [0, 1, 2], [0, 1, 2]] = 1.0
    x, y, z = arms.T
    motion[:, 0, 4], motion[:, 0, 5] = z, -y
    motion[:, 1, 3], motion[:, 1, 5] = -z, x
    motion[:, 2, 3], motion[:, 2, 4] = y, -x
    return motion.reshape(-1, 6)


def interface_rigid_modes(distance: float) -> np.ndarray:
    """The six rigid-body motions of both rings about the bottom ring's centre, shape (12, 6).

    Parameters
    ----------
    distance : float
        Height of the top ring's centre above the bottom one's, m.
    """
    modes = np.zeros((12, 6))
    modes[:6] = np.eye(6)
    modes[6:9] = rigid_motion(np.array([[0.0, 0.0, distance]]))
    modes[9:, 3:] = np.eye(3)
    return modes
