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


def before_singular(
    step: Callable[[Place, float], Place], here: Place, length: float, bisections: int
) -> Place:
    """The last place known before the number of negative eigenvalues changes.

    Parameters
    ----------
    step : callable
        From a place and a length to the next place.
    here : Place
        Before it changes.
    length : float
        From there to where it has changed.
    bisections : int
    """
    for _ in range(bisections):
        length *= 0.5
        with suppress(StepFailed):
            middle = step(here, length)
            if middle.negative_eigenvalues == here.negative_eigenvalues:
                here = middle
    return here


def lowest_mode(tangent: Tangent) -> np.ndarray:
    """Eigenvector of the eigenvalue nearest to zero, its root mean square 1.

    Raises
    ------
    StepFailed
        If it is not found.
    """
    size = tangent.velocity.size
    if size < 20:
        values, vectors = np.linalg.eigh(tangent.matrix.toarray())
        mode = vectors[:, np.argmin(np.abs(values))]
    else:
        inverse = LinearOperator((size, size), matvec=tangent.factor.solve, dtype=float)
        start = np.cos(np.arange(size, dtype=float))  # a fixed one gives the same bits
        try:
            mode = eigsh(tangent.matrix, 1, sigma=0.0, OPinv=inverse, v0=start, tol=1e-6)[1][:, 0]
        except ArpackError as error:
            raise StepFailed(f"the lowest mode was not found ({error})") from error
    return mode * np.sqrt(size / (mode @ mode))


def branch_off(
    workshop: Workshop, place: Place, length: float, switching: Switching, correction: Correction
) -> Place | None:
    """The first place on the branch that leaves near a place, None where none is found.

    The equilibrium at a distance along the mode, the factor free. Of the two sides the one with
    fewer negative eigenvalues is taken, the first where they are alike.
    """
    try:
        mode = Increment(lowest_mode(place.tangent), 0.0)
    except StepFailed:
        return None
    for share in switching.shares:
        found = []
        for side in (1.0, -1.0):
            normal = mode.times(side)
            plane = on_plane(normal, share * length, Metric(0.0))
            with suppress(StepFailed):
                off = correct(workshop, place.base, normal.times(share * length), plane, correction)
                tangent = workshop.tangent(off.q, off.factor)
                found.append(Place(off, tangent, place.to(off)))
        if found:
            return min(found, key=lambda each: each.negative_eigenvalues)
    return None
