"""Numbers that cannot be what was meant, refused in one sentence."""

from __future__ import annotations

import math
from numbers import Integral, Real

from foilstudy.base.errors import Refusal

__all__ = ["require_count", "require_number"]


def require_number(
    what: str,
    value: float,
    unit: str = "",
    *,
    above: float = -math.inf,
    least: float = -math.inf,
    below: float = math.inf,
    most: float = math.inf,
) -> None:
    """Refuse what is no finite number within its bounds.

    Parameters
    ----------
    what : str
        The beginning of the sentence: ``thickness of a foil``.
    value : float
    unit : str
        Behind value and bounds.
    above, below : float
        Bounds that the value may not take.
    least, most : float
        Bounds that it may.

    Raises
    ------
    Refusal
    """
    number = isinstance(value, Real) and not isinstance(value, bool)
    if number and math.isfinite(value) and above < value < below and least <= value <= most:
        return
    words = {"above": above, "of at least": least, "below": below, "of at most": most}
    bounds = [f"{word} {bound:g}" for word, bound in words.items() if math.isfinite(bound)]
    shown = f"{value:g}" if number else repr(value)
    shown, wanted = (f"{text} {unit}".strip() for text in (shown, " and ".join(bounds)))
    raise Refusal(f"the {what} is {shown}; give a finite number {wanted}".rstrip() + ".")


def require_count(what: str, value: int, least: int) -> None:
    """Refuse what is no whole number of at least some size.

    Raises
    ------
    Refusal
    """
    if not isinstance(value, Integral) or isinstance(value, bool) or value < least:
        raise Refusal(f"the {what} is {value!r}; give a whole number of at least {least}.")
