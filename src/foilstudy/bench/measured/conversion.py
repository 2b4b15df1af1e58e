"""Dynamic stiffness from what was measured, in whatever unit."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.recording import GRAVITY

__all__ = ["QUANTITIES", "UNITS", "Quantity", "as_stiffness", "unit_named"]


@dataclass(frozen=True)
class Quantity:
    """A kind of response.

    Attributes
    ----------
    name : str
    derivatives : int
        How often the motion is differentiated: 0 displacement, 2 acceleration.
    inverse : bool
        Motion per force, not force per motion.
    """

    name: str
    derivatives: int
    inverse: bool

    def stiffness(self, frequencies: np.ndarray, values: np.ndarray) -> np.ndarray:
        """N/m, from values in SI units at frequencies in Hz."""
        per_motion = 1 / values if self.inverse else values
        return per_motion * (2j * np.pi * frequencies) ** self.derivatives


STIFFNESS = Quantity("dynamic stiffness", 0, False)
RECEPTANCE = Quantity("receptance", 0, True)
ACCELERANCE = Quantity("accelerance", 2, True)
QUANTITIES = (STIFFNESS, RECEPTANCE, ACCELERANCE)

UNITS: dict[str, tuple[Quantity, float]] = {
    "N/m": (STIFFNESS, 1.0),
    "kN/m": (STIFFNESS, 1e3),
    "MN/m": (STIFFNESS, 1e6),
    "N/mm": (STIFFNESS, 1e3),
    "kN/mm": (STIFFNESS, 1e6),
    "N/um": (STIFFNESS, 1e6),
    "m/N": (RECEPTANCE, 1.0),
    "mm/N": (RECEPTANCE, 1e-3),
    "um/N": (RECEPTANCE, 1e-6),
    "m/kN": (RECEPTANCE, 1e-3),
    "mm/kN": (RECEPTANCE, 1e-6),
    "m/s^2/N": (ACCELERANCE, 1.0),
    "1/kg": (ACCELERANCE, 1.0),
    "mm/s^2/N": (ACCELERANCE, 1e-3),
    "g/N": (ACCELERANCE, GRAVITY),
}
"""Units as they are written in a file: what they are units of, and their size in SI."""

_ROUNDING = 1e-3
"""How far above 1 a coherence may be that was rounded."""


def unit_named(name: str, path: Path) -> tuple[Quantity, float]:
    """Quantity and size of a unit.

    Raises
    ------
    Refusal
        If it is none of `UNITS`.
    """
    plain = name.strip().replace("µ", "u").replace("μ", "u").replace("²", "^2").replace("s2", "s^2")
    plain = plain.replace("(", "").replace(")", "").replace(" ", "")
    if plain not in UNITS:
        raise Refusal(
            f"{path}: {name.strip()!r} is no unit of a response that is known here; convert to "
            f"one of {', '.join(UNITS)}."
        )
    return UNITS[plain]


def as_stiffness(
    path: Path,
    quantity: Quantity,
    frequencies: np.ndarray,
    values: np.ndarray,
    deviation: np.ndarray | None = None,
    coherence: np.ndarray | None = None,
) -> Estimate:
    """An estimate in N/m from values in SI units.

    The inverse of one measured receptance is the stiffness against which all else that can move
    does move.

    Raises
    ------
    Refusal
        If the frequencies are not positive and rising, a value is not finite or, as a motion per
        force, zero, or a deviation or coherence is none.
    """
    frequencies = np.asarray(frequencies, float)
    values = np.asarray(values, complex)
    if frequencies.ndim != 1 or frequencies.size < 2 or values.shape != frequencies.shape:
        raise Refusal(
            f"{path}: {frequencies.size} frequencies and values of shape {values.shape} are no "
            "response; give two or more frequencies with one value each."
        )
    rest = frequencies == 0  # a spectrum begins there, and a motion cannot be integrated
    frequencies, values = frequencies[~rest], values[~rest]
    known = [
        np.full(frequencies.shape, np.nan) if each is None else np.asarray(each, float)[~rest]
        for each in (deviation, coherence)
    ]
    if not (frequencies > 0).all() or not (np.diff(frequencies) > 0).all():
        raise Refusal(f"{path}: the frequencies do not rise from above zero; sort them, in Hz.")
    if not np.isfinite(values).all() or (quantity.inverse and (values == 0).any()):
        raise Refusal(
            f"{path}: values of the {quantity.name} are missing, infinite or zero; leave these "
            "frequencies out."
        )
    if (known[0] < 0).any():
        raise Refusal(f"{path}: a standard deviation is negative; correct the deviation.")
    if ((known[1] < 0) | (known[1] > 1 + _ROUNDING)).any():
        raise Refusal(
            f"{path}: the coherence is not within 0 and 1; give it as a share, not in per cent."
        )
    stiffness = quantity.stiffness(frequencies, values)
    return Estimate(frequencies, stiffness, known[0] * np.abs(stiffness / values), known[1])
