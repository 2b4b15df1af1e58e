"""The figures of a study: a registry, and functions that draw and save them.

Importing this package does not import matplotlib, so that a workflow can read `FIGURES` cheaply.
"""

from foilstudy.present.figures.registry import (
    FIGURES,
    FigureSpec,
    draw_figure,
    draw_figures,
)

__all__ = ["FIGURES", "FigureSpec", "draw_figure", "draw_figures"]
