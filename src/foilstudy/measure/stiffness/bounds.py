"""How stiff a foil between two rings can be at most.

Between the rings any displacement that follows them costs at least the energy of the true one
(theorem of minimum potential energy). The field here is a share of the ring's motion that grows
with the height alone.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.measure.stiffness.directional import by_direction
from foilstudy.model.foil import Foil
from foilstudy.model.patch import RING_ROWS


def bound_of_shape(tangent: sparse.csr_matrix, points: np.ndarray) -> np.ndarray:
    """What the stiffness of a shape cannot exceed, other motions held.

    Parameters
    ----------
    tangent : sparse matrix
        Of the foil without stress in this shape.
    points : ndarray, shape (3, rows, columns)
        Control points, m.

    Returns
    -------
    ndarray, shape (2,)
        Axial and radial, N/m.
    """
    height = points[2]
    bottom, top = height[:RING_ROWS].max(), height[-RING_ROWS:].min()
    share = np.clip((height - bottom) / (top - bottom), 0.0, 1.0)
    fields = np.kron(share.reshape(-1, 1), np.eye(3))  # a point's three unknowns are neighbours
    return by_direction(np.einsum("ij,ij->j", fields, tangent @ fields))


def bound_of_any_shape(foil: Foil) -> np.ndarray:
    """The same for whatever shape a foil may have, by its membrane; bending adds little.

    With C = E / (1 - nu^2) a strain of the height resists by C t at most where the foil stands
    upright. Sheared along x and, as radial stiffness is a mean, y, a foil with the normal n resists
    by C t (1 - s) ((1 - nu) / 2 + s), s = n_z^2; that is C t ((3 - nu) / 4)^2 at most, for
    s = (1 + nu) / 4.

    Returns
    -------
    ndarray, shape (2,)
        Axial and radial, N/m.
    """
    material = foil.material
    modulus = material.youngs_modulus / (1 - material.poisson_ratio**2)
    area = np.pi * foil.diameter * foil.reference_height
    scale = modulus * foil.thickness * area / foil.gap_height**2
    return scale * np.array([1.0, ((3 - material.poisson_ratio) / 4) ** 2 / 2])
