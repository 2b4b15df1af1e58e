"""What tables and figures take from the file of the models, and no trial does."""

from __future__ import annotations

from foilstudy.study.real.settings import ladder


def words(study: str) -> dict[str, list[str | None]]:
    """By step, its words for people and what it stands beside."""
    models = ladder(study)
    steps = () if models is None else models.steps
    return {step.name: [step.words, step.beside] for step in steps}
