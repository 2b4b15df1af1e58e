"""Mounts that carry a payload: dynamic stiffness between floor and payload against frequency."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from foilstudy.base.ranges import require_number
from foilstudy.measure.isolation.parallel import two_ended


class Mount(Protocol):
    """Anything between floor and payload that moves along one direction."""

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """2 x 2 dynamic stiffness on the motions of floor and payload, see `parallel`.

        Parameters
        ----------
        frequencies : ndarray, shape (f,)
            Hz.

        Returns
        -------
        ndarray of complex, shape (f, 2, 2), N/m
        """
        ...


@dataclass(frozen=True)
class Spring:
    """Massless spring with losses: k (1 + i eta) + i omega c.

    Attributes
    ----------
    stiffness : float
        k, N/m.
    loss_factor : float
        eta, structural damping, the same at all frequencies.
    viscous_damping : float
        c, N s/m.

    Raises
    ------
    ValueError
        If the stiffness is not positive or a damping is negative.
    """

    stiffness: float
    loss_factor: float = 0.0
    viscous_damping: float = 0.0

    def __post_init__(self) -> None:
        require_number("stiffness of a mount's spring", self.stiffness, "N/m", above=0)
        for name in ("loss_factor", "viscous_damping"):
            value = getattr(self, name)  # a negative one would feed energy
            require_number(f"{name.replace('_', ' ')} of a mount's spring", value, least=0)

    def at(self, frequencies: np.ndarray) -> np.ndarray:
        """Complex stiffness, N/m, at frequencies in Hz."""
        omega = 2 * np.pi * np.asarray(frequencies, dtype=float)
        return self.stiffness * (1 + 1j * self.loss_factor) + 1j * omega * self.viscous_damping

    @classmethod
    def suspending(
        cls, mass: float, frequency_hz: float, loss_factor: float = 0.0, damping_ratio: float = 0.0
    ) -> Spring:
        """Spring on which a mass has a given undamped frequency.

        Parameters
        ----------
        mass : float
            kg.
        frequency_hz : float
            Suspension frequency, Hz.
        loss_factor : float
            Structural damping.
        damping_ratio : float
            Viscous damping over the critical one, c / (2 m omega_0).
        """
        require_number("suspended mass", mass, "kg", above=0)
        require_number("suspension frequency", frequency_hz, "Hz", above=0)
        omega = 2 * np.pi * frequency_hz
        return cls(mass * omega**2, loss_factor, 2 * damping_ratio * mass * omega)


@dataclass(frozen=True)
class IdealMount:
    """Mount without mass of its own: one spring."""

    spring: Spring

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """See `Mount`."""
        spring = self.spring.at(frequencies)
        return two_ended(spring, spring, spring)


@dataclass(frozen=True)
class ResonantMount:
    """Mount with a resonance of its own: a mass between two springs.

    With s_1, s_2 the complex springs and m_i the mass between them, its motion eliminated from
    the 3 x 3 dynamic stiffness,

        D_ff = s_1 - s_1^2 / d,   D_pp = s_2 - s_2^2 / d,   -D_pf = s_1 s_2 / d,
        d = s_1 + s_2 - omega^2 m_i.

    All three peak where d is small, at the resonance with both ends held; above it the transfer
    stiffness falls as 1/omega^2.

    Attributes
    ----------
    lower, upper : Spring
        On the side of the floor and of the payload.
    internal_mass : float
        m_i, kg.
    """

    lower: Spring
    upper: Spring
    internal_mass: float

    def __post_init__(self) -> None:
        require_number("internal mass of a mount", self.internal_mass, "kg", above=0)

    @classmethod
    def with_resonance(
        cls, static: Spring, frequency_hz: float, internal_mass: float
    ) -> ResonantMount:
        """Mount of a given static stiffness with its internal resonance at a given frequency.

        The two springs follow from their series k_1 k_2 / (k_1 + k_2) = k and from
        k_1 + k_2 = m_i omega_i^2; the softer one, the air, is put on the side of the floor, the
        stiffer one, the connection of its piston, on that of the payload.

        Parameters
        ----------
        static : Spring
            Both springs in series. Its loss factor becomes that of both.
        frequency_hz : float
            Undamped internal resonance with both ends held, Hz.
        internal_mass : float
            kg.

        Raises
        ------
        ValueError
            If no two springs do that, because the mass is below 4 k / omega_i^2; if the static
            spring has a viscous damper, which cannot be divided between two without a choice.
        """
        require_number("internal resonance of a mount", frequency_hz, "Hz", above=0)
        require_number("internal mass of a mount", internal_mass, "kg", above=0)
        if static.viscous_damping:
            raise ValueError(
                "The static spring of a resonant mount has a viscous damper, and it is open which "
                "part of the mount it belongs to; build ResonantMount from two springs instead."
            )
        omega = 2 * np.pi * frequency_hz
        both = internal_mass * omega**2
        if both < 4 * static.stiffness:
            raise ValueError(
                f"An internal mass of {internal_mass:g} kg is too light for a mount of "
                f"{static.stiffness:g} N/m to resonate at {frequency_hz:g} Hz; use at least "
                f"{1.01 * 4 * static.stiffness / omega**2:.3g} kg, or a higher resonance."
            )
        upper = 0.5 * both * (1 + np.sqrt(1 - 4 * static.stiffness / both))
        lower = static.stiffness * both / upper
        return cls(
            Spring(lower, static.loss_factor), Spring(upper, static.loss_factor), internal_mass
        )

    def dynamic_stiffness(self, frequencies: np.ndarray) -> np.ndarray:
        """See `Mount`."""
        omega = 2 * np.pi * np.asarray(frequencies, dtype=float)
        lower, upper = self.lower.at(frequencies), self.upper.at(frequencies)
        between = lower + upper - omega**2 * self.internal_mass
        return two_ended(
            lower - lower**2 / between, upper - upper**2 / between, lower * upper / between
        )
