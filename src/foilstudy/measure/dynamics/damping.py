"""Damping models: diagonal in the eigenmodes, so that they are applied after a reduction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from foilstudy.base.ranges import require_number


class Damping(Protocol):
    """How an eigenmode of squared angular eigenfrequency lambda dissipates."""

    def modal(self, eigenvalues: np.ndarray, omega: np.ndarray) -> np.ndarray:
        """Damping term d of the modal dynamic stiffness lambda - omega2 + d, rad2/s2.

        Parameters
        ----------
        eigenvalues : ndarray
            lambda, rad2/s2; zero for rigid modes, perhaps negative under pre-stress.
        omega : ndarray
            Angular frequency, rad/s, of a shape that broadcasts with the eigenvalues.

        Returns
        -------
        ndarray of complex
        """
        ...


@dataclass(frozen=True)
class ModalDamping:
    """The same share ``ratio`` of the critical damping in every mode: d = 2 i zeta omega_j omega.

    That of the published study, with 0.05. Modes of negative eigenvalue are not damped.
    """

    kind = "modal"
    ratio: float

    def __post_init__(self):
        require_number("share of the critical damping", self.ratio, least=0, below=1)

    @classmethod
    def of_share(cls, share: float, between_hz: tuple[float, float] | None = None) -> ModalDamping:
        """From a share of the critical damping."""
        return cls(share)

    def modal(self, eigenvalues: np.ndarray, omega: np.ndarray) -> np.ndarray:
        """See `Damping`."""
        return 2j * self.ratio * np.sqrt(np.maximum(eigenvalues, 0.0)) * omega


@dataclass(frozen=True)
class StructuralDamping:
    """Complex stiffness K (1 + i eta): d = i eta omega_j2, the same at all frequencies.

    Of a pre-stressed structure with free rings some eigenvalues are negative; those modes gain
    energy.
    """

    kind = "structural"
    loss_factor: float

    def __post_init__(self):
        require_number("loss factor", self.loss_factor, least=0, below=2)

    @classmethod
    def of_share(
        cls, share: float, between_hz: tuple[float, float] | None = None
    ) -> StructuralDamping:
        """With the loss factor that dissipates at resonance what a share of the critical does."""
        return cls(2 * share)

    def modal(self, eigenvalues: np.ndarray, omega: np.ndarray) -> np.ndarray:
        """See `Damping`."""
        return 1j * self.loss_factor * eigenvalues + 0 * omega


@dataclass(frozen=True)
class RayleighDamping:
    """C = alpha M + beta K: d = i omega (alpha + beta omega_j2).

    Attributes
    ----------
    mass_coefficient : float
        alpha, 1/s; it damps rigid motions too.
    stiffness_coefficient : float
        beta, s.
    """

    kind = "rayleigh"
    mass_coefficient: float
    stiffness_coefficient: float

    def __post_init__(self):
        for name, unit in (("mass", "1/s"), ("stiffness", "s")):
            value = getattr(self, f"{name}_coefficient")
            require_number(f"{name} coefficient of Rayleigh damping", value, unit, least=0)

    @classmethod
    def of_share(
        cls, share: float, between_hz: tuple[float, float] | None = None
    ) -> RayleighDamping:
        """With a share of the critical damping at the two frequencies.

        Raises
        ------
        ValueError
            Without them.
        """
        if between_hz is None:
            raise ValueError("Rayleigh damping needs the two frequencies at which it is known")
        return cls.between(share, *between_hz)

    @classmethod
    def between(cls, ratio: float, lower_hz: float, upper_hz: float) -> RayleighDamping:
        """With a given share of critical damping at two frequencies, less between them."""
        require_number("share of the critical damping", ratio, least=0, below=1)
        require_number("lower frequency of Rayleigh damping", lower_hz, "Hz", above=0)
        require_number("upper frequency of Rayleigh damping", upper_hz, "Hz", above=lower_hz)
        lower, upper = 2 * np.pi * lower_hz, 2 * np.pi * upper_hz
        beta = 2 * ratio / (lower + upper)
        return cls(beta * lower * upper, beta)

    def modal(self, eigenvalues: np.ndarray, omega: np.ndarray) -> np.ndarray:
        """See `Damping`."""
        return 1j * omega * (self.mass_coefficient + self.stiffness_coefficient * eigenvalues)
