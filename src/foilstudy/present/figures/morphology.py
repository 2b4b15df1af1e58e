"""Grid of crumpled shapes over thickness and overlength."""

from __future__ import annotations

from foilstudy.plot.crumples import catalogue
from foilstudy.plot.style import overlength_label, styled, thickness_label
from foilstudy.present.figures.shapes import draw_grid


@styled
def draw(crumple_paths):
    """Draw the first realisation of every configuration.

    Parameters
    ----------
    crumple_paths : paths of crumple.nc files
        One realisation per configuration is drawn, the one with the smallest seed.
    """
    crumples = catalogue(crumple_paths)
    first = {}
    for crumple in crumples:
        first.setdefault((crumple.thickness_um, crumple.overlength_percent), crumple)
    thicknesses = sorted({c.thickness_um for c in crumples})
    overlengths = sorted({c.overlength_percent for c in crumples})
    return draw_grid(
        [[first.get((t, o)) for o in overlengths] for t in thicknesses],
        column_titles=[f"overlength {overlength_label(o)}" for o in overlengths],
        row_titles=[thickness_label(t) for t in thicknesses],
    )
