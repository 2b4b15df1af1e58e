"""The air about any open surface: panels of constant potential jump (vortex rings).

The normal velocity in the middle of each panel by the jumps on all of them is the law of Biot and
Savart along their edges: J. Katz and A. Plotkin, Low-Speed Aerodynamics, 2nd ed., Cambridge (2001).
"""

from __future__ import annotations

import numpy as np
import scipy.linalg

from foilstudy.linalg import SolveError
from foilstudy.measure.air.waves import Waves

_CHUNK = 64
"""Panels at whose middle the velocity is found at once."""


def influence(corners: np.ndarray) -> np.ndarray:
    """Normal velocity in the middle of panels per potential jump, 1/m, shape (panels, panels).

    Parameters
    ----------
    corners : ndarray, shape (panels, 4, 3)
        In turn, counterclockwise seen from the side to which the normals point; m.
    """
    middle = corners.mean(axis=1)
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    out = np.empty((len(corners), len(corners)))
    for start in range(0, len(corners), _CHUNK):
        rows = slice(start, start + _CHUNK)
        arms = corners[None] - middle[rows, None, None]
        lengths = np.linalg.norm(arms, axis=-1)
        other, other_lengths = np.roll(arms, -1, axis=2), np.roll(lengths, -1, axis=2)
        both = lengths * other_lengths
        swirl = np.einsum("ijsk,ik->ijs", np.cross(arms, other), normal[rows])
        along = np.einsum("ijsk,ijsk->ijs", arms, other)
        out[rows] = (swirl * (lengths + other_lengths) / (both * (both + along))).sum(axis=2)
    return out / (4 * np.pi)


def panel_thickness(waves: Waves, knots: np.ndarray) -> np.ndarray:
    """Thickness of air on both sides between waves of the surface itself, (r, r), m.

    A lattice of panels takes the slope of a wave for less by the mean of the wave over an element;
    that is taken back. Both ends are open.

    Parameters
    ----------
    waves : Waves
    knots : ndarray, shape (3, along + 1, around)
        Corners of the elements, m.

    Raises
    ------
    SolveError
        If the surface lies so close to itself that the panels have no positive mass.
    """
    place = np.moveaxis(np.concatenate([knots, knots[:, :, :1]], axis=2), 0, 2)
    # a knot lies half an element before the control point of its number, an element after its knot
    corners = np.stack([place[:-1, :-1], place[:-1, 1:], place[1:, 1:], place[1:, :-1]], axis=2)
    shapes = waves.shapes
    jump = scipy.linalg.solve(influence(corners.reshape(-1, 4, 3)), shapes, overwrite_a=True)
    area = waves.wall.area / len(shapes)
    thickness = area * (shapes.T @ jump)
    thickness = 0.5 * (thickness + thickness.T) / np.sqrt(np.outer(waves.mean, waves.mean))
    if not np.linalg.eigvalsh(thickness)[0] > 0:
        raise SolveError(
            "the air about the surface has no positive mass: parts of the foil are too near to "
            "each other for its panels; use air.kind: added_mass."
        )
    return thickness
