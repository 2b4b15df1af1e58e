"""Which methods are tried on which foils."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.limits.settings import (
    FILE,
    Limits,
    MappedFoil,
    Setting,
    read_limits,
    settings_of,
)


@dataclass(frozen=True)
class Trial:
    """One foil crumpled by one method.

    Attributes
    ----------
    setting : str
        `Setting.name`.
    thickness_um, height_mm : int
        Of the foil and of the uncrumpled cylinder.
    size_mm : float
        Element size asked for.
    seed : int
    """

    setting: str
    thickness_um: int
    height_mm: int
    size_mm: float
    seed: int


# an installed package has no workflow, and no methods beside it
LIMITS: Limits | None = read_limits(FILE) if FILE.is_file() else None
SETTINGS: dict[str, Setting] = (
    {setting.name: setting for setting in settings_of(LIMITS)} if LIMITS else {}
)


def setting_of(trial: Trial) -> Setting:
    """What a trial changes."""
    return SETTINGS[trial.setting]


def _trials(foils: tuple[MappedFoil, ...]) -> Iterator[Trial]:
    for one in foils:
        for name, setting in SETTINGS.items():
            tried = setting.only_um is None or one.thickness_um in setting.only_um
            if tried and (one.groups is None or setting.group in one.groups):
                for seed in range(min(one.seeds, setting.seeds or one.seeds)):
                    yield Trial(name, one.thickness_um, one.height_mm, one.size_mm, seed)


_HERE = "foilstudy.study.limits"


def study_of(name: str, title: str, foils: tuple[MappedFoil, ...]) -> Study:
    """The map of some foils."""
    return Study(
        name=name,
        title=title,
        parts=(
            Part(
                "trials",
                tuple(_trials(foils)),
                Lazy(f"{_HERE}.trial:measure"),
                arrays=("points",),
                memory_mb=2000,
            ),
        ),
        findings=Lazy(f"{_HERE}.map:mapped"),
        tables={
            "limits.csv": Lazy(f"{_HERE}.tables:rows"),
            "limits.md": Lazy(f"{_HERE}.tables:page"),
        },
        figures={
            "map": Lazy(f"{_HERE}.figures:chart"),
            "gallery": Lazy(f"{_HERE}.figures:gallery"),
        },
    )


STUDY = study_of("limits", "where methods fail", LIMITS.foils if LIMITS else ())
