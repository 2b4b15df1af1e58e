"""Time of a setting and of the default in turns, in one process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from foilstudy.base.costs import measured

_ROUNDS, _ENOUGH = 20, 2.0
"""Turns at most, and processor seconds of both together after which there is none more."""


def in_turns(own: Callable[[], Any], default: Callable[[], Any]) -> tuple[Any, dict[str, float]]:
    """Result of the one, and ``seconds`` and ``pace``: least processor times of both.

    The pace of a machine drifts with its temperature and with what else runs on it; that of the
    default in the same minute tells by how much.
    """
    result, seconds, pace = None, [], []
    while len(seconds) < _ROUNDS and sum(seconds) + sum(pace) < _ENOUGH:
        with measured() as cost:
            default()
        pace.append(cost.cpu_seconds)
        with measured() as cost:
            result = own()
        seconds.append(cost.cpu_seconds)
    return result, {"seconds": min(seconds), "pace": min(pace)}
