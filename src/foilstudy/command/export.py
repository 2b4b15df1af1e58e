"""`foilstudy export`: one realisation into the formats of other tools."""

from __future__ import annotations

import sys
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
        nc, mat: reduced model; uff, csv: dynamic stiffness; vtu, npz: shape; inp: CalculiX;
        abaqus, ccx: superelement;
        uff_receptance_free, uff_receptance_bottom_held, uff_accelerance_free,
        uff_accelerance_bottom_held, csv_receptance_free, csv_receptance_bottom_held,
        csv_accelerance_free, csv_accelerance_bottom_held, mat_motion: motion per force;
        or all: what can be written, and why the rest cannot.
    output : Path, optional
        File, or folder for all formats; else FOLDER/exported with the usual names. (FOLDER/export
        is the workflow's own.)
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
    if format == "all" and output is not None and output.is_file():
        raise Refusal(f"{output}: is a file, and all formats need a folder; name one.")
    place = output or folder / "exported"
    is_file = output is not None and format != "all" and not output.is_dir()
    reasons = []
    try:
        contents = contents_of(recorded_task(folder), folder / "crumple.nc", refinements)
        for name, kind in formats.items():
            path = place if is_file else place / kind.filename
            try:
                write(contents, name, path)
            except Exception as problem:  # the other formats may well be possible
                if format != "all":
                    raise
                reasons.append(f"{path}: not written: {_reason(problem)}")
            else:
                print(f"wrote {path}")
    except SolveError as problem:
        raise Refusal(f"{folder}: {problem}") from None
    if len(reasons) == len(formats):
        raise Refusal("\n".join(reasons))
    for reason in reasons:
        print(reason, file=sys.stderr)


def _reason(problem: Exception) -> str:
    """Why a format was not written, in one line."""
    from foilstudy.base.errors import Refusal
    from foilstudy.linalg import SolveError

    if isinstance(problem, Refusal | SolveError):
        return str(problem)
    if isinstance(problem, OSError) and problem.strerror:
        return f"{problem.strerror}; check path, permissions and disk."
    return f"{type(problem).__name__}: {problem}; --format with its name shows where."
