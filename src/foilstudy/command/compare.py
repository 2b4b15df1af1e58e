"""`foilstudy compare`: a measured dynamic stiffness beside the simulated ones."""

from __future__ import annotations

from pathlib import Path

__all__ = ["compare"]


def compare(
    file: Path,
    cube: Path,
    /,
    *,
    thickness: float | None = None,
    height: float | None = None,
    direction: str = "axial",
    definition: str = "transfer",
    function: str | None = None,
    output: Path | None = None,
) -> None:
    """Put a measured dynamic stiffness beside the simulated band of its configuration.

    Parameters
    ----------
    file : Path
        CSV, MAT or Universal File (dataset 58) of dynamic stiffness, receptance or accelerance,
        its units stated; docs/bench.md says how.
    cube : Path
        The cube.nc of a study, or its folder results/NAME.
    thickness : float
        Of the foil, um; may be left out where the cube has one.
    height : float
        Of the uncrumpled cylinder, mm; likewise.
    direction : str
        axial or radial.
    definition : str
        transfer, driving or relative.
    function : str
        Part of the name of the response, where FILE holds several.
    output : Path
        Picture, as PNG and SVG; else beside FILE, with -compared behind its name.
    """
    from foilstudy.base.cube import open_cube
    from foilstudy.present.measured import drawn, findings, title_of
    from foilstudy.present.measured_files import MeasuredFile

    measured = MeasuredFile.of(file, thickness, height, direction, definition, function)
    values = open_cube(cube / "cube.nc" if cube.is_dir() else cube)
    comparison = measured.beside(values)
    title = title_of(comparison)
    said = (f"{name:12} {text}" for name, text in findings(comparison))
    print("\n".join([f"{file}: {title}", *said]))
    stem = output.with_suffix("") if output else file.with_name(f"{file.stem}-compared")
    for path in drawn(comparison, title, stem):
        print(f"wrote {path}")
