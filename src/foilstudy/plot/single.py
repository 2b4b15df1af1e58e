"""One crumpled shape in one picture."""

from __future__ import annotations

import numpy as np

from foilstudy.plot.crumples import Surface
from foilstudy.plot.render import View, render
from foilstudy.plot.style import new_figure

_INCHES, _PIXELS = 4.0, 800


def draw_shape(points: np.ndarray, radius: float, title: str, ax=None):
    """Shaded picture of a surface, coloured by radial displacement.

    Parameters
    ----------
    points : ndarray, shape (3, rows, columns)
        Control points, m.
    radius : float
        Of the uncrumpled cylinder, m.
    title : str
    ax : matplotlib.axes.Axes, optional
        Of a new figure if left out.

    Returns
    -------
    matplotlib.axes.Axes
    """
    extent = 1e3 * max(np.ptp(points[0]), np.ptp(points[1]), np.ptp(points[2]))
    moved = np.abs(np.hypot(points[0], points[1]) - radius).max()
    scale = max(1e3 * moved, 1e-3)
    view = View(pixel_mm=extent / _PIXELS, colour_scale_mm=scale)
    picture = render(Surface(points, radius), view)
    if ax is None:
        ax = new_figure(_INCHES, _INCHES).subplots()
    ax.imshow(picture.rgba, extent=picture.extent_mm)
    ax.set_title(title.replace(", ", "\n", 1), fontsize=9)
    ax.set_xlabel(f"mm; colour: radial displacement to ±{scale:.2g} mm")
    return ax
