"""The share of a foil that has let go of its stress since and rests in a later shape.

Stress that relaxes at a held shape is that of bonds that break and form again without any. With
the share that is left scaled down, E_old times that share and E_new times the rest, the shape
stays in equilibrium, its forces fall by the share, and what has let go resists new motion as foil
that is free of stress there (Green and Tobolsky, J. Chem. Phys. 14, 1946, for rubber).
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.shell.shell import Shell


class Renewed:
    """A term of a `solve.problem.Problem`, beside the foil of before; elastic from now on.

    Parameters
    ----------
    shell : Shell
        The whole foil, free of stress in the shape in which it rested.
    share : float
        Of it that has let go.
    """

    energy_names = ("renewed",)

    def __init__(self, shell: Shell, share: float):
        self._shell, self._share = shell, share

    def start(self) -> None:
        """It has no memory."""

    def evolved(self, points: np.ndarray, state: None) -> None:
        """It has no memory."""

    def force(self, points: np.ndarray, out: np.ndarray, state: None) -> np.ndarray:
        """See `solve.problem.Term`."""
        energies = self._shell.force(points, out)
        out *= self._share
        return np.array([self._share * energies.sum()])

    def tangent(self, points: np.ndarray, state: None) -> sparse.csr_matrix:
        """See `solve.problem.Term`."""
        return self._share * self._shell.tangent(points)
