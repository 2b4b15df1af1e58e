"""Which foils are crumpled by which models."""

from __future__ import annotations

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.real.settings import trials
from foilstudy.study.real.words import words

_HERE = "foilstudy.study.real"
NAME = "real"
"""Of the study, and of the file of its models."""

STUDY = Study(
    name=NAME,
    title="what separates simulation from measurement",
    parts=(Part("trials", trials(NAME), Lazy(f"{_HERE}.trial:measure", (NAME,)), memory_mb=2000),),
    findings=Lazy(f"{_HERE}.laws:found"),
    tables={
        "trials.csv": Lazy(f"{_HERE}.tables:trials"),
        "laws.csv": Lazy(f"{_HERE}.tables:laws"),
        "laws.md": Lazy(f"{_HERE}.tables:page"),
    },
    figures={"explanation": Lazy(f"{_HERE}.figures:chart")},
    shown_by=words(NAME),
)
