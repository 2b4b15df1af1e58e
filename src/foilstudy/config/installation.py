"""From the moves of a configuration to those of the path, in SI."""

from __future__ import annotations

from foilstudy.model.supports.moves import Move

from .sections import Installation


def moves_of(section: Installation) -> tuple[Move, ...]:
    """What the top ring does in turn."""

    def scaled(value: float | None, unit: float) -> float | None:
        return None if value is None else value * unit

    return tuple(
        Move(
            None if each.shorten_percent is None else each.shorten_percent / 100,
            scaled(each.tilt_mrad, 1e-3),
            scaled(each.twist_mrad, 1e-3),
            scaled(each.shift_mm, 1e-3),
            each.cycles,
            each.release,
        )
        for each in section.moves
    )
