"""The end rows of a grid as circles, and the frame in which they stand on the axis z."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Circle:
    """Circle fitted to the points of a row.

    Attributes
    ----------
    centre, normal : ndarray, shape (3,)
        m; unit vector.
    radius : float
        m.
    deviation : float
        Largest distance of a point from the circle, m.
    """

    centre: np.ndarray
    normal: np.ndarray
    radius: float
    deviation: float


def fitted_circle(points: np.ndarray) -> Circle:
    """Plane by least squares, then the circle in it (I. Kasa, IEEE Trans. Instrum. Meas. 25, 1976).

    Parameters
    ----------
    points : ndarray, shape (points, 3)
        m.
    """
    middle = points.mean(axis=0)
    arms = points - middle
    axes = np.linalg.svd(arms, full_matrices=False)[2]
    plane = arms @ axes[:2].T
    system = np.column_stack([2 * plane, np.ones(len(plane))])
    u, v, constant = np.linalg.lstsq(system, (plane**2).sum(axis=1), rcond=None)[0]
    radius = float(np.sqrt(max(constant + u**2 + v**2, 0.0)))
    radial = np.hypot(plane[:, 0] - u, plane[:, 1] - v) - radius
    deviation = float(np.hypot(radial, arms @ axes[2]).max())
    return Circle(middle + u * axes[0] + v * axes[1], axes[2], radius, deviation)


def on_axis(points: np.ndarray, bottom: Circle, top: Circle) -> np.ndarray:
    """The grid turned and moved until the first ring lies in z = 0 around the origin, the last
    above.

    Parameters
    ----------
    points : ndarray, shape (rows, columns, 3)
    bottom, top : Circle
        Of the first and of the last row.
    """
    up = bottom.normal if bottom.normal @ (top.centre - bottom.centre) > 0 else -bottom.normal
    # a frame that stands on the axis z already is left as it is, also around that axis
    first = np.array([1.0, 0.0, 0.0])
    if abs(first @ up) > 0.9:
        first = np.array([0.0, 1.0, 0.0])
    first = first - (first @ up) * up
    first /= np.linalg.norm(first)
    frame = np.array([first, np.cross(up, first), up])
    return (points - bottom.centre) @ frame.T
