"""What tables and figures take from the file of the models, and no trial does."""

from __future__ import annotations

from foilstudy.base.manifest import noted_origin
from foilstudy.study.real.settings import cube_of, ladder


def words(study: str) -> dict[str, list[str | None]]:
    """By step, its words for people and what it stands beside.

    Of models that are studies, their words and what the cubes are noted to be.
    """
    models = ladder(study)
    if models is None:
        return {}
    cubes = {
        entry.name: [entry.words, *(_content(name) for name in entry.studies)]
        for entry in models.studied
    }
    return {step.name: [step.words, step.beside] for step in models.steps} | cubes


def _content(study: str) -> str:
    return " ".join(noted_origin(cube_of(study).parent).sources)
