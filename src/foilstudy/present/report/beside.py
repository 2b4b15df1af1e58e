"""Measurements on the page of a study, beside the realisations of their configurations."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import xarray as xr

from foilstudy.base.errors import Refusal
from foilstudy.plot import style
from foilstudy.present.measured import draw, findings, title_of
from foilstudy.present.measured_files import MeasuredFile

__all__ = ["Beside", "measurements"]


@dataclass(frozen=True)
class Beside:
    """One measurement as it stands in the page.

    Attributes
    ----------
    name : str
        Of its file.
    title : str
        Configuration and stiffness.
    rows : tuple of (str, str)
        What it shows: a word and what is said of it, the word empty where it goes on.
    picture : bytes
        SVG; empty where there is nothing to compare with.
    """

    name: str
    title: str
    rows: tuple[tuple[str, str], ...]
    picture: bytes

    @property
    def alt(self) -> str:
        """For those who do not see the picture."""
        return f"{self.title}, measured and simulated. {'; '.join(t for _, t in self.rows)}."


def measurements(cube: xr.Dataset, files: Sequence[MeasuredFile]) -> Iterator[Beside]:
    """Compare and draw what was measured, or say why not."""
    for file in files:
        try:
            comparison = file.beside(cube)
        except Refusal as problem:
            yield Beside(file.path.name, "not compared", (("", str(problem)),), b"")
            continue
        title, picture = title_of(comparison), io.BytesIO()
        style.styled(draw(comparison, title).savefig)(
            picture, format="svg", metadata={"Date": None}
        )
        yield Beside(file.path.name, title, tuple(findings(comparison)), picture.getvalue())
