"""What the shaker is driven with: specifications that become lines of a periodic signal."""

from __future__ import annotations

from typing import Protocol

from foilstudy.base.registry import Choice, Registry
from foilstudy.bench.signals.periodic import PeriodicSignal

__all__ = ["EXCITATIONS", "Excitation", "PeriodicSignal"]


class Excitation(Protocol):
    """A frozen specification; the same one is the same signal to the last bit."""

    def signal(self) -> PeriodicSignal:
        """The signal that it specifies."""
        ...


EXCITATIONS = Registry(
    "excitation",
    {
        "multisine": Choice(
            "bench.signals.multisine:Multisine",
            "lines of equal or sloping amplitude with random phases, repeated period by period",
        ),
        "noise": Choice(
            "bench.signals.noise:ColouredNoise",
            "normal noise whose power follows a power of the frequency within a band",
        ),
    },
)
