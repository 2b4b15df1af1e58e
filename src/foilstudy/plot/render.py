"""Shaded orthographic pictures of a crumpled surface, drawn point by point with a depth buffer."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from scipy.ndimage import gaussian_filter

from foilstudy.model.patch import knot_points, refine
from foilstudy.plot.crumples import Surface

COLOUR_MAP = "coolwarm"
"""Diverging map with an even grey middle, made for shaded surfaces (Moreland 2009)."""

_SUPERSAMPLING = 2
_LIGHT = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])


@dataclass(frozen=True)
class View:
    """Orthographic view.

    Attributes
    ----------
    elevation_deg, azimuth_deg : float
        Where the viewer stands.
    pixel_mm : float
        Size of one pixel of the picture.
    colour_scale_mm : float
        Radial displacement at the ends of the colour map.
    """

    elevation_deg: float = 19.0
    azimuth_deg: float = -60.0
    pixel_mm: float = 0.5
    colour_scale_mm: float = 24.0

    def axes(self) -> np.ndarray:
        """Rows: unit vectors to the right, up, and towards the viewer, shape (3, 3)."""
        e, a = np.radians([self.elevation_deg, self.azimuth_deg])
        right = [-np.sin(a), np.cos(a), 0.0]
        up = [-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e)]
        towards = [np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)]
        return np.array([right, up, towards])


@dataclass(frozen=True)
class Picture:
    """A rendered surface.

    Attributes
    ----------
    rgba : ndarray, shape (height, width, 4)
        First row at the top.
    extent_mm : tuple
        Left, right, bottom, top; the axis of the cylinder is at the horizontal zero.
    """

    rgba: np.ndarray
    extent_mm: tuple[float, float, float, float]


def render(shape: Surface, view: View) -> Picture:
    """Return the shaded picture of a surface, coloured by radial displacement.

    Parameters
    ----------
    shape : Surface
    """
    pixel = view.pixel_mm * 1e-3 / _SUPERSAMPLING
    points = _dense_points(shape.control_points, 1.5 * view.pixel_mm * 1e-3)
    frame = view.axes()
    screen = np.einsum("ij,jrc->irc", frame, points) / pixel
    depth, nearest, left, bottom = _splat(screen)
    displacement = np.hypot(points[0], points[1]) - shape.radius
    normals = np.einsum("ij,jrc->irc", frame, _unit_normals(points))
    colour = _shade(
        depth * pixel, normals.reshape(3, -1)[:, nearest], displacement.ravel()[nearest], view
    )
    height, width = depth.shape
    extent = np.array([left, left + width, bottom, bottom + height]) * pixel * 1e3
    return Picture(_downsample(colour)[::-1], tuple(map(float, extent)))


def _dense_points(control_points: np.ndarray, spacing: float) -> np.ndarray:
    """Surface points closer than `spacing` (m), by exact refinement."""
    for _ in range(max(0, int(np.ceil(np.log2(_typical_spacing(control_points) / spacing))))):
        control_points = refine(control_points)
    return knot_points(control_points)


def _typical_spacing(points: np.ndarray) -> float:
    """A distance that nearly all neighbouring points keep within."""
    return max(
        np.percentile(np.linalg.norm(np.diff(points, axis=axis), axis=0), 95) for axis in (1, 2)
    )


def _splat(screen: np.ndarray) -> tuple[np.ndarray, np.ndarray, int, int]:
    """Draw a surface into a depth buffer.

    Every quadrilateral between neighbouring points is covered with bilinearly interpolated
    points, closer together than a pixel.

    Parameters
    ----------
    screen : ndarray, shape (3, rows, columns)
        Right, up and towards the viewer in pixels; periodic in its last axis.

    Returns
    -------
    depth : ndarray, shape (height, width)
        ``-inf`` where there is no surface; first row at the bottom.
    nearest : ndarray of int, same shape
        Flat index of the surface point seen.
    left, bottom : int
        Pixel coordinates of the corner; all sizes are multiples of the supersampling.
    """
    s = _SUPERSAMPLING
    low = np.floor(screen[:2].min(axis=(1, 2)) / s).astype(int) - 2
    high = np.ceil(screen[:2].max(axis=(1, 2)) / s).astype(int) + 2
    (width, height), (left, bottom) = (high - low) * s, low * s
    depth = np.full(width * height, -np.inf, dtype=np.float32)
    nearest = np.zeros(width * height, dtype=np.int64)

    _, rows, columns = screen.shape
    shifted = (screen - np.array([left, bottom, 0.0])[:, None, None]).astype(np.float32)
    closed = np.concatenate([shifted, shifted[:, :, :1]], axis=2)
    corner = closed[:, :-1, :-1]
    along = closed[:, 1:, :-1] - corner
    around = closed[:, :-1, 1:] - corner
    twist = closed[:, 1:, 1:] - corner - along - around
    label = np.arange((rows - 1) * columns)
    fractions = np.arange(n := int(np.ceil(1.25 * _typical_spacing(screen)))) / n
    for a in fractions.astype(np.float32):
        edge, step = corner + a * along, around + a * twist
        for b in fractions.astype(np.float32):
            x, y, z = (edge + b * step).reshape(3, -1)
            index = y.astype(np.int64) * width + x.astype(np.int64)
            np.maximum.at(depth, index, z)
            front = z >= depth[index]
            nearest[index[front]] = label[front]
    shape = (height, width)
    return depth.reshape(shape), nearest.reshape(shape), int(left), int(bottom)


def _unit_normals(points: np.ndarray) -> np.ndarray:
    """Outward unit normals of a surface that is periodic in its last axis."""
    around = np.roll(points, -1, axis=2) - np.roll(points, 1, axis=2)
    along = np.gradient(points, axis=1)
    normal = np.cross(around, along, axis=0)
    return normal / np.maximum(np.linalg.norm(normal, axis=0), 1e-300)


def _shade(depth, normals, displacement, view: View) -> np.ndarray:
    """Colour every pixel; normals in the frame of the view. Returns premultiplied RGBA."""
    covered = np.isfinite(depth)
    inside = normals[2] < 0
    facing = np.where(inside, -normals, normals)
    diffuse = np.clip(np.tensordot(_LIGHT, facing, axes=1), 0, 1)
    half = _LIGHT + np.array([0.0, 0.0, 1.0])
    half /= np.linalg.norm(half)
    gloss = np.clip(np.tensordot(half, facing, axes=1), 0, 1) ** 30
    light = (0.46 + 0.64 * diffuse) * (1 - 0.6 * _recession(depth, covered, view))
    light = np.where(inside, 0.72 * light, light)
    scale = view.colour_scale_mm * 1e-3
    base = mpl.colormaps[COLOUR_MAP](0.5 + 0.5 * np.clip(displacement / scale, -1, 1))[..., :3]
    colour = np.clip(base * light[..., None] + 0.18 * gloss[..., None], 0, 1)
    return np.dstack([colour * covered[..., None], covered.astype(float)])


def _recession(depth, covered, view: View) -> np.ndarray:
    """How far each pixel lies behind its surroundings, 0 to 1: valleys and the inside darken."""
    sigma = 5.0 / view.pixel_mm * _SUPERSAMPLING
    weight = gaussian_filter(covered.astype(np.float32), sigma, truncate=2)
    total = gaussian_filter(np.where(covered, depth, 0), sigma, truncate=2)
    mean = total / np.maximum(weight, 1e-6)
    return np.where(covered, np.clip((mean - np.where(covered, depth, mean)) / 0.03, 0, 1), 0.0)


def _downsample(premultiplied: np.ndarray) -> np.ndarray:
    height, width, _ = premultiplied.shape
    s = _SUPERSAMPLING
    small = premultiplied.reshape(height // s, s, width // s, s, 4).mean(axis=(1, 3))
    alpha = small[..., 3:]
    return np.dstack([small[..., :3] / np.maximum(alpha, 1e-9), alpha])
