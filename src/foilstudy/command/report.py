"""`foilstudy report`: the outcome of a study drawn again."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from foilstudy.base.errors import Refusal

__all__ = ["report"]

_SEVERAL = Parameter(negative=())
"""An option that may be given several times, without one that empties it."""


def report(
    results: Path,
    /,
    *,
    measured: Annotated[list[Path] | None, _SEVERAL] = None,
    thickness: Annotated[list[float] | None, _SEVERAL] = None,
    height: Annotated[list[float] | None, _SEVERAL] = None,
    direction: Annotated[list[str] | None, _SEVERAL] = None,
    definition: Annotated[list[str] | None, _SEVERAL] = None,
    function: Annotated[list[str] | None, _SEVERAL] = None,
) -> None:
    """Draw tables, figures and page of a study again from its cube, without any physics.

    Parameters
    ----------
    results : Path
        Folder results/NAME, or the cube.nc in it.
    measured : Path
        Measured dynamic stiffness as for compare, to stand on the page beside the simulated one;
        may be given several times. Without it the page keeps those that it shows, such as those of
        report.measured in the configuration.
    thickness : float
        Of the foil, um, of each measurement in its order; one value is that of all.
    height : float
        Of the uncrumpled cylinder, mm; likewise.
    direction : str
        axial or radial; likewise.
    definition : str
        transfer, driving or relative; likewise.
    function : str
        Part of the name of the response, where a file holds several; likewise.
    """
    from foilstudy.present.measured_files import MeasuredFile
    from foilstudy.present.redraw import redraw

    files = measured or []
    options = {
        "thickness": (thickness, None),
        "height": (height, None),
        "direction": (direction, "axial"),
        "definition": (definition, "transfer"),
        "function": (function, None),
    }
    columns = [_one_each(name, given, len(files), or_) for name, (given, or_) in options.items()]
    given = [MeasuredFile.of(*each) for each in zip(files, *columns)]
    redrawn = redraw(results, given or None)
    for path in redrawn.written:
        print(f"wrote {path}")
    for names, what in ((redrawn.kept, "left as they were"), (redrawn.left_out, "left out")):
        if names:
            why = "the records of the realisations are not there, or not those of this cube"
            print(f"{what}, as {why}: {', '.join(names)}")


def _one_each(name: str, given: list | None, count: int, otherwise: object) -> list:
    """A value for each of so many measurements."""
    if not given or len(given) == 1:
        return (given or [otherwise]) * count
    if len(given) != count:
        raise Refusal(
            f"--{name} is given {len(given)} times for {count} measured files; give it once for "
            "all, or once for each."
        )
    return given
