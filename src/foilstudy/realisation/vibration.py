"""Dynamic stiffness, eigenfrequencies and mode shapes of one crumple, as its study asks."""

from __future__ import annotations

import numpy as np

from foilstudy.config import Dynamics
from foilstudy.dynamics import (
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
from foilstudy.dynamics.reductions.by_need import with_enough_modes
from foilstudy.patch import RING_ROWS, Patch, knot_points
from foilstudy.realisation.record import Quantity

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
    stiffness = dynamic_stiffness(model, grid, damping_of(options))
    stiffness[..., grid > model.valid_to_hz] = np.nan
    dims = ("definition", "direction", "frequency")
    return {
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
    } | _modes(options, model, structure, patch)


def _modes(
    options: Dynamics, model: ReducedModel, structure: Structure, patch: Patch
) -> dict[str, Quantity]:
    """Modes with both rings held, as far as the model has them; the others are NaN."""
    grid = frequency_grid(options.shown_min_hz, options.shown_max_hz, options.frequencies)
    count = np.searchsorted(model.clamped_eigenfrequencies(), grid).astype(float)
    count[grid > model.valid_to_hz] = np.nan
    frequencies, shapes = model.clamped_modes(max(options.eigenfrequencies, options.mode_shapes))
    wrong = eigenfrequency_errors(structure, frequencies, shapes) > options.tolerance
    valid = int(wrong.argmax()) if wrong.any() else frequencies.size
    eigenfrequencies = np.full(options.eigenfrequencies, np.nan)
    known = min(valid, options.eigenfrequencies)
    eigenfrequencies[:known] = frequencies[:known]
    quantities = {
        "eigenfrequency": Quantity(
            eigenfrequencies, "Hz", "eigenfrequencies with clamped rings", ("mode",)
        ),
        "first_eigenfrequency": Quantity(
            eigenfrequencies[0], "Hz", "first eigenfrequency with clamped rings"
        ),
        "mode_count": Quantity(
            count, "1", "eigenfrequencies with clamped rings below a frequency", ("frequency",)
        ),
    }
    shown = min(options.mode_shapes, valid)
    if shown:
        quantities["mode_shape"] = Quantity(
            surface_modes(patch, shapes[:, :shown]).astype(np.float32),
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
