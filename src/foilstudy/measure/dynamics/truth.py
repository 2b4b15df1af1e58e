"""Direct full-order solution at chosen frequencies: what every reduction is held against."""

from __future__ import annotations

import numpy as np

from foilstudy.linalg import combined, factorise
from foilstudy.measure.dynamics.damping import (
    Damping,
    ModalDamping,
    RayleighDamping,
    StructuralDamping,
)
from foilstudy.measure.dynamics.response import checked
from foilstudy.measure.dynamics.structure import INTERFACE, Structure, bordered


def full_order(structure: Structure, frequencies: np.ndarray, damping: Damping) -> np.ndarray:
    """Interface dynamic stiffness of the whole structure, without any reduction.

    Parameters
    ----------
    structure : Structure
        Free of stress for modal damping.
    frequencies : ndarray
        Hz, positive; each costs a complex factorisation, and modal damping some thirty real ones
        more for all together.
    damping : Damping

    Returns
    -------
    ndarray of complex, shape (frequencies, 12, 12)

    Raises
    ------
    SolveError
        If a factorisation fails.
    ValueError
        For modal damping under pre-stress, where eigenvalues may be negative, or for frequencies
        that are not positive.
    """
    omegas = 2 * np.pi * checked(frequencies)
    if isinstance(damping, ModalDamping):
        if not structure.stress_free:
            raise ValueError(
                "the full-order solution with modal damping needs a stress-free structure; take "
                "structural or Rayleigh damping for a pre-stressed one."
            )
        return _modally_damped(structure, omegas, damping.ratio)
    out = []
    for omega in omegas:
        stiff, heavy = _factors(damping, omega)
        out.append(_condensed(structure, stiff, heavy))
    return np.array(out)


def _factors(damping: Damping, omega: float) -> tuple[complex, complex]:
    """a, b of the dynamic stiffness a K + b M."""
    match damping:
        case StructuralDamping(loss_factor):
            return 1 + 1j * loss_factor, -(omega**2) + 0j
        case RayleighDamping(alpha, beta):
            return 1 + 1j * omega * beta, -(omega**2) + 1j * omega * alpha
    raise ValueError(f"no full-order solution with {type(damping).__name__}.")


def _condensed(structure: Structure, stiff: complex, heavy: complex) -> np.ndarray:
    """Interface dynamic stiffness of a K + b M, the interior eliminated."""
    k, m = structure.stiffness, structure.mass
    coupling = stiff * k.coupling + heavy * m.coupling
    inner = factorise(combined(stiff, k.interior, heavy, m.interior)).solve(coupling)
    return stiff * k.interface + heavy * m.interface - coupling.T @ inner


_STEP, _REACH = 0.6, 1e-3
"""Of the quadrature in ln(tau): its error is exp(-2 pi (pi/2 - asin zeta) / step), 1e-7 for little
damping, and beyond the band by this factor the integrand has fallen with the third power."""


def _modally_damped(structure: Structure, omegas: np.ndarray, ratio: float) -> np.ndarray:
    """Inverse of the receptance sum_j phi_j phi_j^T / (lambda_j - omega2 + 2 i zeta sqrt(lambda_j)
    omega), without its modes.

    With s = omega (sqrt(1 - zeta2) - i zeta) the fraction is
    s / (omega sqrt(1 - zeta2)) / (lambda - s2)
    + (4 i zeta omega / pi) int_0^inf tau2 / |tau2 + s2|2 / (lambda + tau2) dtau,
    from sqrt(lambda) = (2 / pi) int lambda / (lambda + tau2) dtau: one complex solution per
    frequency, and real ones at the nodes tau of a quadrature that all frequencies share. The rigid
    modes, for which lambda + tau2 nearly vanishes, are taken apart.
    """
    rigid = _RigidMotion(structure)
    step = _STEP * (1 - 2 * np.arcsin(ratio) / np.pi)
    nodes = np.exp(np.arange(np.log(_REACH * omegas.min()), np.log(omegas.max() / _REACH), step))
    elastic = [rigid.elastic_receptance(tau) for tau in nodes]
    out = []
    for omega in omegas:
        root = np.sqrt(1 - ratio**2)
        s2 = (omega * (root - 1j * ratio)) ** 2
        inverse = np.linalg.inv(_condensed(structure, 1.0 + 0j, -s2))
        receptance = (1 - 1j * ratio / root) * (inverse - rigid.interface / -s2)
        weights = nodes**3 / np.abs(nodes**2 + s2) ** 2 * step * 4j * ratio * omega / np.pi
        receptance = receptance + np.tensordot(weights, elastic, axes=1)
        receptance += rigid.interface / -(omega**2)
        out.append(np.linalg.inv(receptance))
    return np.array(out)


class _RigidMotion:
    """Rigid modes of a free structure and receptances without them."""

    def __init__(self, structure: Structure):
        self._structure, self._mass = structure, bordered(structure.mass)
        motion = structure.rigid_motions
        shapes = np.vstack([structure.static.constraint_modes @ motion, motion])
        gram = shapes.T @ (self._mass @ shapes)
        self._shapes = np.linalg.solve(np.linalg.cholesky(gram), shapes.T).T
        part = self._shapes[-INTERFACE:]
        self.interface = part @ part.T

    def elastic_receptance(self, tau: float) -> np.ndarray:
        """Of K + tau2 M between the ring motions, without the rigid modes, shape (12, 12)."""
        k, m = self._structure.stiffness, self._structure.mass
        load = np.zeros((self._mass.shape[0], INTERFACE))
        load[-INTERFACE:] = np.eye(INTERFACE)
        load -= self._mass @ (self._shapes @ self._shapes[-INTERFACE:].T)
        # the interior first, rings held: the whole is nearly singular
        coupling = k.coupling + tau**2 * m.coupling
        inverse = factorise(combined(1.0, k.interior, tau**2, m.interior))
        solved = inverse.solve(np.hstack([coupling, load[:-INTERFACE]]))
        follow, free = solved[:, :INTERFACE], solved[:, INTERFACE:]
        rings = np.linalg.solve(
            k.interface + tau**2 * m.interface - coupling.T @ follow,
            load[-INTERFACE:] - coupling.T @ free,
        )
        moved = np.vstack([free - follow @ rings, rings])
        moved -= self._shapes @ (self._shapes.T @ (self._mass @ moved))
        return moved[-INTERFACE:]
