"""What a fitter does with the top ring, as data: where it goes in turn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from foilstudy.base.ranges import require_count
from foilstudy.model.supports.attitude import Attitude

GAP_MIN = 0.2
"""Least distance of the rings anywhere on the rim, over the gap: nearer, elements fold flat."""
_RIM = np.linspace(0.0, 2 * np.pi, 73)[:-1]
_ROUNDING = 1e-9


@dataclass(frozen=True)
class Move:
    """Where the top ring goes next; what is None stays as it is.

    Attributes
    ----------
    shorten : float or None
        Share of the way that closes the gap: 1.25 is a quarter further.
    tilt, twist : float or None
        rad, see `Attitude`.
    shift : float or None
        m.
    cycles : int
        How often it goes there and back to where it was; with 0 it goes there and stays.
    release : bool
        The ring is let go instead, until nothing pushes it along the axis any more.
    """

    shorten: float | None = None
    tilt: float | None = None
    twist: float | None = None
    shift: float | None = None
    cycles: int = 0
    release: bool = False

    def __post_init__(self):
        require_count("number of cycles of a move", self.cycles, 0)


@dataclass(frozen=True)
class Pose:
    """Where the top ring is.

    Attributes
    ----------
    shorten : float
        Share of the way that closes the gap.
    attitude : Attitude
    """

    shorten: float = 0.0
    attitude: Attitude = field(default_factory=Attitude)

    def after(self, move: Move) -> Pose:
        """Where a move ends that goes there and stays."""
        named = {name: getattr(move, name) for name in ("tilt", "twist", "shift")}
        kept = {name: getattr(self.attitude, name) for name in named}
        attitude = Attitude(**{n: kept[n] if v is None else v for n, v in named.items()})
        return Pose(self.shorten if move.shorten is None else move.shorten, attitude)

    def rim(self, radius: float, height: float, gap: float) -> tuple[float, float]:
        """How near a point of the rim comes to the plane of the bottom ring, and how far at most
        it is from the point of that ring to which the foil leads, m.

        Parameters
        ----------
        radius, height, gap : float
            Of the rings, of the foil before it is crumpled, and between the rings in the end, m.
        """
        foot = radius * np.stack([np.cos(_RIM), np.sin(_RIM), 0 * _RIM])
        way = self.attitude.placed(foot)
        way[2] += height - self.shorten * (height - gap)
        return float(way[2].min()), float(np.linalg.norm(way - foot, axis=0).max())

    def beyond(self, radius: float, height: float, gap: float) -> str:
        """Why the rings cannot stand so, in words that follow a subject; empty if they can."""
        nearest, farthest = self.rim(radius, height, gap)
        if nearest < GAP_MIN * gap:
            return (
                f"brings the rings to {1e3 * nearest:.3g} mm from each other; keep them "
                f"{1e3 * GAP_MIN * gap:.3g} mm apart"
            )
        if farthest > height * (1 + _ROUNDING):
            return (
                f"pulls the rims {1e3 * farthest:.4g} mm apart, and the foil is "
                f"{1e3 * height:.4g} mm long; pull less"
            )
        return ""


IN_PLACE = Pose(1.0)
"""Where the ring is in the end."""


def poses(moves: Sequence[Move]) -> Iterator[tuple[int, Pose | None]]:
    """Where the ring comes to rest on the way, with the number of the move; None: it is let go.

    Where a ring that was let go has come to is not known here: what a later move leaves as it is
    stays as it was before.
    """
    here = Pose()
    for number, move in enumerate(moves):
        if move.release:
            yield number, None
            continue
        there = here.after(move)
        for _ in range(move.cycles):
            yield number, there
            yield number, here
        if not move.cycles:
            yield number, there
            here = there
