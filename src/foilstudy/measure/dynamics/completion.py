"""Modes near the end of a band that a reduced model lacks."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh, eigvalsh

from foilstudy.linalg import BlockKrylov, Factorisation, projected
from foilstudy.measure.dynamics.reduction import ReducedModel
from foilstudy.measure.dynamics.structure import INTERFACE, Structure

_BLOCKS_MAX, _IDLE_MAX = 12, 3
"""Blocks that are added, and those in a row that bring no mode."""
_ORTHONORMAL = 1e-8
_MOVED = 1e-3
"""By how much, relatively, the last block may move an eigenfrequency below the limit."""


def completed_modes(
    structure: Structure, model: ReducedModel, inverse: Factorisation, limit: float, kept: int
) -> tuple[np.ndarray, np.ndarray] | None:
    """Modes with both rings held, none below a limit missing.

    A model may be right about the dynamic stiffness before it has every mode, most of all near the
    end of its band. Moments of the ring motions at the limit bring those; their number is known.

    Parameters
    ----------
    structure : Structure
    model : ReducedModel
        Of that structure.
    inverse : Factorisation
        Of K - limit M of the interior.
    limit : float
        rad2/s2.
    kept : int
        Shapes wanted.

    Returns
    -------
    frequencies : ndarray
        All of the model and the moments, ascending, Hz.
    shapes : ndarray, shape (interior, kept)
        Mass-normalised displacements, m/sqrt(kg m2).
        None instead of both where the rings do not move what is missing, or the basis of the model
        is not orthonormal in the mass.
    """
    inner = slice(INTERFACE, None)
    gram, stiffness = model.mass[inner, inner], model.stiffness[inner, inner]
    if not np.allclose(gram, np.eye(len(gram)), rtol=0, atol=_ORTHONORMAL):
        return None
    k, m = structure.stiffness.interior, structure.mass.interior
    space = BlockKrylov(m, model.basis)
    load = m @ structure.static.constraint_modes + structure.mass.coupling
    missing, idle, values = np.inf, 0, np.empty(0)
    for _ in range(_BLOCKS_MAX):
        load = space.append(inverse, load)
        if not load.shape[1]:
            return None
        stiffness = projected(k, space.vectors, stiffness)
        before, missing, last = missing, inverse.negative_eigenvalues, values
        values = eigvalsh(stiffness)
        values = values[values < limit]
        missing -= values.size
        # that there are enough does not say that each is where it belongs
        if not missing and last.size == values.size and np.all(last <= values * (1 + 2 * _MOVED)):
            values, vectors = eigh(stiffness)
            frequencies = np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi)
            return frequencies, space.vectors @ vectors[:, :kept]
        idle = 0 if missing < before or not missing else idle + 1
        if idle == _IDLE_MAX:
            return None
    return None
