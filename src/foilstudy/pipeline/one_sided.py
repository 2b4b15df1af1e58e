"""Stiffness by small motions of the top ring, one way and the other, plastic flow following.

What has just yielded yields on at once where it is loaded further, and springs back where it is
not: the two secants of a virgin state differ. Shaken down they are one, the tangent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.ranges import require_number
from foilstudy.linalg import SolveError
from foilstudy.measure.stiffness.directional import DIRECTIONS, MOTIONS
from foilstudy.model.patch import RING_ROWS
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.solve.equilibrium.settle import minimised
from foilstudy.solve.problem import Problem, Telling

_TOP = slice(-RING_ROWS, None)
AMPLITUDE = 1 / 50
"""Default size of a motion, over the thickness: with a fifth the secants of a foil that has shaken
down still depart from its tangent by 2 to 4 %."""
_FLOOR = 0.05
"""Least stiffness by which a snap is judged, of the larger one of both directions: foil that stands
by its rings may have next to none in one."""


@dataclass(frozen=True, repr=False)
class OneSided:
    """Secants of the force on the top ring, all its other motions held, N/m.

    Attributes
    ----------
    direction : str
        Of `foilstudy.measure.stiffness.directional.DIRECTIONS`; a radial value is the mean of two.
    amplitude : float
        Of the motions, m.
    loading : float
        Axially with the rings pushed together; radially along x and y.
    unloading : float
        The other way.
    tangent : float
        At the state as it is.
    dissipated : tuple of float
        Work that plastic flow used up on the way there, loading and unloading, J.
    status, message : str
        ``converged``, or that of the first motion that did not settle, ``snapped`` where it led to
        another equilibrium; its secant is NaN.
    """

    direction: str
    amplitude: float
    loading: float
    unloading: float
    tangent: float
    dissipated: tuple[float, float]
    status: str
    message: str

    @property
    def asymmetry(self) -> float:
        """Largest departure of a secant from the tangent, over that."""
        return max(abs(each / self.tangent - 1) for each in (self.loading, self.unloading))

    def __repr__(self) -> str:
        return (
            f"<OneSided: {self.direction}, loading {self.loading:.4g}, unloading "
            f"{self.unloading:.4g}, tangent {self.tangent:.4g} N/m, {self.status}>"
        )


def one_sided(
    crumpled: Crumpled, direction: str = "axial", amplitude: float | None = None
) -> OneSided:
    """Push the top ring of a settled foil a little, either way.

    Parameters
    ----------
    crumpled : Crumpled
        At rest; it is left as it is.
    direction : str
    amplitude : float, optional
        m; a fiftieth of the thickness by default.

    Returns
    -------
    OneSided
        Never raises for a motion that does not settle: the status says so.

    Raises
    ------
    Refusal
        If there is no such direction, or the amplitude is not positive.
    SolveError
        If the tangent with held rings is singular.
    """
    if direction not in DIRECTIONS:
        raise Refusal(f"{direction!r} is no direction; use one of {', '.join(DIRECTIONS)}.")
    amplitude = AMPLITUDE * crumpled.foil.thickness if amplitude is None else amplitude
    require_number("amplitude of a motion", amplitude, "m", above=0)
    loads = -1.0 if direction == "axial" else 1.0
    tangents = crumpled.prestressed_stiffness()
    tangent = float(tangents[DIRECTIONS.index(direction)])
    scale = max(abs(tangent), _FLOOR * float(np.abs(tangents).max()))
    pushes = [
        [_pushed(crumpled, axis, sign * loads * amplitude, scale) for axis in MOTIONS[direction]]
        for sign in (1.0, -1.0)
    ]
    failed = [push for way in pushes for push in way if push.status != "converged"]
    worst = failed[0] if failed else pushes[0][0]
    return OneSided(
        direction,
        amplitude,
        *(float(np.mean([push.secant for push in way])) for way in pushes),
        tangent,
        tuple(float(np.mean([push.dissipated for push in way])) for way in pushes),
        worst.status,
        worst.message,
    )


@dataclass(frozen=True)
class _Push:
    secant: float
    dissipated: float
    status: str
    message: str

    @classmethod
    def failed(cls, status: str, message: str) -> Self:
        return cls(np.nan, np.nan, status, message)


def _pushed(crumpled: Crumpled, axis: int, motion: float, scale: float) -> _Push:
    """The ring moved along one axis, the motion first spread over the height."""
    problem, points = crumpled.problem(), crumpled.points.copy()
    force, spent = ring_force(problem, points)[axis], dissipated_work(problem)
    stored = problem.value(points) + problem.spent(problem.state)
    rows = points[2].mean(axis=1)
    share = np.clip(rows / rows[_TOP].mean(), 0.0, 1.0)
    share[:RING_ROWS], share[_TOP] = 0.0, 1.0
    points[axis] += motion * share[:, None]
    settling = crumpled.method.path.settling
    if not np.isfinite(problem.value(points)):
        return _Push.failed("failed", "parts of the foil would cross on the way")
    try:
        points, found = minimised(problem, points, settling, settling.hessians_last)
        problem.commit(points)
    except SolveError as error:
        return _Push.failed("failed", str(error))
    if found.status != "converged":
        return _Push.failed(found.status, found.message)
    after = ring_force(problem, points)[axis]
    gained = problem.value(points) + problem.spent(problem.state) - stored
    if snapped(force, after, motion, gained, scale):
        return _Push.failed("snapped", "the foil snapped to another equilibrium on the way")
    secant = float((after - force) / motion)
    return _Push(secant, dissipated_work(problem) - spent, found.status, found.message)


def snapped(before: float, after: float, motion: float, gained: float, scale: float) -> bool:
    """Whether a foil let go more energy on the way than the motion stores.

    Between two forces on a straight line the foil gains the mean force times the motion. Where it
    softens on the way it gains more. Where it stiffens it gains less, but never by as much as its
    secant stores; a snap to another equilibrium knows no such bound.

    Parameters
    ----------
    before, after : float
        Force on the ring, N.
    motion : float
        m.
    gained : float
        Energy of the foil and what it has used up, J.
    scale : float
        Least stiffness to judge by, N/m.
    """
    secant = (after - before) / motion
    lacking = 0.5 * (before + after) * motion - gained
    return bool(lacking > 0.5 * max(scale, secant) * motion**2)


def ring_force(problem: Problem, points: np.ndarray) -> np.ndarray:
    """What holds the top ring in its place, shape (3,), N."""
    out = np.empty_like(points)
    problem.force(points, out)
    return out[:, _TOP].sum(axis=(1, 2))


def dissipated_work(problem: Problem) -> float:
    """What plastic flow has used up until now, J; nothing where there is none."""
    pairs = zip(problem.terms, problem.state, strict=True)
    told = [t.numbers(s) for t, s in pairs if isinstance(t, Telling) and s is not None]
    return sum((each.get("dissipated_work", 0.0) for each in told), start=0.0)
