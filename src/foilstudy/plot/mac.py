"""A MAC matrix as a picture; shared by several figures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

VALUES_MOST = 12
"""Largest number of modes whose values are written into the cells."""


@dataclass(frozen=True)
class ModeLabels:
    """What stands beside one side of the matrix.

    Attributes
    ----------
    title : str
        Whose modes they are, for example ``seed 0``.
    frequencies : sequence of float, optional
        Eigenfrequencies in Hz, written beside the mode numbers.
    """

    title: str
    frequencies: Sequence[float] | None = None

    def texts(self, count: int) -> list[str]:
        """Label of every mode."""
        if self.frequencies is None:
            return [str(mode + 1) for mode in range(count)]
        return [f"{mode + 1}\n{value:.3g} Hz" for mode, value in enumerate(self.frequencies)]


def draw_mac(ax, matrix: np.ndarray, rows: ModeLabels, columns: ModeLabels):
    """Draw a MAC matrix in greys, 0 white and 1 black, with its values while they fit.

    Parameters
    ----------
    matrix : ndarray, shape (modes down, modes across)
        From `foilstudy.measure.dynamics.mac.mac`.
    rows, columns : ModeLabels
        Of the modes down and across.

    Returns
    -------
    matplotlib.image.AxesImage
        For a colour bar.
    """
    from matplotlib.ticker import NullLocator

    down, across = matrix.shape
    image = ax.imshow(matrix, cmap="Greys", vmin=0, vmax=1, aspect="equal")
    ax.grid(False)
    for spine in ax.spines.values():
        spine.set_visible(True)
    for axis, labels, count in ((ax.yaxis, rows, down), (ax.xaxis, columns, across)):
        step = -(-count // VALUES_MOST)
        axis.set_ticks(range(0, count, step), labels.texts(count)[::step])
        axis.set_minor_locator(NullLocator())
        axis.set_label_text(f"mode of {labels.title}")
    ax.tick_params(length=0, labelsize=8.5)
    if max(down, across) <= VALUES_MOST:
        for (i, j), value in np.ndenumerate(matrix):
            ax.text(
                j,
                i,
                f"{value:.2f}",
                ha="center",
                va="center",
                fontsize=8.5,
                color="white" if value > 0.55 else "black",
            )
    return image
