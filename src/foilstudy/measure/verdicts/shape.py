"""What a shape tells of how it came about: folded as a whole, or alternating with the mesh."""

from __future__ import annotations

import numpy as np

BROAD_WAVES = 1
"""Waves around up to which a displacement moves the cylinder as a whole: bulge and sway."""

_ROUNDING = 1e-9
"""Displacement of a perfect cylinder, over its radius."""

SMALLEST_ALTERNATION = 0.02
"""Twist of an element, relative to its size, below which its direction says nothing."""


def broad_wave_share(surface: np.ndarray) -> float:
    """Share of the radial displacement that bulges or sways the cylinder as a whole.

    A network of ridges has many waves around, wherever it is cut. A cylinder that has folded
    globally goes in and out alike all around (concertina, pleat) or to one side (kink).

    Parameters
    ----------
    surface : ndarray, shape (3, rows, columns)
        Points at the knots, periodic in the columns, about the axis z, m. The rings, its first and
        last row, have the radius of the cylinder.

    Returns
    -------
    float
        Mean square of the waves 0 and 1 around over that of all; NaN of a perfect cylinder.
    """
    return wave_share(surface, BROAD_WAVES)


def wave_share(surface: np.ndarray, most: int) -> float:
    """Share of the radial displacement that has at most so many waves around.

    With none it is that of the axisymmetric part; see `broad_wave_share`.
    """
    displacement, ring = _radial(surface)
    power = np.abs(np.fft.rfft(displacement, axis=1)) ** 2
    last = (
        None if displacement.shape[1] % 2 else -1
    )  # the shortest wave of an even number stands alone
    power[:, 1:last] *= 2
    total = power.sum()
    if not total > (_ROUNDING * ring * power.size) ** 2:
        return np.nan
    return float(power[:, : most + 1].sum() / total)


def calmer_half(surface: np.ndarray) -> float:
    """How much less the calmer half of the height is displaced than the other one.

    A fold that runs around beside one ring takes all of the overlength and leaves the rest of the
    cylinder as it was.

    Parameters
    ----------
    surface : ndarray, shape (3, rows, columns)
        See `broad_wave_share`.

    Returns
    -------
    float
        Root mean square radial displacement of that half over that of the other, at most 1; NaN of
        a perfect cylinder.
    """
    displacement, ring = _radial(surface)
    half = len(displacement) // 2
    lower, upper = (
        np.sqrt(np.mean(part**2)) for part in (displacement[:half], displacement[-half:])
    )
    if not max(lower, upper) > _ROUNDING * ring:
        return np.nan
    return float(min(lower, upper) / max(lower, upper))


def _radial(surface: np.ndarray) -> tuple[np.ndarray, float]:
    """Displacement from the radius of the rings, and that radius, m."""
    radius = np.hypot(surface[0], surface[1])
    ring = float(0.5 * (radius[0].mean() + radius[-1].mean()))
    return radius - ring, ring


def alternation(displacement: np.ndarray) -> float:
    """How much the twist of the elements goes up and down from one element to the next.

    The twist of an element is the mixed second difference of its corners. In a resolved shape that
    of neighbours is alike; where a sheet hourglasses, it has the other sign, along and around.

    Parameters
    ----------
    displacement : ndarray, shape (3, rows, columns)
        Of the control points, in lengths of an element; periodic in the columns.

    Returns
    -------
    float
        From -1 (neighbours alike) to 1 (the opposite of each other), the smaller of the two
        directions; NaN where elements are not twisted.
    """
    closed = np.concatenate([displacement, displacement[:, :, :2]], axis=2)
    rising = np.diff(closed, axis=2)
    twist = np.diff(rising, axis=1)
    own = twist[:, :, :-1]
    if not np.sum(own**2) > SMALLEST_ALTERNATION**2 * own[0].size:
        return np.nan
    around = _correlation(own, twist[:, :, 1:])
    along = _correlation(own[:, 1:], own[:, :-1])
    return float(-max(around, along))


def hidden_energy(seen: float, whole: float, size: float, thickness: float) -> float:
    """How much energy a shape has that its elements do not see.

    Fully integrated elements see every strain within an element, those of hourglasses, too; of a
    fold they see a membrane strain that goes with the square of the element size, the bending with
    that of the thickness. So the ratio of the two energies over that of the squares tells an
    hourglass from a sharp fold, on meshes that resolve it and on those that do not.

    Parameters
    ----------
    seen, whole : float
        Membrane and bending energy of the shape, by its own elements and by fully integrated ones,
        J.
    size, thickness : float
        m.

    Returns
    -------
    float
        NaN where nothing is strained.
    """
    return whole / seen * (thickness / size) ** 2 if seen > 0 else np.nan


def _correlation(first: np.ndarray, second: np.ndarray) -> float:
    return np.sum(first * second) / np.sqrt(np.sum(first**2) * np.sum(second**2))
