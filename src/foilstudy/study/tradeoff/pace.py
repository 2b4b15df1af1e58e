"""Time of a setting and of the default in turns, in one process."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from foilstudy.base.costs import measured

_TURNS, _ENOUGH = 20, 2.0
"""Turns at most, and processor seconds in all after which there is none more."""


def in_turns(own: Callable[[], Any], default: Callable[[], Any]) -> tuple[Any, dict[str, float]]:
    """Result of the one, and ``seconds`` and ``pace``: least processor times of both.

    The pace of a machine drifts with its temperature and with what else runs on it; that of the
    default in the same minute tells by how much.
    """
    _, first = _timed(default)  # it also loads what is loaded once
    pace, seconds, result = [first], [], None
    while not seconds or (len(seconds) < _TURNS and sum(seconds) + sum(pace) < _ENOUGH):
        result, taken = _timed(own)
        seconds.append(taken)
        pace.append(_timed(default)[1])
    return result, {"seconds": min(seconds), "pace": min(pace)}


def _timed(task: Callable[[], Any]) -> tuple[Any, float]:
    with measured() as cost:
        result = task()
    return result, cost.cpu_seconds
