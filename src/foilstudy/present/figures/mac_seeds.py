"""Do two realisations of one configuration share their first modes?"""

from __future__ import annotations

from itertools import combinations

import numpy as np

from foilstudy.measure.dynamics.mac import mac
from foilstudy.plot import style
from foilstudy.plot.crumples import RecordedCrumple, catalogue
from foilstudy.plot.mac import ModeLabels, draw_mac
from foilstudy.plot.modes import RecordedModes, recorded_modes


@style.styled
def draw(crumple_paths, response_paths):
    """Draw the MAC of two seeds, for thinnest and thickest foil at its middle overlength."""
    crumples = [crumple for crumple in catalogue(crumple_paths) if crumple.has_shape]
    cases = [
        [(crumple, modes[crumple.path]) for crumple in cell]
        for cell in _thin_and_thick(crumples)
        for modes in [recorded_modes(cell, response_paths)]
        if len(modes) == len(cell)
    ]
    if not cases:
        return style.message_figure(
            "no usable realisation, or no configuration with the mode shapes of two seeds"
        )
    figure = style.new_figure(4.7 * len(cases) + 0.6, 5.2)
    axes = figure.subplots(1, len(cases), squeeze=False)[0]
    for ax, case in zip(axes, cases):
        image = _panel(ax, case)
    bar = figure.colorbar(image, ax=axes, shrink=0.7, aspect=30, pad=0.02)
    bar.set_label("modal assurance criterion")
    bar.outline.set_visible(False)
    return figure


def _thin_and_thick(crumples: list[RecordedCrumple]) -> list[list[RecordedCrumple]]:
    """Realisations at the middle overlength of the thinnest and the thickest foil."""
    cells: dict[float, dict[float, list[RecordedCrumple]]] = {}
    for crumple in crumples:
        cell = cells.setdefault(crumple.thickness_um, {})
        cell.setdefault(crumple.overlength_percent, []).append(crumple)
    chosen = []
    for thickness in sorted({min(cells), max(cells)}) if cells else []:
        several = {o: cell for o, cell in cells[thickness].items() if len(cell) > 1}
        if several:
            chosen.append(several[sorted(several)[len(several) // 2]])
    return chosen


def _panel(ax, case: list[tuple[RecordedCrumple, RecordedModes]]):
    (first, modes_a), (second, modes_b) = case[:2]
    matrix = _compared(modes_a, modes_b)
    image = draw_mac(
        ax,
        matrix,
        ModeLabels(f"seed {first.seed}", modes_a.frequencies),
        ModeLabels(f"seed {second.seed}", modes_b.frequencies),
    )
    best = best_partners([modes for _, modes in case])
    pairs = len(case) * (len(case) - 1) // 2
    name = (
        f"{style.thickness_label(first.thickness_um)}, "
        f"overlength {style.overlength_label(first.overlength_percent)}"
    )
    among = f"{pairs} pairs of seeds" if pairs > 1 else "this pair"
    ax.set_title(
        f"{name}\nbest partner of a mode, {among}:\n"
        f"median {np.median(best):.2f}, highest {best.max():.2f}"
    )
    return image


def best_partners(modes: list[RecordedModes]) -> np.ndarray:
    """Largest MAC of every mode of one realisation with those of another, over all pairs."""
    best = []
    for one, other in combinations(modes, 2):
        matrix = _compared(one, other)
        best += [matrix.max(axis=1), matrix.max(axis=0)]
    return np.concatenate(best)


def _compared(one: RecordedModes, other: RecordedModes) -> np.ndarray:
    return mac(*(modes.shapes.reshape(len(modes.shapes), -1).T for modes in (one, other)))
