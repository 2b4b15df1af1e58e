"""What a benchmark returns: values on a sequence of meshes, held against a known one.

A `Benchmark` is what one job of ``snakemake verify`` computes: one problem with one element. It has
one `Checked` for every number that theory or a publication gives, and what is drawn of it:
`Curve` and `Picture`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

TOLERANCE = 0.01
"""Largest relative error asked of the finest mesh."""
RATE_MARGIN = 0.3
"""How far a fitted rate may stay behind the one of theory."""
_NOISE = 1e-9
"""Relative differences below this are rounding; they count neither for monotony nor for rates."""

_PICTURE_LINES = 120


@dataclass(frozen=True)
class Checked:
    """One number on a sequence of meshes beside its known value.

    Attributes
    ----------
    name : str
        What it is, in words: ``centre deflection``.
    reference : float
        Value of theory or publication.
    source : str
        Where `reference` comes from, in words fit for a table.
    side : str
        Along what the elements are counted: ``half circumference``.
    meshes : tuple of int
        Elements along that side, rising; at least two.
    values : tuple of float
        One per mesh.
    expected_rate : float or None
        Order in the element size that theory promises; None where it promises none.
    exact : bool
        Whether `reference` is exact to many digits, for the very model that is computed. The rate
        is then that of the error; otherwise that of the differences between the meshes.
    tolerance : float
        Largest accepted relative error on the finest mesh.
    monotone : bool
        Whether the values of the last three meshes must approach their limit from one side.
    family : str
        Exact quantities of one benchmark that name the same family share one order, that of the
        root mean square of their errors, which must fall. For spectra: where two sources of error
        have opposite signs, a single error passes through zero and shows no order.
    """

    name: str
    unit: str
    reference: float
    source: str
    side: str
    meshes: tuple[int, ...]
    values: tuple[float, ...]
    expected_rate: float | None = 2.0
    exact: bool = False
    tolerance: float = TOLERANCE
    monotone: bool = True
    family: str = ""

    def __post_init__(self):
        if len(self.meshes) != len(self.values) or len(self.meshes) < 2:
            raise ValueError(
                f"{self.name}: {len(self.meshes)} meshes and {len(self.values)} values; a quantity "
                "needs one value on each of at least two meshes"
            )

    @property
    def errors(self) -> np.ndarray:
        """Relative errors, shape (meshes,)."""
        return np.array(self.values) / self.reference - 1

    @property
    def rate(self) -> float:
        """Order of convergence on the last three meshes, NaN where they do not show one.

        The slope of log error against log element size if the reference is exact, else p of
        v = limit + c h^p (Richardson).
        """
        if self.exact:
            return _order(self.meshes, self.errors)
        if len(self.meshes) < 3:
            return np.nan
        size = 1 / np.array(self.meshes[-3:], float)
        first, second = -np.diff(self.values[-3:]) / abs(self.reference)
        if abs(second) < _NOISE or first * second <= 0:
            return np.nan

        def mismatch(p):
            h = (size / size[0]) ** p
            return (h[0] - h[1]) / (h[1] - h[2]) - first / second

        low, high = 0.05, 12.0
        if mismatch(low) * mismatch(high) > 0:
            return np.nan
        return float(brentq(mismatch, low, high))

    def problems(self) -> tuple[str, ...]:
        """One sentence for each demand that is not met; those on the family are not asked here."""
        found = []
        error = self.errors[-1]
        if not abs(error) <= self.tolerance:
            found.append(
                f"{self.name}: {100 * error:+.2f} % off on the finest mesh, "
                f"{100 * self.tolerance:g} % allowed"
            )
        if self.family:
            return tuple(found)
        steps = np.diff(self.values[-3:]) / abs(self.reference)
        steps = steps[np.abs(steps) > _NOISE]
        if self.monotone and (steps > 0).any() and (steps < 0).any():
            found.append(f"{self.name}: does not converge from one side")
        return (*found, *_rate_problems(self.name, self.rate, self.expected_rate))


def _order(meshes, errors) -> float:
    """Slope of log error against log element size on the last three meshes, NaN at rounding."""
    error = np.abs(errors[-3:])
    if error.min() < _NOISE:
        return np.nan
    return float(np.polyfit(-np.log(meshes[-3:]), np.log(error), 1)[0])


def _rate_problems(name: str, rate: float, expected: float | None) -> list[str]:
    if expected is None or rate >= expected - RATE_MARGIN:
        return []
    return [f"{name}: converges with order {rate:.2f}, theory says {expected:g}"]


@dataclass(frozen=True)
class Curve:
    """A line on a plot, with published or theoretical points as markers.

    Attributes
    ----------
    x, y : tuple of float
        Computed points.
    """

    label: str
    x: tuple[float, ...]
    y: tuple[float, ...]
    published_x: tuple[float, ...] = ()
    published_y: tuple[float, ...] = ()


@dataclass(frozen=True)
class Plot:
    """Curves on common axes, for example load against displacement."""

    x_label: str
    y_label: str
    curves: tuple[Curve, ...]


@dataclass(frozen=True)
class Picture:
    """A shape as a grid of surface points with a colour.

    Attributes
    ----------
    points : nested list of float, shape (3, rows, columns)
        As drawn: displacements already scaled, the seam of a closed sheet on both sides.
    colour : nested list of float, shape (rows, columns)
        Drawn on a diverging scale, symmetric about zero.
    """

    title: str
    points: list
    colour: list

    @classmethod
    def of(cls, title: str, points: np.ndarray, colour: np.ndarray) -> Picture:
        """From arrays, thinned and rounded to what a picture shows."""
        rows, columns = (_thinned(size) for size in colour.shape)
        points, colour = points[:, rows][:, :, columns], colour[rows][:, columns]
        span = np.ptp(points.reshape(3, -1), axis=1).max()
        rounded = np.round(points, 3 - int(np.floor(np.log10(span))))
        peak = np.abs(colour).max() or 1.0
        return cls(title, rounded.tolist(), np.round(colour / peak, 3).tolist())


def _thinned(size: int) -> np.ndarray:
    """Indices that keep both ends and at most `_PICTURE_LINES` lines."""
    return np.round(np.linspace(0, size - 1, min(size, _PICTURE_LINES))).astype(int)


@dataclass(frozen=True)
class Benchmark:
    """Result of one benchmark.

    Attributes
    ----------
    name : str
        Key in the registry and name of its files.
    title : str
        One line for headings.
    element : str
        Element under test.
    """

    name: str
    title: str
    element: str
    quantities: tuple[Checked, ...]
    plot: Plot | None = None
    pictures: tuple[Picture, ...] = ()

    def family_errors(self, family: str) -> np.ndarray:
        """Root mean square of the relative errors of a family on every mesh."""
        return np.sqrt(np.mean([q.errors**2 for q in self._members(family)], axis=0))

    def rate(self, quantity: Checked) -> float:
        """Order of convergence of a quantity, or of its family."""
        if not quantity.family:
            return quantity.rate
        return _order(quantity.meshes, self.family_errors(quantity.family))

    def problems(self) -> tuple[str, ...]:
        """One sentence for each demand that any quantity or family misses."""
        found = [problem for q in self.quantities for problem in q.problems()]
        for family in dict.fromkeys(q.family for q in self.quantities if q.family):
            first = self._members(family)[0]
            if (np.diff(self.family_errors(family)[-3:]) >= 0).any():
                found.append(f"{family}: the error does not fall from mesh to mesh")
            found += _rate_problems(family, self.rate(first), first.expected_rate)
        return tuple(f"{self.name}, {self.element}: {problem}" for problem in found)

    def _members(self, family: str) -> list[Checked]:
        return [q for q in self.quantities if q.family == family]
