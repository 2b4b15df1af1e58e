"""Which foils are crumpled, and how."""

from __future__ import annotations

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.real.settings import trials
from foilstudy.study.real.words import words

_HERE = "foilstudy.study"
NAME = "truth"
"""Of the study, and of the file of its models."""

STUDY = Study(
    name=NAME,
    title="how far the true stiffness depends on the method",
    parts=(
        Part("trials", trials(NAME), Lazy(f"{_HERE}.real.trial:measure", (NAME,)), memory_mb=2000),
    ),
    findings=Lazy(f"{_HERE}.truth.influences:found"),
    tables={
        "trials.csv": Lazy(f"{_HERE}.real.tables:trials"),
        "influences.csv": Lazy(f"{_HERE}.truth.influences:table"),
        "influences.md": Lazy(f"{_HERE}.truth.influences:page"),
    },
    figures={"influences": Lazy(f"{_HERE}.truth.figures:chart")},
    shown_by=words(NAME),
)
"""Its own trials, ten seeds of each."""
