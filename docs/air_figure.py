"""The figure of docs/air.md, drawn from the table on the page: ``python docs/air_figure.py``."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

from foilstudy.plot import style
from foilstudy.plot.save import save

PAGE = Path(__file__).with_name("air.md")
STEM = Path(__file__).parents[1] / "results/air/air"
ROW = re.compile(r"^\| (\d+) µm, (\d) \| (.+) \|$", re.MULTILINE)


class Found(NamedTuple):
    """A row: frequencies in Hz, changes in %, axial stiffness in kN/m."""

    thickness_um: float
    vacuum: float
    air: float
    changes: tuple[float, ...]
    alone: float
    isothermal: float
    adiabatic: float


def table(page: str) -> list[Found]:
    """Rows of the table of eigenfrequencies and static stiffness."""
    found = []
    for thickness, _, rest in ROW.findall(page):
        vacuum, air, others, *static = rest.replace("−", "-").split(" | ")
        first, change = re.fullmatch(r"(\S+) \((\S+)\)", air).groups()
        changes = tuple(float(each) for each in (change, *others.split(", ")))
        found.append(
            Found(float(thickness), float(vacuum), float(first), changes, *map(float, static[:3]))
        )
    return found


@style.styled
def draw(rows: list[Found]):
    """Change of the first three eigenfrequencies, and axial stiffness with a sealed volume."""
    figure = style.new_figure(style.PAGE_WIDTH, 3.4)
    left, right = figure.subplots(1, 2)
    thickness = [row.thickness_um for row in rows]
    for k, marker in enumerate("os^"):
        left.plot(
            thickness, [row.changes[k] for row in rows], marker, label=f"mode {k + 1}, vented"
        )
    left.axhline(0, color=style.GREY, linewidth=0.8)
    left.set(xscale="log", xlabel="thickness (µm)", ylabel="change of the eigenfrequency (%)")
    for name, label, marker in (
        ("alone", "foil alone, or vented", "o"),
        ("isothermal", "sealed, isothermal", "s"),
        ("adiabatic", "sealed, adiabatic", "^"),
    ):
        right.plot(thickness, [getattr(row, name) for row in rows], marker, label=label)
    right.set(xscale="log", yscale="log", xlabel="thickness (µm)", ylabel="axial stiffness (kN/m)")
    for ax in (left, right):
        ax.set_xticks([50, 130, 250, 500], ["50", "130", "250", "500"])
        ax.minorticks_off()
        ax.legend()
    return figure


if __name__ == "__main__":
    STEM.parent.mkdir(exist_ok=True)
    for path in save(draw(table(PAGE.read_text("utf-8"))), STEM):
        print(f"wrote {path}")
