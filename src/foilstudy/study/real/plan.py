"""Which foils are crumpled by which models."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.real.settings import FILE, Ladder
from foilstudy.study.settings import content_digest, read_settings


@dataclass(frozen=True)
class Trial:
    """One foil by one model.

    Attributes
    ----------
    step : str
        Name of the model.
    content : str
        Digest of its sections: another content is another case.
    thickness_um, height_mm, seed : int
    """

    step: str
    content: str
    thickness_um: int
    height_mm: int
    seed: int


# an installed package has no workflow, and no models beside it
LADDER: Ladder | None = read_settings(FILE, Ladder) if FILE.is_file() else None


def _trials() -> Iterator[Trial]:
    if LADDER is None:
        return
    for step in LADDER.steps:
        content = content_digest(LADDER.sections_of(step.name))
        for thickness in step.thickness_um or LADDER.thickness_um:
            for height in LADDER.reference_height_mm:
                for seed in range(LADDER.seeds):
                    yield Trial(step.name, content, thickness, height, seed)


_HERE = "foilstudy.study.real"

STUDY = Study(
    name="real",
    title="what separates simulation from measurement",
    parts=(Part("trials", tuple(_trials()), Lazy(f"{_HERE}.trial:measure"), memory_mb=2000),),
    findings=Lazy(f"{_HERE}.laws:found"),
    tables={
        "trials.csv": Lazy(f"{_HERE}.tables:trials"),
        "laws.csv": Lazy(f"{_HERE}.tables:laws"),
        "laws.md": Lazy(f"{_HERE}.tables:page"),
    },
    figures={"explanation": Lazy(f"{_HERE}.figures:chart")},
)
