"""Grid of shaded shapes to one scale, with one colour bar; shared by several figures."""

from __future__ import annotations

from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from foilstudy.base.reference import colour_scale_mm
from foilstudy.plot.crumples import RecordedCrumple, read_shape
from foilstudy.plot.render import COLOUR_MAP, View, render
from foilstudy.plot.style import PAGE_WIDTH, message_panel, new_figure

_LARGEST_PANEL = 3.2
_ROW_TITLE_WIDTH = 0.35
_COLOUR_BAR_HEIGHT = 0.95
_PANEL_MM = 230
_PIXELS_PER_INCH = 150
"""At least as many as the PNG has."""


def draw_grid(crumples, column_titles=None, row_titles=None, captions=None):
    """Draw shapes in rows and columns.

    Parameters
    ----------
    crumples : list of lists of RecordedCrumple or None
        An empty place stays blank, a realisation without a shape says why.
    column_titles, row_titles : lists of str, optional
    captions : list of lists of str, optional
        Written under each shape.
    """
    rows, columns = len(crumples), max(map(len, crumples), default=0)
    panel_width = min(_LARGEST_PANEL, (PAGE_WIDTH - _ROW_TITLE_WIDTH) / columns)
    shapes = {
        crumple.path: read_shape(crumple)
        for row in crumples
        for crumple in row
        if crumple is not None and crumple.has_shape
    }
    radius = max((shape.radius for shape in shapes.values()), default=0.1)
    radius_mm = float(f"{1e3 * radius:.3g}")
    scale = colour_scale_mm(radius_mm)
    # as large a part of the panel, and as many dots, for a small foil as for a large one
    pixel_mm = radius_mm / 100 * _PANEL_MM / (panel_width * _PIXELS_PER_INCH)
    view = View(pixel_mm=pixel_mm, colour_scale_mm=scale)
    pictures = {path: render(shape, view) for path, shape in shapes.items()}
    left, right, bottom, top = _common_extent(pictures.values())
    panel_height = panel_width * (top - bottom) / (right - left) + (0.25 if captions else 0)

    figure = new_figure(
        columns * panel_width + _ROW_TITLE_WIDTH,
        rows * panel_height + _COLOUR_BAR_HEIGHT + (0.3 if column_titles else 0),
    )
    figure.get_layout_engine().set(w_pad=0.03, h_pad=0.05, wspace=0, hspace=0)
    axes = figure.subplots(rows, columns, squeeze=False)
    for i, row in enumerate(crumples):
        for j in range(columns):
            crumple = row[j] if j < len(row) else None
            _panel(axes[i, j], crumple, pictures, (left, right, bottom, top))
            if captions and j < len(captions[i]):
                axes[i, j].text(
                    0.5, 0.0, captions[i][j], transform=axes[i, j].transAxes, ha="center", va="top"
                )
    for ax, text in zip(axes[0], column_titles or []):
        ax.set_title(text, pad=4)
    for ax, text in zip(axes[:, 0], row_titles or []):
        ax.text(
            -0.02,
            0.5,
            text,
            transform=ax.transAxes,
            rotation=90,
            ha="right",
            va="center",
            fontsize=10.5,
        )
    if pictures:
        _colour_bar(figure, axes, scale)
    return figure


def _common_extent(pictures) -> tuple[float, float, float, float]:
    extents = [picture.extent_mm for picture in pictures] or [(-115.0, 115.0, -80.0, 200.0)]
    half = max(max(-e[0], e[1]) for e in extents)
    return -half, half, min(e[2] for e in extents), max(e[3] for e in extents)


def _panel(ax, crumple: RecordedCrumple | None, pictures, extent) -> None:
    ax.set_axis_off()
    ax.set_xlim(extent[:2])
    ax.set_ylim(extent[2:])
    ax.set_aspect("equal")
    if crumple is None:
        return
    if not crumple.has_shape:
        message_panel(ax, f"{crumple.status}: {crumple.message}")
        return
    picture = pictures[crumple.path]
    ax.imshow(picture.rgba, extent=picture.extent_mm, interpolation="antialiased")
    ax.set_xlim(extent[:2])
    ax.set_ylim(extent[2:])


def _colour_bar(figure, axes, scale: float) -> None:
    mappable = ScalarMappable(Normalize(-scale, scale), COLOUR_MAP)
    bar = figure.colorbar(
        mappable,
        ax=axes,
        location="bottom",
        extend="both",
        aspect=45,
        pad=0.015,
        shrink=min(1.0, 4.5 / figure.get_figwidth()),
    )
    bar.set_label("radial displacement (mm), outwards positive")
    bar.set_ticks([-scale, -scale / 2, 0, scale / 2, scale])
    bar.outline.set_visible(False)
