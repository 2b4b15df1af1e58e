"""What adaptive meshes would save, as a table and a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import matplotlib as mpl
import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.ticker import FixedFormatter, FixedLocator

from foilstudy.plot import style
from foilstudy.study.tradeoff.adaptive.sizes import COARSEST, FINEST

if TYPE_CHECKING:
    from foilstudy.study.tradeoff.points import Gathered

_LEVELS = range(COARSEST, FINEST - 1, -1)
_WORDS = {level: f"{2.0**level:g}h" for level in _LEVELS}


def rows(study: Gathered) -> list[dict]:
    """One row per crumple; shares and errors of one, gains as ratios."""
    return [
        {
            "thickness_um": case.thickness_um,
            "height_mm": case.height_mm,
            "size_mm": case.size_mm,
            "elements": found["elements"],
            **{f"error_{2**k}h": error for k, error in enumerate(found["errors"])},
            **{
                f"area_{_WORDS[level]}": share
                for level, share in zip(_LEVELS, found["shares"], strict=True)
            },
            **{f"gain_{name}": gain for name, gain in found["gain"].items()},
            "kernel_ratio": found["kernel"],
            "gain_with_kernel": found["gain"]["tree"] / found["kernel"],
            "ramp_share": found["ramp"]["share"],
            "saved_by_stage": found["ramp"]["by_stage"],
            "saved_by_coarsening": found["ramp"]["coarsened"],
        }
        for case, found in study.adaptive.items()
    ]


@style.styled
def figure(study: Gathered):
    """Which elements need which size, and how large those of the ramp may be."""
    cases = study.adaptive
    figure = style.new_figure(style.PAGE_WIDTH, 2.6 * len(cases) + 0.4)
    axes = figure.subplots(len(cases), 2, squeeze=False, width_ratios=(2.2, 1))
    colours = mpl.colormaps["Greys"].resampled(len(_LEVELS)).reversed()
    norm = BoundaryNorm(np.arange(FINEST, COARSEST + 2) - 0.5, len(_LEVELS))
    for (sheet, ramp), (case, found) in zip(axes, cases.items(), strict=True):
        levels = np.asarray(found["levels"])
        along, around = levels.shape
        extent = (0.0, around * case.size_mm, 0.0, along * case.size_mm)
        image = sheet.imshow(levels, colours, norm, origin="lower", extent=extent)
        sheet.grid(visible=False)
        sheet.set_title(f"{style.thickness_label(case.thickness_um)}, h = {case.size_mm:g} mm")
        sheet.set_ylabel("along (mm)")
        _draw_ramp(ramp, found["ramp"])
    axes[-1, 0].set_xlabel("around (mm)")
    axes[-1, 1].set_xlabel("share of the shortening (%)")
    bar = figure.colorbar(image, ax=axes[:, 0], location="top", aspect=45, shrink=0.8)
    bar.ax.xaxis.set_major_locator(FixedLocator(sorted(_LEVELS)))
    bar.ax.xaxis.set_major_formatter(FixedFormatter([_WORDS[level] for level in sorted(_LEVELS)]))
    bar.ax.minorticks_off()
    bar.set_label("element size, same error of the energy as h everywhere")
    return figure


def _draw_ramp(ax, ramp: dict) -> None:
    ax.plot(100 * np.asarray(ramp["shortening"]), ramp["size"], color="black", marker="o")
    ax.set_ylim(0.0, None)
    ax.set_title("size that the ramp needs, over h")
