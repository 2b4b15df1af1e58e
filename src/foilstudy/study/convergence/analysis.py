"""Limits and orders from crumples on several meshes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar

ORDERS = (0.5, 4.0)
"""Range in which the order of a fit is sought; beyond it the sizes at hand cannot tell."""
_DRAWS = 500


@dataclass(frozen=True)
class MeshFit:
    """v(h) = limit (1 + (h / scale)^order), fitted to ensemble means.

    Attributes
    ----------
    limit, limit_error : float
        Value at element size zero and its standard error by parametric bootstrap.
    order, order_error : float
        The order is sought within `ORDERS`.
    coefficient : float
        v(h) - limit = coefficient h^order, with h in the unit of the sizes.
    """

    limit: float
    limit_error: float
    order: float
    order_error: float
    coefficient: float

    def __call__(self, size):
        return self.limit + self.coefficient * np.asarray(size, float) ** self.order


def means(ensemble: Mapping[float, np.ndarray]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Element sizes, ensemble means and their standard errors.

    The scatter between seeds relative to the mean is pooled over all sizes: of two or three seeds
    alone it would be known to nothing better than a factor of two.

    Raises
    ------
    ValueError
        If no size has more than one seed.
    """
    sizes = np.array(list(ensemble))
    counts = np.array([len(values) for values in ensemble.values()])
    mean = np.array([np.mean(values) for values in ensemble.values()])
    squares = sum(((v / np.mean(v) - 1) ** 2).sum() for v in ensemble.values())
    freedom = counts.sum() - len(counts)
    if freedom == 0:
        raise ValueError("the scatter between seeds needs two seeds on one mesh at least")
    scatter = np.sqrt(squares / freedom)
    return sizes, mean, scatter * np.abs(mean) / np.sqrt(counts)


def fit(ensemble: Mapping[float, np.ndarray], seed: int = 0) -> MeshFit:
    """Weighted least squares of a power of the element size plus a limit (Richardson's form).

    Parameters
    ----------
    ensemble : mapping of float to ndarray
        By element size, the values of the seeds; three sizes or more.
    seed : int
        Of the bootstrap.

    Raises
    ------
    ValueError
        With fewer than three sizes.
    """
    sizes, mean, error = means(ensemble)
    if sizes.size < 3:
        raise ValueError(f"three unknowns cannot be fitted to {sizes.size} element sizes")
    limit, coefficient, order = _fitted(sizes, mean, error)
    rng = np.random.default_rng(seed)
    draws = np.array([_fitted(sizes, rng.normal(mean, error), error)[::2] for _ in range(_DRAWS)])
    limit_error, order_error = draws.std(axis=0)
    return MeshFit(limit, float(limit_error), order, float(order_error), coefficient)


def _fitted(sizes, values, error) -> tuple[float, float, float]:
    """Limit, coefficient and order; for a given order the other two are linear."""

    def linear(order):
        design = np.stack([np.ones(sizes.size), sizes**order], axis=1) / error[:, None]
        solution, *_ = np.linalg.lstsq(design, values / error, rcond=None)
        return solution, float(((design @ solution - values / error) ** 2).sum())

    found = minimize_scalar(lambda p: linear(p)[1], bounds=ORDERS, method="bounded")
    (limit, coefficient), _ = linear(found.x)
    return float(limit), float(coefficient), float(found.x)


def slope(sizes, values) -> tuple[float, float]:
    """Exponent of a power law through all points and its standard error (NaN for two points)."""
    x, y = np.log(sizes), np.log(values)
    design = np.stack([np.ones(x.size), x], axis=1)
    solution, residual, *_ = np.linalg.lstsq(design, y, rcond=None)
    if x.size < 3:
        return float(solution[1]), np.nan
    variance = residual[0] / (x.size - 2) / ((x - x.mean()) ** 2).sum()
    return float(solution[1]), float(np.sqrt(variance))
