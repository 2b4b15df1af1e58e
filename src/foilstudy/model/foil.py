"""What is simulated, as plain data in SI units: material, foil and imperfection."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    """Linear elastic isotropic material.

    Attributes
    ----------
    youngs_modulus : float
        Pa.
    poisson_ratio : float
    density : float
        kg/m3.
    yield_stress : float
        Pa; only used to report which share of the surface a linear elastic model overloads.
    """

    youngs_modulus: float
    poisson_ratio: float
    density: float
    yield_stress: float


@dataclass(frozen=True)
class Foil:
    """A foil rolled into a cylinder, to be pushed together into a gap; lengths in m."""

    diameter: float
    reference_height: float
    gap_height: float
    thickness: float
    material: Material

    @property
    def overlength(self) -> float:
        """(h_ref - h_gap) / h_gap."""
        return (self.reference_height - self.gap_height) / self.gap_height


SMOOTH_LENGTH_MIN = 0.7
"""Least correlation length of a smooth imperfection over the element size that resolves it."""


@dataclass(frozen=True)
class Imperfection:
    """Random deviation of the stress-free shape from a perfect cylinder.

    Attributes
    ----------
    kind : str
        ``gaussian`` (independent at every control point), ``smoothed`` (Gaussian correlation) or
        ``buckling_modes`` (random superposition of classical axial buckling modes).
    amplitude : float
        Standard deviation of each coordinate of a control point (of the radial one for buckling
        modes), m. The surface averages over neighbours: half of it for ``gaussian``. That of
        ``smoothed`` is the surface's own, away from the rings.
    correlation_length : float
        Standard deviation of the smoothing kernel of ``smoothed``, m.
    stream : tuple of int
        Key of an independent random stream.
    """

    kind: str
    amplitude: float
    correlation_length: float
    stream: tuple[int, ...]
