"""Stress removals by plastic flow in the held shape, as in the published work."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import Patch
from foilstudy.model.shell.material.plastic import Plastic, PlasticTerm
from foilstudy.model.shell.shell import Shell
from foilstudy.model.shell.tangent import block_matrix


class FlowedShell:
    """A shell that has flowed, in a shape that is held, until no layer is beyond a flow stress.

    What is left is that much in every layer, and what the strains of one element differ by: the
    layers in its middle do not see it, and a hold of any length leaves it in. It is less on finer
    meshes.

    Parameters
    ----------
    shell : Shell
        Free of plastic strain.
    points : ndarray, shape (3, rows, columns)
        The shape, m.
    flow_stress : float
        Pa.
    """

    def __init__(self, shell: Shell, points: np.ndarray, flow_stress: float):
        material = replace(shell.material, yield_stress=flow_stress)
        self._shell, self._points = shell, points
        self._term = PlasticTerm(shell, Plastic(material, hardening=0.0))
        self._state = self._term.evolved(points, self._term.start())

    @property
    def patch(self) -> Patch:
        """That of the shell."""
        return self._shell.patch

    def residual_energy(self) -> float:
        """Elastic energy that has not flowed, J."""
        return self._left()[0]

    def residual_force(self) -> np.ndarray:
        """See `Residual`."""
        return self._left()[1]

    def _left(self) -> tuple[float, np.ndarray]:
        force = np.empty_like(self._points)
        energies = self._term.force_with_shell(self._points, force, self._state)
        return float(energies.sum()), force

    def tangent(self) -> sparse.csr_matrix:
        """See `Relieved`."""
        return block_matrix(self.patch, self.tangent_blocks())

    def tangent_blocks(self) -> np.ndarray:
        """See `Relieved`."""
        blocks = self._shell.tangent_blocks(self._points)
        return blocks + self._term.tangent_blocks(self._points, self._state)


@dataclass(frozen=True)
class JohnsonCook:
    """Rate-dependent flow while the shape is held: A (1 + c ln(rate / rate_0)), no hardening.

    At held strain the rate falls as the stress does, so that a hold of T leaves
    A (1 + c ln(A c / (E rate_0 T))), and A once that is less. The constants are the published ones
    (M. Bader, Structural Dynamics of Crumpled Thin Sheets, TU Delft, 2026): FEP takes 178 days to
    come to A, and a second leaves more than its yield stress.

    Attributes
    ----------
    yield_stress : float
        A, Pa.
    rate_coefficient : float
        c.
    reference_rate : float
        rate_0, 1/s.
    hold : float or None
        How long the shape is held, s; None: until nothing flows any more.
    """

    kind = "johnson_cook"
    yield_stress: float = 1.0
    rate_coefficient: float = 1e6
    reference_rate: float = 1e-10
    hold: float | None = None

    def flow_stress(self, youngs_modulus: float) -> float:
        """What the hold leaves of any higher stress, Pa."""
        if self.hold is None:
            return self.yield_stress
        rise = self.yield_stress * self.rate_coefficient
        left = np.log(rise / (youngs_modulus * self.reference_rate * self.hold))
        return self.yield_stress + rise * max(float(left), 0.0)

    def relieved(self, shell: Shell, points: np.ndarray) -> FlowedShell:
        """See `StressRemoval`."""
        return FlowedShell(shell, points, self.flow_stress(shell.material.youngs_modulus))


@dataclass(frozen=True)
class ZerilliArmstrong:
    """Flow by temperature while the shape is held: C0 + C1 exp(-C3 T), no hardening, C4 = 0.

    The constants are the published ones (where they served for solids only).

    Attributes
    ----------
    yield_stress, thermal_stress : float
        C0 and C1, Pa.
    softening : float
        C3, 1/K.
    temperature : float
        T, K.
    """

    kind = "zerilli_armstrong"
    yield_stress: float = 0.1
    thermal_stress: float = 1e5
    softening: float = 10.0
    temperature: float = 300.0

    @property
    def flow_stress(self) -> float:
        """Pa."""
        heated = float(np.exp(-self.softening * self.temperature))
        return self.yield_stress + self.thermal_stress * heated

    def relieved(self, shell: Shell, points: np.ndarray) -> FlowedShell:
        """See `StressRemoval`."""
        return FlowedShell(shell, points, self.flow_stress)
