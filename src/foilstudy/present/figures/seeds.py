"""One configuration crumpled from different random imperfections."""

from __future__ import annotations

from foilstudy.plot import style
from foilstudy.plot.crumples import catalogue, typical_configuration
from foilstudy.present.figures.shapes import draw_grid

MOST = 6


@style.styled
def draw(crumple_paths):
    """Draw up to six realisations of the thickest foil at its middle overlength side by side."""
    crumples = typical_configuration(catalogue(crumple_paths))[:MOST]
    if not crumples:
        return style.message_figure()
    columns = 3 if len(crumples) > 3 else len(crumples)
    rows = [crumples[i : i + columns] for i in range(0, len(crumples), columns)]
    figure = draw_grid(
        [row + [None] * (columns - len(row)) for row in rows],
        captions=[[f"seed {c.seed}" for c in row] for row in rows],
    )
    title = (
        f"{style.thickness_label(crumples[0].thickness_um)}, "
        f"overlength {style.overlength_label(crumples[0].overlength_percent)}"
    )
    figure.suptitle(title, fontsize=11)
    return figure
