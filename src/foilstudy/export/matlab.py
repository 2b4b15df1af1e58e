"""For MATLAB: the reduced model, second-order and as a state space, and motion per force."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.io import savemat

from foilstudy.export.contents import Contents
from foilstudy.export.motions import QUANTITIES, moving
from foilstudy.measure.dynamics import CONDITIONS
from foilstudy.measure.dynamics.damping_matrix import damping_matrix, viscous_coefficients
from foilstudy.measure.dynamics.structure import INTERFACE


def write(contents: Contents, path: Path) -> None:
    """Write M, C, K and B of M q'' + C q' + K q = B f, y = B' q, and the same as ``sys``.

    Raises
    ------
    Refusal
        If the damping is not viscous.
    """
    model = contents.model
    values, _ = model.free_modes()
    content = {
        "M": model.mass,
        "C": damping_matrix(model, contents.damping),
        "K": model.stiffness,
        "B": model.interface_map.T,
        "sys": state_space(contents),
        "motion_names": _cells([motion.name for motion in moving("free")]),
        "motion_units": _cells([motion.unit for motion in moving("free")]),
        "force_units": _cells([motion.force_unit for motion in moving("free")]),
        "ring_centre_heights_m": np.array(contents.ring_heights),
        "free_eigenfrequencies_Hz": np.sqrt(np.maximum(values, 0.0)) / (2 * np.pi),
        "clamped_eigenfrequencies_Hz": contents.eigenfrequencies,
        "frequency_Hz": contents.frequencies,
        "dynamic_stiffness": np.moveaxis(contents.dynamic_stiffness, 0, 2),
        "damping_model": str(contents.damping),
        "reduction": model.method,
        "error_estimate": model.error_estimate,
        "valid_to_Hz": model.valid_to_hz,
        "provenance": dict(contents.provenance),
    }
    savemat(path, content, do_compression=True, oned_as="column")


def write_motion(contents: Contents, path: Path) -> None:
    """Write a structure for each condition, with receptance and accelerance (motion, force, f)."""
    grid = contents.even_grid
    content = {
        "frequency_Hz": grid.frequencies,
        "spacing_Hz": grid.spacing,
        "sharpest_resonance_Hz": grid.sharpest_hz,
        "least_half_power_width_Hz": grid.bandwidth_hz,
        "ring_centre_heights_m": np.array(contents.ring_heights),
        "damping_model": str(contents.damping),
        "provenance": dict(contents.provenance),
    }
    for condition in CONDITIONS:
        motions = moving(condition)
        content[condition] = {
            "motion_names": _cells([motion.name for motion in motions]),
            "motion_units": _cells([motion.unit for motion in motions]),
            "force_units": _cells([motion.force_unit for motion in motions]),
        } | {
            quantity: np.moveaxis(contents.motion_per_force(quantity, condition), 0, 2)
            for quantity in QUANTITIES
        }
    savemat(path, content, do_compression=True, oned_as="column")


def _cells(texts: list[str]) -> np.ndarray:
    return np.array(texts, dtype=object)


def state_space(contents: Contents) -> dict[str, np.ndarray]:
    """x' = A x + B f, y = C x + D f from the twelve interface forces to the motions.

    The state holds the modal coordinates of the free reduced model, then their velocities, in
    which A is exact for the rigid motions: second-order poles at zero.

    Returns
    -------
    dict of ndarray
        ``A`` (2n, 2n), ``B`` (2n, 12), ``C`` (12, 2n), ``D`` (12, 12).

    Raises
    ------
    Refusal
        If the damping is not viscous.
    """
    model = contents.model
    values, vectors = model.free_modes()
    n = len(values)
    a = np.zeros((2 * n, 2 * n))
    a[:n, n:] = np.eye(n)
    a[n:, :n] = -np.diag(values)
    a[n:, n:] = -np.diag(viscous_coefficients(values, contents.damping))
    b, c = np.zeros((2 * n, INTERFACE)), np.zeros((INTERFACE, 2 * n))
    b[n:] = vectors[:INTERFACE].T
    c[:, :n] = vectors[:INTERFACE]
    return {"A": a, "B": b, "C": c, "D": np.zeros((INTERFACE, INTERFACE))}
