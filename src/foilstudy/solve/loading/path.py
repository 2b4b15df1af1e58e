"""Equilibria of a sheet under a growing load."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from foilstudy.solve.equilibrium.newton import NewtonOptions, minimise
from foilstudy.solve.loading.growing_load import GrowingLoad
from foilstudy.solve.loading.loaded_sheet import LoadedSheet

_RESIDUAL = 1e-8
_ITERATIONS = 60
_HALVINGS = 6


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A stable equilibrium on a path.

    Attributes
    ----------
    factor : float
        Load factor.
    points : ndarray, shape (3, rows, columns)
        Control points, m.
    residual : float
        Free force norm relative to the norm of all internal forces, or to what would let
        rounding pass, whichever is larger.
    iterations : int
        Hessians formed by the search, failed attempts included.
    """

    factor: float
    points: np.ndarray
    residual: float
    iterations: int


@dataclass(frozen=True, eq=False)
class LoadPath:
    """What following the load gave.

    Attributes
    ----------
    status : str
        ``converged`` if the last load factor was reached, else ``not_converged``.
    message : str
        One sentence.
    equilibria : tuple of Equilibrium
        At the factors asked for, and at those put in between; stable, every one.
    """

    status: str
    message: str
    equilibria: tuple[Equilibrium, ...]


def follow_load(
    loaded: LoadedSheet, factors: Iterable[float], start: np.ndarray | None = None
) -> LoadPath:
    """Stable equilibria at growing load factors, each sought from the one before.

    A step that fails is halved, six times at most on the way to a factor. At a limit point the
    path does not turn back: the search falls to another stable equilibrium at the same load, as
    the structure would.

    Parameters
    ----------
    loaded : LoadedSheet
        Its own factor does not matter.
    factors : iterable of float
        Load factors to stop at, in order.
    start : ndarray, shape (3, rows, columns), optional
        Control points to begin with, m; the base shape by default.
    """
    if free := loaded.rigid_freedoms():
        why = f"no equilibrium beyond load factor 0: the supports leave {free} rigid motions free"
        return LoadPath("not_converged", why, ())
    unknowns = np.zeros(loaded.constraints.free)
    if start is not None:
        unknowns = loaded.unknowns(start)
    reached, found, failed = 0.0, [], 0
    growing = GrowingLoad(loaded, _RESIDUAL)
    for target in factors:
        step = target - reached
        halvings = 0
        while reached != target:
            aim = target if abs(step) >= abs(target - reached) else reached + step
            problem = loaded.at(aim)
            options = NewtonOptions(_RESIDUAL, lambda q: growing.scale(q, 0.0), _ITERATIONS)
            result = minimise(problem, unknowns, options)
            if result.status != "converged":
                failed += result.iterations
                step /= 2
                halvings += 1
                if halvings > _HALVINGS:
                    why = f"no equilibrium beyond load factor {reached:g}: {result.message}"
                    return LoadPath("not_converged", why, tuple(found))
                continue
            unknowns, reached = result.q, aim
            found.append(
                Equilibrium(
                    aim, problem.points(unknowns), result.residual, result.iterations + failed
                )
            )
            failed = 0
    return LoadPath("converged", f"reached load factor {reached:g}", tuple(found))
