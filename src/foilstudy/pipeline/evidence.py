"""The numbers of a crumple on which verdicts rest."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.measure.stiffness import prestressed_stiffness
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.measure.verdicts import Evidence
from foilstudy.measure.verdicts.shape import alternation, broad_wave_share, calmer_half
from foilstudy.model.patch import knot_points
from foilstudy.model.shell.folding import fold_angle
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.model.shell.yielding import beyond_yield_share
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import stress_free_stiffness


def sensors(shape: Shape) -> dict[str, float]:
    """What is seen in the shape itself, by the names of a study's quantities."""
    surface, patch = knot_points(shape.points), shape.patch
    size = max(patch.size_around, patch.size_along)
    return {
        "fold_angle": fold_angle(surface),
        "beyond_yield_share": beyond_yield_share(shape.stressed, shape.points),
        "self_crossing_share": self_crossing_share(surface),
        "broad_wave_share": broad_wave_share(surface),
        "calmer_half": calmer_half(surface),
        "alternation": alternation((shape.points - shape.reference) / size),
    }


def seen_in(shape: Shape, status: str, negative_eigenvalues: int | None) -> Evidence:
    """Of a shape in memory, without its stiffness, which takes factorisations."""
    return _judged(shape, status, negative_eigenvalues, dict)


def evidence_of(shape: Shape, status: str, negative_eigenvalues: int | None) -> Evidence:
    """Of a shape in memory, with its stiffness on the mesh that it has."""

    def stiffnesses() -> dict[str, np.ndarray]:
        return {
            "static_stiffness": _stiffness(lambda: stress_free_stiffness(shape)),
            "prestressed_stiffness": _stiffness(
                lambda: prestressed_stiffness(shape.problem(), shape.points)
            ),
        }

    return _judged(shape, status, negative_eigenvalues, stiffnesses)


def _judged(
    shape: Shape, status: str, negative_eigenvalues: int | None, more: Callable[[], dict]
) -> Evidence:
    if not np.isfinite(shape.points).all():
        return Evidence("diverged")
    energies = shape.energies()
    values = sensors(shape) | {
        "membrane_energy": energies.membrane,
        "bending_energy": energies.bending,
        "negative_eigenvalues": np.nan if negative_eigenvalues is None else negative_eigenvalues,
    }
    return Evidence.of(status, values | more())


def _stiffness(measure: Callable[[], np.ndarray]) -> np.ndarray:
    """By direction; NaN where it is not defined."""
    try:
        return measure()
    except SolveError:
        return np.full(len(DIRECTIONS), np.nan)
