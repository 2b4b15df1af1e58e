"""Dynamic stiffness, eigenfrequencies and mode shapes of one structure."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import lowest_modes, modes_below, shifted
from foilstudy.measure.dynamics import (
    DynamicsOptions,
    ReducedModel,
    Structure,
    completed_modes,
    dynamic_stiffness,
    eigenfrequency_errors,
)
from foilstudy.model.patch import RING_ROWS, Patch, knot_points


@dataclass(frozen=True, eq=False)
class Vibration:
    """Dynamics of a structure in a band.

    Attributes
    ----------
    frequencies : ndarray, shape (frequencies,)
        Hz.
    dynamic_stiffness : ndarray of complex, shape (3 definitions, 2 directions, frequencies)
        N/m; NaN beyond where the reduced model is valid.
    mode_count : ndarray, shape (frequencies,)
        Eigenfrequencies with held rings below each frequency; NaN likewise.
    eigenfrequencies : ndarray, shape (wanted,)
        With held rings, Hz; NaN where there are fewer.
    mode_shapes : ndarray, shape (interior unknowns, wanted)
        Mass-normalised, m/sqrt(kg m2); fewer columns where there are fewer.
    model : ReducedModel
    """

    frequencies: np.ndarray
    dynamic_stiffness: np.ndarray
    mode_count: np.ndarray
    eigenfrequencies: np.ndarray
    mode_shapes: np.ndarray
    model: ReducedModel

    def __repr__(self) -> str:
        return (
            f"<Vibration: {self.frequencies[0]:g} to {self.frequencies[-1]:g} Hz, first "
            f"eigenfrequency {self.eigenfrequencies[0]:.4g} Hz, {self.model.size} coordinates, "
            f"estimated error {self.model.error_estimate:.1e}>"
        )


def vibration_of(structure: Structure, options: DynamicsOptions) -> Vibration:
    """Reduce a structure and evaluate it in its band.

    Raises
    ------
    SolveError
        If a factorisation, the reduction or a mode search fails.
    """
    model, grid = options.reduced(structure), options.grid
    valid = grid <= model.valid_to_hz
    stiffness = np.full((3, 2, grid.size), np.nan + 0j)
    if valid.any():
        stiffness[..., valid] = dynamic_stiffness(model, grid[valid], options.damping)
    modes = _modes_of(options, model, structure)
    count = np.searchsorted(modes.all_hz, grid).astype(float)
    count[~valid] = np.nan
    eigenfrequencies = np.full(options.eigenfrequencies, np.nan)
    known = modes.first_hz[: options.eigenfrequencies]
    eigenfrequencies[: known.size] = known
    shapes = modes.shapes[:, : options.mode_shapes]
    return Vibration(grid, stiffness, count, eigenfrequencies, shapes, model)


@dataclass(frozen=True)
class _Modes:
    """Modes with both rings held: all frequencies, and the first modes that are right; Hz."""

    all_hz: np.ndarray
    first_hz: np.ndarray
    shapes: np.ndarray


def _modes_of(options: DynamicsOptions, model: ReducedModel, structure: Structure) -> _Modes:
    """From the reduced model; directly what it does not have or is not right about.

    The inertia of the whole structure tells how many there are. A model may not have those near the
    end of its band; the rings of a symmetric sheet do not move all its modes; and modes beyond the
    band need not be in the model.
    """
    kept = max(options.eigenfrequencies, options.mode_shapes)
    all_hz = model.clamped_eigenfrequencies()
    frequencies, shapes = model.clamped_modes(kept)
    limit = (2 * np.pi * min(model.valid_to_hz, options.highest_hz)) ** 2
    k, m = structure.stiffness.interior, structure.mass.interior
    factor, limit = shifted(k, m, limit)
    if factor.negative_eigenvalues != (all_hz < np.sqrt(limit) / (2 * np.pi)).sum():
        completed = completed_modes(structure, model, factor, limit, kept)
        if completed is not None:
            all_hz, shapes = completed
            frequencies = all_hz[:kept]
        else:
            all_hz = np.sqrt(modes_below(k, m, limit).eigenvalues) / (2 * np.pi)
            frequencies = frequencies[:0]
    del factor
    # a fifth, as the estimate may see too little
    if frequencies.size == kept:
        errors = eigenfrequency_errors(structure, frequencies, shapes)
        if (errors <= options.tolerance / 5).all():
            return _Modes(all_hz, frequencies, shapes)
    first = lowest_modes(k, m, structure.static.factor, kept)
    return _Modes(all_hz, np.sqrt(first.eigenvalues) / (2 * np.pi), first.shapes)


def surface_modes(patch: Patch, shapes: np.ndarray) -> np.ndarray:
    """Displacement of the surface at the knots, the rings at rest.

    Parameters
    ----------
    patch : Patch
    shapes : ndarray, shape (interior unknowns, modes)

    Returns
    -------
    ndarray, shape (modes, 3, rows - 1, knots around)
    """
    modes = shapes.shape[1]
    control = np.zeros((modes, *patch.shape))
    rows = patch.rows - 2 * RING_ROWS
    inner = shapes.T.reshape(modes, rows, patch.columns, 3)
    control[:, :, RING_ROWS:-RING_ROWS] = inner.transpose(0, 3, 1, 2)
    return np.array([knot_points(each) for each in control])
