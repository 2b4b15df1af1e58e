"""Reductions that keep modes below a cut-off, and as many modes as a tolerance needs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from foilstudy.base.ranges import require_number
from foilstudy.linalg import MODES_MAX, SolveError, TooManyModes
from foilstudy.measure.dynamics.accuracy import Wanted
from foilstudy.measure.dynamics.reduction import ReducedModel, Reduction
from foilstudy.measure.dynamics.structure import Structure

_FIRST, _FACTOR, _TRIES = 2.0, 1.4, 6
"""First cut-off over the highest frequency, growth, and how often: up to 10.8 times."""
_MODES_MAX, _LOWERINGS = 1000, 12
"""Modes that one search may be after: half a minute at ten thousand unknowns, and how often the
first cut-off is halved to keep to them."""


@dataclass(frozen=True)
class ByNeed:
    """A reduction without a cut-off of its own: see `with_enough_modes`.

    Attributes
    ----------
    kind : callable
        `CraigBampton` or `HintzHerting`: cut-off (Hz), `Wanted`, number of modes to reduction.
    wanted : Wanted
    """

    kind: Callable[[float, Wanted, int], Reduction]
    wanted: Wanted

    def reduce(self, structure: Structure) -> ReducedModel:
        """See `Reduction`."""
        return with_enough_modes(structure, self.kind, self.wanted)


@dataclass(frozen=True)
class Modal:
    """What reductions with a cut-off have in common.

    Attributes
    ----------
    cutoff_hz : float
    wanted : Wanted, optional
        What the error is estimated for.
    modes_max : int
        Modes that are sought at most; more of them below the cut-off are refused.
    """

    cutoff_hz: float
    wanted: Wanted | None = None
    modes_max: int = MODES_MAX

    def __post_init__(self):
        require_number("cut-off of a reduction", self.cutoff_hz, "Hz", above=0)

    @classmethod
    def for_band(cls, wanted: Wanted, cutoff_hz: float | None = None) -> Reduction:
        """See `Reduction`; without a cut-off, as many modes as the tolerance needs."""
        return ByNeed(cls, wanted) if cutoff_hz is None else cls(cutoff_hz, wanted)


def with_enough_modes(
    structure: Structure, reduction: Callable[[float, Wanted, int], Reduction], wanted: Wanted
) -> ReducedModel:
    """Raise the cut-off until the model's own error estimate meets the tolerance.

    At most six searches, each for at most a thousand modes: where more lie below the first
    cut-off, that is lowered, and the model holds up to a lower frequency.

    Parameters
    ----------
    structure : Structure
    reduction : callable
        `CraigBampton` or `HintzHerting`: cut-off (Hz), `Wanted`, number of modes to reduction.
    wanted : Wanted

    Returns
    -------
    ReducedModel
        The last one tried; its `error_estimate` says whether it met the tolerance. Craig-Bampton
        seldom meets 1e-3 up to the end of a band that it was given.

    Raises
    ------
    SolveError
        If a factorisation or the mode search fails at the first cut-off.
    """
    cutoff = _FIRST * wanted.highest_hz
    for lowering in range(_LOWERINGS + 1):
        try:
            model = reduction(cutoff, wanted, _MODES_MAX).reduce(structure)
            break
        except TooManyModes:
            if lowering == _LOWERINGS:
                raise
            cutoff /= 2
    for _ in range(_TRIES - 1):
        if model.error_estimate <= wanted.tolerance:
            break
        cutoff *= _FACTOR
        try:
            model = reduction(cutoff, wanted, _MODES_MAX).reduce(structure)
        except SolveError:
            break  # the last one is the best there is, and its estimate says how good
    return model
