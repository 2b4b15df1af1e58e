"""A strain sampling as arrays, in the form in which the general kernel reads it."""

from __future__ import annotations

import numpy as np

from foilstudy.model.shell.elements import sampled_kernel
from foilstudy.model.shell.elements.sampling import StrainSampling

_BASIS = 5
"""a_1, a_2, a_11, a_22, a_12."""


def basis_weights(at: np.ndarray, h1: float, h2: float) -> np.ndarray:
    """Weights of the nine control points in a_1, a_2, a_11, a_22, a_12, shape (points, 9, 5)."""

    def line(x, h):
        value = np.array([(1 - x) ** 2 / 2, 0.5 + x - x**2, x**2 / 2])
        slope = np.array([x - 1, 1 - 2 * x, x]) / h
        return value, slope, np.array([1.0, -2.0, 1.0]) / h**2

    weights = np.empty((len(at), 9, _BASIS))
    for p, (x, y) in enumerate(at):
        v1, s1, c1 = line(x, h1)
        v2, s2, c2 = line(y, h2)
        pairs = ((v2, s1), (s2, v1), (v2, c1), (c2, v1), (s2, s1))
        for q, (along, around) in enumerate(pairs):
            weights[p, :, q] = np.outer(along, around).ravel()
    return weights


def tables(sampling: StrainSampling, h1: float, h2: float) -> sampled_kernel.Tables:
    """A strain sampling as arrays for the kernels, on elements of h1 around and h2 along."""
    at = sorted({m[1:] for m in sampling.membrane} | {b[:2] for b in sampling.bending})
    place = {point: p for p, point in enumerate(at)}
    bending = np.array([place[b[:2]] for b in sampling.bending])
    pairs, factors = [], []
    for part, forms in ((0, sampling.forms), (2, sampling.control)):
        for k, a, b in zip(*np.nonzero(forms), strict=True):
            if a <= b:
                pairs.append((a, b, k, part))
                factors.append(forms[k, a, b])
    return sampled_kernel.Tables(
        weights=basis_weights(at, h1, h2),
        # a_1 and a_2 are enough where only membrane strain is sampled
        needs=np.where(np.isin(np.arange(len(at)), bending), _BASIS, 2),
        component=np.array([component for component, *_ in sampling.membrane]),
        position=np.array([place[m[1:]] for m in sampling.membrane]),
        pairs=np.array(pairs),
        pair_weight=np.array(factors),
        bending_position=bending,
        bending_weight=np.array([b[2] for b in sampling.bending]),
        fold=sampling.fold,
    )
