"""The reduced model for MATLAB: second-order matrices and a state space."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.io import savemat

from foilstudy.export.contents import Contents
from foilstudy.measure.dynamics.damping_matrix import damping_matrix, viscous_coefficients
from foilstudy.measure.dynamics.structure import INTERFACE
from foilstudy.measure.stiffness import DOF_NAMES


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
        "motion_names": np.array(DOF_NAMES, dtype=object),
        "motion_units": np.array(2 * (3 * ["m"] + 3 * ["rad"]), dtype=object),
        "force_units": np.array(2 * (3 * ["N"] + 3 * ["N m"]), dtype=object),
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
