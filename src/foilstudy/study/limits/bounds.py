"""Reductions beyond their band, damping under stress, paths on a quarter (`limits_bounds`)."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.limits.plan import LIMITS


@dataclass(frozen=True)
class Vibrating:
    """A crumple whose dynamics are reduced with too low a cut-off, and damped under stress.

    Attributes
    ----------
    thickness_um, height_mm, size_mm, seed
        See `foilstudy.study.limits.plan.Trial`.
    cutoff_hz : float
    """

    thickness_um: int
    height_mm: int
    size_mm: float
    seed: int
    cutoff_hz: float


@dataclass(frozen=True)
class Quarter:
    """A path of equilibria of a quarter of the cylinder.

    Attributes
    ----------
    path : str
        A name of `foilstudy.solve.choices.PATHS` that is followed by continuation.
    surface : str or None
        Of an arc length.
    thickness_um, height_mm, size_mm, seed
        See `foilstudy.study.limits.plan.Trial`; the seed is that of the imperfection.
    amplitude_um : float
        Root mean square of the imperfection.
    budget : int
        Factorisations.
    """

    path: str
    surface: str | None
    thickness_um: int
    height_mm: int
    size_mm: float
    seed: int
    amplitude_um: float
    budget: int


def _quarters() -> tuple[Quarter, ...]:
    if LIMITS is None:
        return ()
    return tuple(
        Quarter(way.path, way.surface, one.thickness_um, one.height_mm, one.size_mm, 0, amplitude,
                LIMITS.bounds.budget)
        for one in LIMITS.bounds.quarters
        for amplitude in one.amplitudes_um
        for way in LIMITS.bounds.ways
    )  # fmt: skip


def _vibrating() -> tuple[Vibrating, ...]:
    if LIMITS is None:
        return ()
    return tuple(
        Vibrating(one.thickness_um, one.height_mm, one.size_mm, seed, one.cutoff_hz)
        for one in LIMITS.bounds.vibrating
        for seed in range(one.seeds)
    )


_HERE = "foilstudy.study.limits"

STUDY = Study(
    name="limits_bounds",
    title="reductions beyond their band, damping under stress, paths on a quarter",
    parts=(
        Part("vibrations", _vibrating(), Lazy(f"{_HERE}.vibrations:measure"), memory_mb=2000),
        Part("quarters", _quarters(), Lazy(f"{_HERE}.quarter:measure"), memory_mb=1000),
    ),
    tables={
        "reductions.csv": Lazy(f"{_HERE}.bounds_tables:reductions"),
        "stressed_modes.csv": Lazy(f"{_HERE}.bounds_tables:stressed_modes"),
        "quarters.csv": Lazy(f"{_HERE}.bounds_tables:quarters"),
        "bounds.md": Lazy(f"{_HERE}.bounds_tables:page"),
    },
    figures={},
)
