"""Which foils are crumpled, by which word."""

from __future__ import annotations

from foilstudy.study.kernel.plan import Lazy, Part, Study
from foilstudy.study.real.settings import trials
from foilstudy.study.real.words import words

_HERE = "foilstudy.study"
NAME = "accuracy"
"""Of the study, and of the file of its foils."""

STUDY = Study(
    name=NAME,
    title="what the words of accuracy cost, and how far off they are",
    parts=(
        Part("trials", trials(NAME), Lazy(f"{_HERE}.real.trial:measure", (NAME,)), memory_mb=4000),
    ),
    findings=Lazy(f"{_HERE}.accuracy.summary:found"),
    tables={
        "trials.csv": Lazy(f"{_HERE}.accuracy.summary:trials"),
        "accuracy.csv": Lazy(f"{_HERE}.accuracy.summary:table"),
        "accuracy.md": Lazy(f"{_HERE}.accuracy.summary:page"),
    },
    figures={"accuracy": Lazy(f"{_HERE}.accuracy.figures:chart")},
    shown_by=words(NAME),
)
