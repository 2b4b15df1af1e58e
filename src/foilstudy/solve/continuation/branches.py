"""Leaving a path at a bifurcation, along the lowest mode of its tangent."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from scipy.sparse.linalg import ArpackError, LinearOperator, eigsh

from foilstudy.solve.continuation.constraints import Increment, Metric, on_plane
from foilstudy.solve.continuation.corrector import Correction, correct
from foilstudy.solve.continuation.linearised import StepFailed, Tangent, Workshop
from foilstudy.solve.continuation.place import Place

_DENSE = 20
"""Unknowns up to which eigenvectors are sought by dense algebra."""
_ALONG = 0.5
"""Least cosine between the way to a branch and the mode."""


@dataclass(frozen=True)
class Switching:
    """How branches are looked for.

    Attributes
    ----------
    bisections : int
        Of the step in which a path loses stability.
    shares : tuple of float
        Distances from the path along the mode that are tried, over the length of that step.
    """

    bisections: int = 5
    shares: tuple[float, ...] = (0.25, 1.0, 0.05)


def singular_between(
    step: Callable[[Place, float], Place], here: Place, there: Place, length: float, bisections: int
) -> tuple[Place, Place]:
    """Places on both sides of where the number of negative eigenvalues grows, close together.

    Parameters
    ----------
    step : callable
        From a place and a length to the next place.
    here, there : Place
        Before and after.
    length : float
        Between them.
    bisections : int
    """
    for _ in range(bisections):
        length *= 0.5
        with suppress(StepFailed):
            middle = step(here, length)
            if middle.negative_eigenvalues > here.negative_eigenvalues:
                there = middle
            else:
                here = middle
    return here, there


def unstable_mode(tangent: Tangent) -> np.ndarray:
    """Eigenvector of the negative eigenvalue nearest to zero, its root mean square 1.

    Not simply of the one nearest to zero: beside a mode of short waves that is about to turn
    unstable, a smooth one that never will may be the softer.

    Raises
    ------
    StepFailed
        If it is not found.
    """
    size = tangent.velocity.size
    if size < _DENSE:
        values, vectors = np.linalg.eigh(tangent.matrix.toarray())
        mode = vectors[:, tangent.negative_eigenvalues - 1]
    else:
        inverse = LinearOperator((size, size), matvec=tangent.factor.solve, dtype=float)
        start = np.cos(np.arange(size, dtype=float))  # a fixed one gives the same bits
        try:
            values, vectors = eigsh(
                tangent.matrix, 1, sigma=0.0, which="SA", OPinv=inverse, v0=start, tol=1e-6
            )
        except ArpackError as error:
            raise StepFailed(f"the unstable mode was not found ({error})") from error
        if values[0] >= 0:
            raise StepFailed("the unstable mode was not found")
        mode = vectors[:, 0]
    return mode * np.sqrt(size / (mode @ mode))


def branch_off(
    workshop: Workshop,
    bracket: tuple[Place, Place],
    length: float,
    switching: Switching,
    correction: Correction,
) -> Place | None:
    """The first place on the branch that leaves between two places, None where none is found.

    The equilibrium at a distance along the mode, the factor free. Of the two sides the one with
    fewer negative eigenvalues is taken, the first where they are alike.

    Parameters
    ----------
    workshop : Workshop
    bracket : tuple of Place
        See `singular_between`.
    length : float
        Root mean square of the unknowns in the step in which stability was lost.
    switching : Switching
    correction : Correction
    """
    place, beyond = bracket
    try:
        mode = Increment(unstable_mode(beyond.tangent), 0.0)
    except StepFailed:
        return None
    for share in switching.shares:
        found = []
        for side in (1.0, -1.0):
            normal = mode.times(side)
            plane = on_plane(normal, share * length, Metric(0.0))
            with suppress(StepFailed):
                off = correct(workshop, place.base, normal.times(share * length), plane, correction)
                made = place.to(off)
                if normal.q @ made.q < _ALONG * np.linalg.norm(normal.q) * np.linalg.norm(made.q):
                    continue  # far along the old path, which is not quite normal to the mode
                found.append(Place(off, workshop.tangent(off.q, off.factor), made))
        if found:
            return min(found, key=lambda each: each.negative_eigenvalues)
    return None
