"""Where an element samples its strains: the strain and quadrature variants, as data.

An element's membrane energy is a quadratic form of membrane strain components taken at sample
points, its bending energy a weighted sum over bending points. Which points, and which components
are paired, is all that distinguishes the variants below; one kernel (`sampled`) evaluates them.
Sample points are in element coordinates from 0 to 1, around and along.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LAW_PAIRS = ((0, 0), (1, 1), (0, 1), (0, 2), (1, 2), (2, 2))
"""Strain components (11, 22, 12) that each of the six coefficients of the law pairs."""


@dataclass(frozen=True)
class StrainSampling:
    """Sample points of one element and how its energy is made of them.

    Attributes
    ----------
    name : str
    membrane : tuple of (component, around, along)
        Membrane strain samples e; component 0, 1, 2 for 11, 22 and 2 e_12.
    forms, control : ndarray, shape (6, samples, samples)
        Symmetric matrix of each coefficient of the law: the membrane energy of an element is
        1/2 sum_k law_k e.forms_k.e, the energy that only holds the checkerboard likewise.
    bending : tuple of (around, along, weight)
    fold : float
        0: bending strain B_ab - a_ab.a_3; 1: the second term times J_0/J, J = |a_1 x a_2|, which
        grows without bound when an element folds flat; between them the mixture.
    """

    name: str
    membrane: tuple[tuple[int, float, float], ...]
    forms: np.ndarray
    control: np.ndarray
    bending: tuple[tuple[float, float, float], ...]
    fold: float = 0.0


def _full_law_at(points, weights):
    """Samples and forms of the full law at every one of the given points."""
    membrane = tuple((c, *point) for point in points for c in range(3))
    forms = np.zeros((6, len(membrane), len(membrane)))
    for q, weight in enumerate(weights):
        for k, (a, b) in enumerate(LAW_PAIRS):
            forms[k, 3 * q + a, 3 * q + b] = weight
            forms[k, 3 * q + b, 3 * q + a] = weight
    return membrane, forms


def _gauss_points(number: int):
    """Tensor Gauss points and weights on the unit square."""
    x, w = np.polynomial.legendre.leggauss(number)
    x, w = 0.5 * (x + 1), 0.5 * w
    return [(a, b) for b in x for a in x], [u * v for v in w for u in w]


def _bending_at(number: int):
    at, weights = _gauss_points(number)
    return tuple((*point, weight) for point, weight in zip(at, weights, strict=True))


def gauss(number: int) -> StrainSampling:
    """Full law and bending at number x number Gauss points."""
    membrane, forms = _full_law_at(*_gauss_points(number))
    return StrainSampling(
        f"Gauss {number}x{number}", membrane, forms, np.zeros_like(forms), _bending_at(number)
    )


def patch_wise() -> StrainSampling:
    """Full law and bending at one of the four Gauss points, the same in every element.

    On a closed uniform row this is the Gauss rule of the C0 quadratic splines, one point per
    element, to which the patch-wise reduced rules tend inside a patch (Adam, Hughes, Bouabdallah,
    Zarroug and Maitournam, Comput. Methods Appl. Mech. Engrg. 284, 2015). At open edges it
    lacks their end corrections.
    """
    at = 0.5 - 0.5 / np.sqrt(3.0)
    membrane, forms = _full_law_at([(at, at)], [1.0])
    return StrainSampling("patch-wise", membrane, forms, np.zeros_like(forms), ((at, at, 1.0),))


def one_point(stabilisation: float, fold: float = 0.0) -> StrainSampling:
    """Middle of the element, held by the first-order variation of the membrane strain times chi."""
    at = [(0.5, 0.5), (0.0, 0.5), (1.0, 0.5), (0.5, 0.0), (0.5, 1.0)]
    membrane, forms = _full_law_at(at, [1.0, 0.0, 0.0, 0.0, 0.0])
    difference = np.zeros((5, 5))
    difference[1:3, 1:3] = difference[3:5, 3:5] = [[1.0, -1.0], [-1.0, 1.0]]
    control = np.zeros_like(forms)
    for k, pair in enumerate(LAW_PAIRS):
        control[k] = stabilisation / 12 * np.kron(difference, _unit(pair))
    return StrainSampling(
        f"one point, chi {stabilisation:g}", membrane, forms, control, _bending_at(1), fold
    )


def _unit(pair: tuple[int, int]) -> np.ndarray:
    """3 x 3 matrix that is one where the law pairs the two components."""
    unit = np.zeros((3, 3))
    unit[pair] = unit[pair[::-1]] = 1.0
    return unit


def staggered(fold: float = 0.0) -> StrainSampling:
    """11 at the knots around, 22 at the knots along, shear at the corners.

    The pairs of unlike components (Poisson's ratio, skewed coordinates) use the means.
    """
    membrane = (*_EDGES, *((2, a, b) for b in (0.0, 1.0) for a in (0.0, 1.0)))
    component = np.array([c for c, *_ in membrane])
    forms = np.zeros((6, len(membrane), len(membrane)))
    for k, (a, b) in enumerate(LAW_PAIRS):
        mean_a = (component == a) / np.sum(component == a)
        mean_b = (component == b) / np.sum(component == b)
        pair = np.outer(mean_a, mean_b)
        forms[k] = np.diag(mean_a) if a == b else pair + pair.T
    return StrainSampling(
        f"staggered, fold {fold:.2g}",
        membrane,
        forms,
        np.zeros_like(forms),
        _bending_at(1),
        fold,
    )


_CORNERS = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)]
_EDGES = ((0, 0.0, 0.5), (0, 1.0, 0.5), (1, 0.5, 0.0), (1, 0.5, 1.0))


def continuous_assumed_strain(fold: float = 0.0) -> StrainSampling:
    """CAS: all components at the corners, bilinear between them, 2 x 2 points for bending.

    Casquero and Mathews, Comput. Methods Appl. Mech. Engrg. 417 (2023), for shells.
    """
    line = np.array([[2.0, 1.0], [1.0, 2.0]]) / 6
    forms = np.array([np.kron(np.kron(line, line), _unit(pair)) for pair in LAW_PAIRS])
    membrane, _ = _full_law_at(_CORNERS, [0.25] * 4)
    return StrainSampling(
        f"CAS, fold {fold:.2g}", membrane, forms, np.zeros_like(forms), _bending_at(2), fold
    )


def corner(share: float, fold: float = 1.0, bending_points: int = 1) -> StrainSampling:
    """All components at the corners, each weighted a quarter: folds do not stretch a corner.

    The in-plane checkerboard that corners do not see is held by a share of the law on the
    deviation of 11 in the middle of an edge along from the mean of its two ends, and of 22 in the
    middle of an edge around likewise; both vanish for every linear strain.
    """
    ends = (0.0, 1.0)
    corners, forms = _full_law_at(_CORNERS, [0.25] * 4)
    membrane = corners + _EDGES
    place = {sample: index for index, sample in enumerate(membrane)}
    shape = (6, len(membrane), len(membrane))
    grown, control = np.zeros(shape), np.zeros(shape)
    grown[:, : len(corners), : len(corners)] = forms
    for component, x, y in _EDGES:
        deviation = np.zeros(len(membrane))
        deviation[place[component, x, y]] = 1.0
        for end in ends:
            at = (x, end) if component == 0 else (end, y)
            deviation[place[component, *at]] = -0.5
        control[component] += 0.5 * share * np.outer(deviation, deviation)
    return StrainSampling(
        f"corner, fold {fold:.2g}", membrane, grown, control, _bending_at(bending_points), fold
    )
