"""Buckling loads of a sheet: the smallest further loads at which its tangent turns singular."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import ArpackError, LinearOperator, eigsh

from foilstudy.linalg import SolveError, factorise
from foilstudy.solve.loading.loaded_sheet import LoadedSheet

_STEP = 1e-3
"""Largest displacement of the differenced prestate, in element lengths."""
_NOTHING = 1e-12
"""Share of a load on free unknowns below which it is rounding."""
_RESIDUAL = 1e-6
_BRACKETINGS = 60
_CLUSTER = 1e-6
_FARTHEST = 1e6
"""Bounds of the search: relative width of a cluster of loads, largest load over the first try."""
_SPARE = 10
"""Modes that may lie below the shift in excess of those asked for."""


@dataclass(frozen=True, eq=False)
class BucklingModes:
    """Critical increments of the load factor and the shapes that they release.

    Attributes
    ----------
    factors : ndarray, shape (n,)
        Increments of the load factor, ascending, positive; none below the last one is missing.
    shapes : ndarray, shape (n, 3, rows, columns)
        Displacements of the control points, largest component 1.
    residuals : ndarray, shape (n,)
        |(K + factor K') phi| / |K phi|.
    prestate : ndarray, shape (3, rows, columns)
        Displacement per unit of load factor, m.
    """

    factors: np.ndarray
    shapes: np.ndarray
    residuals: np.ndarray
    prestate: np.ndarray


def buckling_modes(
    loaded: LoadedSheet, count: int, points: np.ndarray | None = None
) -> BucklingModes:
    """Smallest positive x with (K + x K') phi = 0.

    K is the tangent at the given equilibrium and K' its derivative along the displacement that a
    further load brings, K v = f: linear buckling about the stress-free shape, or about a deformed
    one. K' holds all of that derivative, the change of the shape as well as of the stress.

    Parameters
    ----------
    loaded : LoadedSheet
        Its factor is that of the load which acts at `points`.
    count : int
        Number of modes.
    points : ndarray, shape (3, rows, columns), optional
        Control points of an equilibrium, m; the stress-free shape by default.

    Raises
    ------
    ValueError
        If the given equilibrium is not stable, or if the supports bear all of the load.
    SolveError
        If the load does not buckle the sheet, or if the search does not converge.
    """
    q = np.zeros(loaded.constraints.free) if points is None else loaded.unknowns(points)
    tangent = loaded.hessian(q)
    factor = factorise(tangent)
    if factor.negative_eigenvalues:
        raise ValueError(
            f"the equilibrium has {factor.negative_eigenvalues} negative eigenvalues; buckling "
            "loads are counted from a stable one"
        )
    force = loaded.load.work_and_force(loaded.points(q))[1]
    load = loaded.constraints.reduced(force)
    if np.linalg.norm(load) <= _NOTHING * np.linalg.norm(force):
        raise ValueError("the load acts on held edges only: it brings no stress")
    velocity = factor.solve(load)
    rate = _tangent_rate(loaded, q, velocity)
    limit = _bracket(tangent, rate, count)
    factors, vectors = _modes(tangent, rate, limit, count)
    residuals = np.array(
        [
            np.linalg.norm(tangent @ v + x * (rate @ v)) / np.linalg.norm(tangent @ v)
            for x, v in zip(factors, vectors.T)
        ]
    )
    if residuals.max() > _RESIDUAL:
        raise SolveError(f"a buckling mode has the relative residual {residuals.max():.1e}")
    shapes = np.stack([loaded.constraints.displacement(v) for v in vectors.T])
    shapes /= np.abs(shapes).max(axis=(1, 2, 3), keepdims=True)
    return BucklingModes(factors, shapes, residuals, loaded.constraints.displacement(velocity))


def _tangent_rate(loaded: LoadedSheet, q: np.ndarray, velocity: np.ndarray) -> sparse.csr_matrix:
    """Derivative of the tangent by the load factor, by central difference.

    Along the motion, with the load that goes with it: a load that follows the shape has a tangent
    of its own.
    """
    patch = loaded.sheet.patch
    largest = np.abs(loaded.constraints.displacement(velocity)).max()
    step = _STEP * min(patch.size_around, patch.size_along) / largest
    ahead, behind = (
        loaded.at(loaded.factor + side * step).hessian(q + side * step * velocity)
        for side in (1, -1)
    )
    return ((ahead - behind) / (2 * step)).tocsr()


def _below(tangent, rate, limit: float) -> int:
    """Number of buckling loads below a positive limit, which the inertia of K + limit K' tells."""
    return factorise((tangent + limit * rate).tocsr()).negative_eigenvalues


def _bracket(tangent, rate, count: int) -> tuple[float, int]:
    """A load with at least `count` buckling loads below it and not many more; how many."""
    low, high = 0.0, np.inf
    trial = first = abs(tangent).sum() / abs(rate).sum()
    for _ in range(_BRACKETINGS):
        found = _below(tangent, rate, trial)
        if count <= found <= count + _SPARE:
            return trial, found
        if found < count:
            low = trial
        else:
            high = trial
        if high == np.inf:
            trial = 2 * low
            if trial > _FARTHEST * first:
                break
        elif low == 0:
            trial = high / 2
        else:
            trial = 0.5 * (low + high)
            if high - low < _CLUSTER * high:  # more than the spare ones fall together
                return high, _below(tangent, rate, high)
    raise SolveError(f"no {count} buckling loads below a load factor of {trial:.1e}")


def _modes(tangent, rate, limit: tuple[float, int], count: int):
    """The lowest `count` loads and vectors, out of all those below the limit."""
    shift, found = limit
    factor = factorise((tangent + shift * rate).tocsr())
    size = tangent.shape[0]
    inverse = LinearOperator((size, size), matvec=factor.solve, dtype=float)
    # in this mode ARPACK sees x/(x - shift), which is negative for 0 < x < shift only
    try:
        factors, vectors = eigsh(
            tangent, found, -rate, sigma=shift, which="SA", mode="buckling", OPinv=inverse,
            v0=np.cos(np.arange(size, dtype=float)), ncv=min(size, 2 * found + 40),
        )  # fmt: skip
    except ArpackError as error:
        raise SolveError(f"the search for buckling modes failed: {error}") from error
    order = np.argsort(factors)[:count]
    if factors[order].min() <= 0 or factors.max() >= shift:
        raise SolveError("the search for buckling modes left the range in which they were counted")
    return factors[order], vectors[:, order]
