"""Which crumples are measured in every way: ``snakemake limits_measures``."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.limits.plan import LIMITS
from foilstudy.study.settings import content_digest


@dataclass(frozen=True)
class Measured:
    """A crumple that is measured in every way.

    Attributes
    ----------
    ways : str
        Digest of the ways.
    thickness_um, height_mm, size_mm, seed
        See `foilstudy.study.limits.plan.Trial`.
    ramp_steps : int or None
        None for those of the map.
    """

    ways: str
    thickness_um: int
    height_mm: int
    size_mm: float
    ramp_steps: int | None
    seed: int


def _crumples() -> Iterator[Measured]:
    if LIMITS is None:
        return
    ways = content_digest([way.model_dump() for way in LIMITS.measures.ways])
    for one in LIMITS.measures.foils:
        for ramp in (None, *one.ramp_steps):
            for seed in range(one.seeds):
                yield Measured(ways, one.thickness_um, one.height_mm, one.size_mm, ramp, seed)


_HERE = "foilstudy.study.limits.measures"

STUDY = Study(
    name="limits_measures",
    title="where measures of the stiffness fail",
    parts=(Part("measures", tuple(_crumples()), Lazy(f"{_HERE}:measure"), memory_mb=2000),),
    tables={"measures.csv": Lazy(f"{_HERE}:rows"), "measures.md": Lazy(f"{_HERE}:page")},
    figures={},
)
