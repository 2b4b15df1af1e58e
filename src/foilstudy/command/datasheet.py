"""`foilstudy datasheet`: one page on a link."""

from __future__ import annotations

from pathlib import Path

__all__ = ["datasheet"]


def datasheet(
    cube: Path,
    /,
    *,
    thickness: float | None = None,
    height: float | None = None,
    output: Path | None = None,
) -> None:
    """Write the data sheet of one link: static, first frequency, transfer stiffness by ISO 10846.

    Parameters
    ----------
    cube : Path
        The cube.nc of a study, or its folder results/NAME.
    thickness : float
        Of the foil, um; may be left out where the cube has one.
    height : float
        Of the uncrumpled cylinder, mm; likewise.
    output : Path
        Page to write; else datasheet-THICKNESSum-HEIGHTmm.html in the folder of the cube.
    """
    from foilstudy.base.cube import open_cube
    from foilstudy.config.model import overlength_id, thickness_id
    from foilstudy.present.datasheet.facts import link_facts
    from foilstudy.present.datasheet.page import write_datasheet

    path = cube / "cube.nc" if cube.is_dir() else cube
    values = open_cube(path)
    if output is None:
        facts = link_facts(values, thickness, height)
        name = f"datasheet-{thickness_id(facts.thickness_um)}-{overlength_id(facts.height_mm)}"
        output = path.with_name(f"{name}.html")
    write_datasheet(values, output, thickness, height)
    print(f"wrote {output}")
