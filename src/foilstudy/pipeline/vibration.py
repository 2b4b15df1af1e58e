"""Dynamic stiffness, eigenfrequencies and mode shapes of one crumple, as its study asks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.record import Quantity
from foilstudy.config import Dynamics
from foilstudy.linalg import factorise, lowest_modes, modes_below
from foilstudy.measure.dynamics import (
    CraigBampton,
    Damping,
    Guyan,
    HintzHerting,
    ModalDamping,
    RationalKrylov,
    RayleighDamping,
    ReducedModel,
    StructuralDamping,
    Structure,
    Wanted,
    dynamic_stiffness,
    eigenfrequency_errors,
    frequency_grid,
)
from foilstudy.measure.dynamics.reductions.by_need import with_enough_modes
from foilstudy.model.patch import RING_ROWS, Patch, knot_points

_MODAL = {"craig_bampton": CraigBampton, "hintz_herting": HintzHerting}


def damping_of(options: Dynamics) -> Damping:
    """Damping model of a configuration."""
    ratio = options.damping_percent / 100
    if options.damping == "structural":
        return StructuralDamping(2 * ratio)
    if options.damping == "rayleigh":
        return RayleighDamping.between(ratio, *options.rayleigh_hz)
    return ModalDamping(ratio)


def reduced(options: Dynamics, structure: Structure) -> ReducedModel:
    """Reduced model of a structure, with its error estimate for the shown band.

    Raises
    ------
    SolveError
        If a factorisation or a mode search fails.
    """
    wanted = Wanted(
        options.tolerance, options.shown_min_hz, options.shown_max_hz, damping_of(options)
    )
    if options.reduction == "rational_krylov":
        return RationalKrylov(wanted).reduce(structure)
    if options.reduction == "guyan":
        return Guyan(wanted).reduce(structure)
    kind = _MODAL[options.reduction]
    if options.cutoff_hz is None:
        return with_enough_modes(structure, kind, wanted)
    return kind(options.cutoff_hz, wanted).reduce(structure)


def dynamic_quantities(
    options: Dynamics, structure: Structure, patch: Patch
) -> dict[str, Quantity]:
    """Everything that depends on the frequency; NaN beyond where the reduced model is valid."""
    model = reduced(options, structure)
    grid = frequency_grid(options.shown_min_hz, options.shown_max_hz, options.frequencies)
    valid = grid <= model.valid_to_hz
    stiffness = np.full((3, 2, grid.size), np.nan + 0j)
    if valid.any():
        stiffness[..., valid] = dynamic_stiffness(model, grid[valid], damping_of(options))
    modes = _modes_of(options, model, structure)
    count = np.searchsorted(modes.all_hz, grid).astype(float)
    count[~valid] = np.nan
    dims = ("definition", "direction", "frequency")
    quantities = {
        "frequency": Quantity(grid, "Hz", "frequency", ("frequency",)),
        "dynamic_stiffness_re": Quantity(
            stiffness.real, "N/m", "real part of the dynamic stiffness", dims
        ),
        "dynamic_stiffness_im": Quantity(
            stiffness.imag, "N/m", "imaginary part of the dynamic stiffness", dims
        ),
        "reduced_coordinates": Quantity(
            float(model.size), "1", "coordinates of the reduced model, the ring motions included"
        ),
        "reduction_error": Quantity(
            model.error_estimate, "1", "estimated largest relative error of the reduction"
        ),
        "valid_to_frequency": Quantity(
            model.valid_to_hz, "Hz", "frequency up to which that meets the tolerance"
        ),
        "mode_count": Quantity(
            count, "1", "eigenfrequencies with clamped rings below a frequency", ("frequency",)
        ),
    }
    return quantities | _mode_quantities(options, modes, patch)


@dataclass(frozen=True)
class _Modes:
    """Modes with both rings held: all frequencies, and the first modes that are right; Hz."""

    all_hz: np.ndarray
    first_hz: np.ndarray
    shapes: np.ndarray


def _modes_of(options: Dynamics, model: ReducedModel, structure: Structure) -> _Modes:
    """From the reduced model; directly what it does not have or is not right about.

    The rings of a symmetric sheet do not move all its modes, as the inertia of the whole structure
    tells, and modes beyond the band need not be in the model.
    """
    kept = max(options.eigenfrequencies, options.mode_shapes)
    all_hz = model.clamped_eigenfrequencies()
    frequencies, shapes = model.clamped_modes(kept)
    limit = (2 * np.pi * min(model.valid_to_hz, options.shown_max_hz)) ** 2
    k, m = structure.stiffness.interior, structure.mass.interior
    count = factorise((k - limit * m).tocsr()).negative_eigenvalues
    if count != (all_hz < np.sqrt(limit) / (2 * np.pi)).sum():
        all_hz = np.sqrt(modes_below(k, m, limit).eigenvalues) / (2 * np.pi)
        frequencies = frequencies[:0]
    # a fifth, as the estimate may see too little
    if frequencies.size == kept:
        errors = eigenfrequency_errors(structure, frequencies, shapes)
        if (errors <= options.tolerance / 5).all():
            return _Modes(all_hz, frequencies, shapes)
    first = lowest_modes(k, m, structure.static.factor, kept)
    return _Modes(all_hz, np.sqrt(first.eigenvalues) / (2 * np.pi), first.shapes)


def _mode_quantities(options: Dynamics, modes: _Modes, patch: Patch) -> dict[str, Quantity]:
    eigenfrequencies = np.full(options.eigenfrequencies, np.nan)  # NaN where there are fewer
    known = modes.first_hz[: options.eigenfrequencies]
    eigenfrequencies[: known.size] = known
    quantities = {
        "eigenfrequency": Quantity(
            eigenfrequencies, "Hz", "eigenfrequencies with clamped rings", ("mode",)
        ),
        "first_eigenfrequency": Quantity(
            eigenfrequencies[0], "Hz", "first eigenfrequency with clamped rings"
        ),
    }
    shapes = modes.shapes[:, : options.mode_shapes]
    if shapes.shape[1]:
        quantities["mode_shape"] = Quantity(
            surface_modes(patch, shapes).astype(np.float32),
            "m/sqrt(kg m2)",
            "mass-normalised displacement of the surface at the knots, clamped rings",
            ("shape_mode", "component", "node_row", "node_column"),
        )
    return quantities


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
