"""One mode of a clamped structure at finite amplitude: its coefficients and its backbone.

The structure is M u'' + f(u) = 0 about a state of rest, with a mode of mass-normalised shape p and
eigenvalue w2. The force in direction p bends with the amplitude a of the mode, and through the
quadratic force g a2 / 2, with g the second derivative of f along p, all other modes are driven.

Where these are much faster than the mode, they follow statically: implicit condensation, by which
the mode is an `Oscillator` of its own. In general they answer a force that is constant in one part
and twice as fast as the mode in the other: the normal form of third order, by which the square of
the frequency changes with that of the amplitude by

    bend = C / 8 - g.K^-1 g / 4 - g.(K - 4 w2 M)^-1 g / 8,

C being the third derivative of p.f along p. Both agree where condensation holds.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.sparse as sparse

from foilstudy.linalg import Factorisation, factorise, shifted
from foilstudy.measure.amplitude.oscillator import Oscillator


class Vibrating(Protocol):
    """A structure of n unknowns about its state of rest.

    Attributes
    ----------
    mass, stiffness : csr_matrix, shape (n, n)
        The latter is the tangent at rest.
    """

    mass: sparse.csr_matrix
    stiffness: sparse.csr_matrix

    def force(self, displacement: np.ndarray) -> np.ndarray:
        """Internal force beyond that at rest, N."""
        ...

    def tangent(self, displacement: np.ndarray) -> sparse.csr_matrix:
        """Its derivative, N/m."""
        ...


@dataclass(frozen=True)
class NormalForm:
    """Of one mode; its amplitude a is that of the mass-normalised shape, sqrt(kg) m.

    Attributes
    ----------
    eigenvalue : float
        rad2/s2.
    quadratic, cubic : float
        Of the force a eigenvalue + quadratic a2 + cubic a3 with all other modes condensed.
    bend : float
        Change of the square of the frequency over that of the amplitude, other modes moving.
    displacement : float
        Largest displacement of an unknown per amplitude, m: turns a into a length.
    doubt : float
        Of `bend` by the finite steps, a share of its value.
    """

    eigenvalue: float
    quadratic: float
    cubic: float
    bend: float
    displacement: float
    doubt: float

    @property
    def frequency(self) -> float:
        """At small amplitude, Hz."""
        return float(np.sqrt(self.eigenvalue) / (2 * np.pi))

    @property
    def oscillator(self) -> Oscillator:
        """With all other modes condensed."""
        return Oscillator((self.eigenvalue, self.quadratic, self.cubic))

    @property
    def duffing(self) -> Oscillator:
        """Without a quadratic force, and with the backbone of the normal form.

        For vibrations near the mode's frequency, driven ones too: where condensation does not hold
        this does, as long as no other mode has nearly this frequency or nearly twice it.
        """
        return Oscillator((self.eigenvalue, 0.0, 4 / 3 * self.bend))

    @property
    def condensed_bend(self) -> float:
        """The same as `bend` by implicit condensation."""
        return 0.75 * self.cubic - 5 / 6 * self.quadratic**2 / self.eigenvalue

    @property
    def condensation_error(self) -> float:
        """Of `condensed_bend`, a share of `bend`: what the inertia of the other modes does."""
        return abs(self.condensed_bend / self.bend - 1)

    def backbone(self, displacement: np.ndarray) -> np.ndarray:
        """Frequency of free vibration by its largest displacement, Hz.

        Parameters
        ----------
        displacement : ndarray
            m.
        """
        amplitude = np.asarray(displacement) / self.displacement
        return np.sqrt(np.maximum(self.eigenvalue + self.bend * amplitude**2, 0)) / (2 * np.pi)

    def shift_amplitude(self, share: float) -> float:
        """Largest displacement at which the frequency has changed by a share, m."""
        square = ((1 + np.copysign(share, self.bend)) ** 2 - 1) * self.eigenvalue / self.bend
        return float(np.sqrt(square) * self.displacement)


def normal_form(
    system: Vibrating,
    static: Factorisation,
    eigenvalue: float,
    shape: np.ndarray,
    displacement: float,
) -> NormalForm:
    """Of one mode, by finite steps along it.

    Parameters
    ----------
    system : Vibrating
    static : Factorisation
        Of its stiffness.
    eigenvalue : float
        rad2/s2.
    shape : ndarray, shape (n,)
        Mass-normalised.
    displacement : float
        Largest displacement of an unknown in the longest step, m: a fraction of the thickness of a
        shell.

    Raises
    ------
    SolveError
        If the structure cannot be factored at twice the frequency of the mode.
    """
    largest = float(np.abs(shape).max())
    step = displacement / largest / 4
    ahead, behind = ([system.force(sign * k * step * shape) for k in (1, 2, 4)] for sign in (1, -1))
    even = [a + b for a, b in zip(ahead, behind, strict=True)]
    odd = [shape @ (a - b) / 2 for a, b in zip(ahead, behind, strict=True)]
    driven = (4 * even[0] / step**2 - even[1] / (2 * step) ** 2) / 3
    near, far = ((odd[k + 1] - 2 * odd[k]) / (2**k * step) ** 3 for k in (0, 1))
    third = (4 * near - far) / 3

    itself = float(shape @ driven)
    slow = float(driven @ static.solve(driven))
    dynamic, _ = shifted(system.stiffness, system.mass, 4 * eigenvalue)
    fast = float(driven @ dynamic.solve(driven))
    condensed = slow - itself**2 / eigenvalue
    bend = float(third / 8 - slow / 4 - fast / 8)
    return NormalForm(
        eigenvalue,
        itself / 2,
        float(third / 6 - condensed / 2),
        bend,
        largest,
        float(abs(near - third) / 8 / abs(bend)),
    )


def condensed_force(
    system: Vibrating, shape: np.ndarray, amplitudes: np.ndarray, tolerance: float = 1e-6
) -> tuple[np.ndarray, np.ndarray]:
    """Force along a mode at given amplitudes of it, all else in equilibrium.

    Newton steps with the amplitude held, each amplitude from the one before.

    Parameters
    ----------
    system : Vibrating
    shape : ndarray, shape (n,)
        Mass-normalised.
    amplitudes : ndarray
        Away from zero one after the other, sqrt(kg) m.
    tolerance : float
        Of the residual relative to the modal force.

    Returns
    -------
    force : ndarray
        Derivative of the condensed energy by the amplitude; NaN from the first amplitude on at
        which no equilibrium was found.
    displacements : ndarray, shape (amplitudes, n)
        m.

    Raises
    ------
    SolveError
        If a tangent is singular.
    """
    load = system.mass @ shape
    forces = np.full(len(amplitudes), np.nan)
    shapes = np.full((len(amplitudes), shape.size), np.nan)
    u = np.zeros_like(shape)
    for k, amplitude in enumerate(amplitudes):
        u = u + (amplitude - load @ u) * shape
        for _ in range(_ITERATIONS):
            internal = system.force(u)
            force = float(shape @ internal)
            residual = internal - force * load
            if np.linalg.norm(residual) <= tolerance * np.linalg.norm(force * load):
                forces[k], shapes[k] = force, u
                break
            factor = factorise(system.tangent(u))
            step, answer = factor.solve(np.column_stack([residual, load])).T
            u = u - step + (load @ step) / (load @ answer) * answer
        else:
            break
    return forces, shapes


_ITERATIONS = 12
