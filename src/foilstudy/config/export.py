"""The files for other tools of a study configuration."""

from __future__ import annotations

from foilstudy.export.formats import FORMATS

from .choices import choice_of
from .sections import Section, unit_field

__all__ = ["Export"]


class Export(Section):
    """Files for other tools, of every realisation; changing it computes no physics again.

    They are written to `results/NAME/realisations/THICKNESS/HEIGHT/SEED/export/`, see
    `docs/exchange.md`.
    """

    formats: tuple[choice_of(FORMATS), ...] = unit_field(
        "list of choices",
        FORMATS.words,
        (),
        strict=False,
    )
