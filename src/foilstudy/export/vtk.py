"""The crumpled shape with its fields, for ParaView; and its points alone, for NumPy."""

from __future__ import annotations

from pathlib import Path

import meshio
import numpy as np

from foilstudy.export.contents import POINTS_PER_ELEMENT, Contents, surface_grid
from foilstudy.export.energies import element_energies, principal_strains
from foilstudy.model.shell.yielding import von_mises_stress


def write(contents: Contents, path: Path) -> None:
    """Write biquadratic cells, which are exactly the elements, and fields with units in the name.

    Fields of points: undeformed position, displacement, modes; of cells: strains and energies.
    """
    grid = surface_grid(contents.crumple.points)
    mesh = meshio.Mesh(
        grid.reshape(-1, 3),
        [("quad9", _cells(*grid.shape[:2]))],
        point_data=_point_fields(contents, grid),
        cell_data={name: [values.ravel()] for name, values in _cell_fields(contents).items()},
    )
    mesh.write(path, file_format="vtu")


def write_points(contents: Contents, path: Path) -> None:
    """Write the grid of surface points, which `foilstudy.pipeline.surface` reads back."""
    crumple = contents.crumple
    content = {
        "points": surface_grid(crumple.points),
        "reference_points": surface_grid(crumple.reference),
        "points_per_element": POINTS_PER_ELEMENT,
        "thickness": crumple.foil.thickness,
        **contents.provenance,
    }
    with path.open("wb") as file:  # np.savez would add an ending to a path without it
        np.savez_compressed(file, **content)


def _cells(rows: int, columns: int) -> np.ndarray:
    """Corners, edge middles and middle, counter-clockwise seen from outside."""
    index = np.arange(rows * columns).reshape(rows, columns)

    def at(row: int, column: int) -> np.ndarray:
        return np.roll(index, -column, axis=1)[row : rows - 2 + row : 2, ::2].ravel()

    places = [(0, 0), (0, 2), (2, 2), (2, 0), (0, 1), (1, 2), (2, 1), (1, 0), (1, 1)]
    return np.stack([at(*place) for place in places], axis=1)


def _point_fields(contents: Contents, grid: np.ndarray) -> dict[str, np.ndarray]:
    reference = surface_grid(contents.crumple.reference)
    rows, columns, _ = grid.shape
    radial = np.hypot(grid[..., 0], grid[..., 1]) - np.hypot(reference[..., 0], reference[..., 1])
    fields = {
        "row": np.repeat(np.arange(rows), columns),
        "column": np.tile(np.arange(columns), rows),
        "reference_position_m": reference.reshape(-1, 3),
        "displacement_m": (grid - reference).reshape(-1, 3),
        "radial_displacement_m": radial.ravel(),
    }
    frequencies, shapes = contents.clamped_modes
    for mode, (frequency, shape) in enumerate(zip(frequencies, shapes), start=1):
        fields[f"mode_{mode:02d}_{frequency:.2f}_Hz"] = (
            surface_grid(shape).reshape(-1, 3).astype(np.float32)
        )
    return fields


def _cell_fields(contents: Contents) -> dict[str, np.ndarray]:
    crumple = contents.crumple
    sheet, points = crumple.stressed, crumple.points
    areas, strains = sheet.section.areas, principal_strains(sheet, points)
    membrane, bending, stabilisation = element_energies(sheet, points) / areas
    return {
        "reference_area_m2": areas,
        "membrane_strain_max": strains.membrane_max,
        "membrane_strain_min": strains.membrane_min,
        "curvature_change_1_per_m": strains.curvature,
        "bending_strain": 0.5 * sheet.section.local_thickness * strains.curvature,
        "membrane_energy_J_per_m2": membrane,
        "bending_energy_J_per_m2": bending,
        "stabilisation_energy_J_per_m2": stabilisation,
        "von_mises_stress_Pa": von_mises_stress(sheet, points),
    }
