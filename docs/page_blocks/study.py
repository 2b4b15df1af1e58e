"""A study whose numbers stand on the pages, and the tables of Markdown they stand in."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pandas as pd

from foilstudy import open_cube
from foilstudy.base.errors import Refusal
from foilstudy.present.comparison import studied_case
from foilstudy.present.configuration import configuration
from foilstudy.present.report.laws import DirectionLaws, Exponent, read_laws
from foilstudy.present.statistics.powerlaw import powerlaw_table
from foilstudy.present.statistics.summary import stiffness_summary
from foilstudy.study.registry import STUDIES

DIRECTIONS = ("axial", "radial")


@dataclass(frozen=True)
class Study:
    """Cube and tables of a study.

    Attributes
    ----------
    folder : Path
        Named as its configuration is.
    """

    folder: Path

    def file(self, name: str) -> Path:
        """A file of the study.

        Raises
        ------
        Refusal
            If the study has not been made, naming the command that makes it.
        """
        path = self.folder / name
        if not path.exists():
            study = self.folder.name
            command = f"make study CONFIG=config/{study}.yaml"
            if study in STUDIES:
                command = f".venv/bin/snakemake -j1 {study}"
            raise Refusal(f"results/{study}/{name} is missing; `{command}` makes it.")
        return path

    @cached_property
    def cube(self):
        """The cube."""
        return open_cube(self.file("cube.nc"))

    def table(self, name: str) -> pd.DataFrame:
        """A table by its name."""
        return pd.read_csv(self.file(f"{name}.csv"))

    @property
    def laws(self) -> tuple[DirectionLaws, ...]:
        """Its power laws."""
        case = studied_case(self.cube)
        scale = case.diameter_mm / 2, case.youngs_modulus_mpa
        return read_laws(self.table("powerlaw"), self.table("stiffness_summary"), scale)

    def laws_from(self, thicknesses: list[int]) -> tuple[DirectionLaws, ...]:
        """Its power laws, were these thicknesses (um) all."""
        part = self.cube.sel(thickness=thicknesses)
        return read_laws(powerlaw_table(part), stiffness_summary(part))

    @property
    def mesh(self) -> str:
        """What it was crumpled on."""
        section = configuration(self.cube)["mesh"]
        if section["element_size_mm"] == "auto":
            return f"resolved to {section['energy_error_percent']:g} %"
        return f"{section['element_size_mm']:g} mm"

    @property
    def thicknesses(self) -> list[int]:
        """Of the sweep, um."""
        return [int(value) for value in self.cube["thickness"].values]

    @property
    def thickest(self) -> int:
        """Of the sweep, um."""
        return max(self.thicknesses)

    @property
    def overlengths(self) -> np.ndarray:
        """Of the sweep, %."""
        return self.cube["overlength"].values


def rows(head: list[str], body: list[list[str]]) -> Iterator[str]:
    """A table in Markdown."""
    yield f"| {' | '.join(head)} |"
    yield "|" + "---|" * len(head)
    yield from (f"| {' | '.join(row)} |" for row in body)


def coefficient(coefficient: Exponent) -> str:
    return f"{coefficient.value:.2f}{coefficient.margin}".replace("−", "-")


def short(value: float, digits: int = 2) -> str:
    return f"{float(f'{value:.{digits}g}'):g}"


def listed(values: list[int]) -> str:
    return ", ".join(map(str, values))


def displacement(study: Study) -> tuple[float, float]:
    low, high = (study.cube[f"radial_displacement_{end}"] for end in ("min", "max"))
    return float(low.min()), float(high.max())
