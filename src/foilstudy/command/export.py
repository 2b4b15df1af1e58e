"""`foilstudy export`: one realisation into the formats of other tools."""

from __future__ import annotations

from pathlib import Path

__all__ = ["export"]


def export(
    folder: Path,
    /,
    *,
    format: str,
    output: Path | None = None,
    refinements: int = 0,
) -> None:
    """Write one realisation of a finished study for other tools.

    Parameters
    ----------
    folder : Path
        Such as results/NAME/realisations/t500um/h170mm/0.
    format : str
        nc, mat: reduced model; uff, csv: dynamic stiffness; vtu, npz: shape; inp: CalculiX; or all.
    output : Path, optional
        File, or folder for all formats; else FOLDER/export with the usual names.
    refinements : int
        Halve the elements so often before.
    """
    from foilstudy.base.errors import Refusal
    from foilstudy.export.formats import FORMATS
    from foilstudy.export.write import write
    from foilstudy.linalg import SolveError
    from foilstudy.study.sweep.export import contents_of, recorded_task

    names = list(FORMATS) if format == "all" else [format]
    formats = {name: FORMATS.choice(name) for name in names}
    place = output or folder / "export"
    is_file = output is not None and format != "all" and not output.is_dir()
    try:
        contents = contents_of(recorded_task(folder), folder / "crumple.nc", refinements)
        for name, kind in formats.items():
            path = place if is_file else place / kind.filename
            write(contents, name, path)
            print(f"wrote {path}")
    except SolveError as problem:
        raise Refusal(f"{folder}: {problem}") from None
