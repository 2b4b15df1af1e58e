"""Shapes and modes of the interactive view, chosen and packed small enough to embed."""

import base64
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.record import read_record
from foilstudy.base.reference import colour_scale_mm
from foilstudy.plot.crumples import RecordedCrumple, catalogue
from foilstudy.plot.modes import RecordedModes, recorded_modes
from foilstudy.plot.render import COLOUR_MAP

NODES_MAX = 40_000
"""Nodes of one shape: within 16-bit indices, and 0.65 MB of page."""

MODE_NODES_MAX = 7_000
"""Nodes of one mode; six modes of nine shapes add 1.5 MB at most. A 5 mm mesh has fewer."""

_QUANTA = 32767
_MODE_QUANTA = 127
_COLOURS = 256
_MOTION_MAP = "YlOrRd"


def choose_shapes(paths: Iterable[Path]) -> list[RecordedCrumple]:
    """Choose the extremes and the middle of the sweep, one seed each.

    Of the configurations with a shape, thicknesses and overlengths are each thinned to first,
    middle and last; of the seeds the first converged one is taken, or the first when none
    converged.

    Parameters
    ----------
    paths
        ``crumple.nc`` files; those of diverged or failed realisations are passed over.
    """
    shapes = [crumple for crumple in catalogue(paths) if crumple.has_shape]
    chosen = []
    for thickness in _ends_and_middle({s.thickness_um for s in shapes}):
        for overlength in _ends_and_middle({s.overlength_percent for s in shapes}):
            cell = [
                s
                for s in shapes
                if s.thickness_um == thickness and s.overlength_percent == overlength
            ]
            if cell:
                chosen.append(min(cell, key=lambda s: (s.status != "converged", s.seed)))
    return chosen


def pack_shape(shape: RecordedCrumple, modes: RecordedModes | None = None) -> dict:
    """Quantise one shape to 16 bits per coordinate, and its modes to 8.

    Returns
    -------
    dict
        JSON-ready: ``label``; ``rows`` and ``columns`` of the node grid (columns periodic, not
        repeated); ``scale``, the length of one quantum, and ``radius`` of the uncrumpled cylinder
        [m]; ``surface`` and ``reference`` as base64 of little-endian int16, node by node, x y z;
        ``lowest_mm`` and ``highest_mm`` radial displacement [mm]; ``modes``, see `pack_mode`.

    Raises
    ------
    Refusal
        If the shape holds values that are not finite.
    """
    values, _ = read_record(shape.path)
    surface, reference = values["surface"], values["reference_surface"]
    if not (np.isfinite(surface).all() and np.isfinite(reference).all()):
        raise Refusal(
            f"{shape.path}: the surface holds values that are not finite; "
            "delete the file and crumple this realisation again."
        )
    surface, reference = _thin(surface), _thin(reference)
    radius = np.hypot(*reference[:2])
    radial_mm = 1e3 * (np.hypot(*surface[:2]) - radius)
    scale = max(np.abs(surface).max(), np.abs(reference).max()) / _QUANTA
    return {
        "label": _label(shape),
        "rows": surface.shape[1],
        "columns": surface.shape[2],
        "scale": scale,
        "radius": float(radius.mean()),
        "surface": _encode(surface, scale),
        "reference": _encode(reference, scale),
        "lowest_mm": float(radial_mm.min()),
        "highest_mm": float(radial_mm.max()),
        "modes": [] if modes is None else list(map(pack_mode, modes.frequencies, modes.shapes)),
    }


def pack_mode(frequency: float, displacement: np.ndarray) -> dict:
    """Quantise a mode to 8 bits per component, on a coarser grid where that of the shape is fine.

    Parameters
    ----------
    frequency : float
        Hz.
    displacement : ndarray, shape (3, rows, columns)
        Of any scale, at the nodes of the surface.

    Returns
    -------
    dict
        JSON-ready: ``frequency`` [Hz]; ``rows`` and ``columns`` of its grid, which spans that of
        the shape evenly; ``displacement`` as base64 of int8, node by node, x y z, with 127 for the
        largest displacement of a node.
    """
    coarse = _coarsened(_thin(displacement))
    quantum = np.linalg.norm(coarse, axis=0).max() / _MODE_QUANTA
    quanta = np.round(np.moveaxis(coarse, 0, -1) / quantum).astype(np.int8)
    return {
        "frequency": float(frequency),
        "rows": coarse.shape[1],
        "columns": coarse.shape[2],
        "displacement": base64.b64encode(quanta.tobytes()).decode("ascii"),
    }


def colour_table() -> np.ndarray:
    """Sample the diverging colours of the radial displacement.

    Returns
    -------
    ndarray of uint8, shape (256, 3)
        From inward (first) to outward (last).
    """
    from matplotlib import colormaps

    rgb = colormaps[COLOUR_MAP](np.linspace(0.0, 1.0, _COLOURS))[:, :3]
    return np.round(255.0 * rgb).astype(np.uint8)


def motion_table() -> np.ndarray:
    """Sample the colours of how far a mode moves a point, from at rest to the largest movement.

    Returns
    -------
    ndarray of uint8, shape (256, 3)
    """
    from matplotlib import colormaps

    rgb = colormaps[_MOTION_MAP](np.linspace(0.0, 1.0, _COLOURS))[:, :3]
    return np.round(255.0 * rgb).astype(np.uint8)


def viewer_data(shapes: Sequence[RecordedCrumple], response_paths: Iterable[Path] = ()) -> dict:
    """Collect everything that the page's script needs, JSON-ready."""
    modes = recorded_modes(shapes, response_paths)
    packed = [pack_shape(shape, modes.get(shape.path)) for shape in shapes]
    radius_mm = float(f"{1e3 * max((shape['radius'] for shape in packed), default=0.1):.3g}")
    colours = np.concatenate([colour_table(), motion_table()])
    return {
        "shapes": packed,
        "colours": base64.b64encode(colours.tobytes()).decode("ascii"),
        "range_mm": float(f"{colour_scale_mm(radius_mm):.3g}"),
    }


def _ends_and_middle(values: Iterable[float]) -> list[float]:
    ordered = sorted(values)
    if not ordered:
        return []
    return sorted({ordered[0], ordered[len(ordered) // 2], ordered[-1]})


def _label(shape: RecordedCrumple) -> str:
    flag = "" if shape.status == "converged" else f" ({shape.status.replace('_', ' ')})"
    return (
        f"{shape.thickness_um:g} µm, overlength {shape.overlength_percent:.3g} % "
        f"({shape.reference_height_mm:g} mm), seed {shape.seed}{flag}"
    )


def _thin(points: np.ndarray) -> np.ndarray:
    """Keep every n-th node, and both edge rows, so that a fine mesh stays embeddable."""
    _, rows, columns = points.shape
    stride = int(np.ceil(np.sqrt(rows * columns / NODES_MAX)))
    kept = np.unique(np.append(np.arange(0, rows, stride), rows - 1))
    return points[:, kept, ::stride]


def _coarsened(displacement: np.ndarray) -> np.ndarray:
    _, rows, columns = displacement.shape
    share = min(1.0, np.sqrt(MODE_NODES_MAX / (rows * columns)))
    return _on_grid(displacement, max(2, int(share * rows)), max(3, int(share * columns)))


def _on_grid(values: np.ndarray, rows: int, columns: int) -> np.ndarray:
    """Interpolate linearly onto a grid that spans the same surface; columns are periodic."""
    _, old_rows, old_columns = values.shape
    down = np.linspace(0, old_rows - 1, rows)
    i = np.minimum(down.astype(int), old_rows - 2)
    across = np.arange(columns) * old_columns / columns
    j = across.astype(int)
    lower, upper = values[:, i], values[:, i + 1]
    along = lower + (down - i)[:, None] * (upper - lower)
    left, right = along[:, :, j], along[:, :, (j + 1) % old_columns]
    return left + (across - j) * (right - left)


def _encode(points: np.ndarray, scale: float) -> str:
    quanta = np.round(np.moveaxis(points, 0, -1) / scale).astype("<i2")
    return base64.b64encode(quanta.tobytes()).decode("ascii")
