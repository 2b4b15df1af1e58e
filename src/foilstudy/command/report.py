"""`foilstudy report`: the outcome of a study drawn again."""

from __future__ import annotations

from pathlib import Path

__all__ = ["report"]


def report(results: Path, /) -> None:
    """Draw tables, figures and page of a study again from its cube, without any physics.

    Parameters
    ----------
    results : Path
        Folder results/NAME, or the cube.nc in it.
    """
    from foilstudy.present.redraw import redraw

    redrawn = redraw(results)
    for path in redrawn.written:
        print(f"wrote {path}")
    for names, what in ((redrawn.kept, "left as they were"), (redrawn.left_out, "left out")):
        if names:
            why = "the records of the realisations are not there, or not those of this cube"
            print(f"{what}, as {why}: {', '.join(names)}")
