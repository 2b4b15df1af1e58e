"""Accuracy of shapes from elsewhere: our own crumples, read back from points of their surface.

    .venv/bin/python benchmarks/read_back.py      the table of docs/exchange.md, some minutes

The stiffness of what is read back against that of the exact spline on the same mesh; the mesh error
is that of the exact shape on 5 mm against its own mesh limit.
"""

from __future__ import annotations

import numpy as np

from foilstudy.export.contents import surface_grid
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.surface import SurfaceGrid, sheet_from_grid

CASES = ((500, 135, 2), (500, 170, 3), (50, 170, 3))
"""Thickness (um), reference height (mm), meshes."""
RAMP_SLOWNESS = 10.0
"""Any crumple will do."""


def read_back(crumpled: Crumpled, points_per_element: int) -> np.ndarray:
    """Axial and radial stiffness of the same shape from a grid of its points, N/m."""
    grid = surface_grid(crumpled.points)[:: 3 - points_per_element, :: 3 - points_per_element]
    foil = crumpled.foil
    source = SurfaceGrid(grid, points_per_element)
    return sheet_from_grid(source, foil.thickness, foil.material).stiffness()


def percent(ours: np.ndarray, exact: np.ndarray) -> str:
    """Relative errors of both directions; what is rounding as an order of magnitude."""
    return ", ".join(
        f"{error:.0e}" if abs(error) < 1e-4 else f"{float(f'{100 * error:.2g}'):g} %"
        for error in ours / exact - 1
    )


def main() -> None:
    """Print the table row by row."""
    print("| crumple | element | two points per element | one | mesh error of the exact shape |")
    print("|---|---|---|---|---|")
    for thickness, height, meshes in CASES:
        foil = Foil(0.2, 1e-3 * height, 0.13, 1e-6 * thickness, "FEP")
        method = Method.following(foil, RAMP_SLOWNESS)
        shape = crumple(foil, Mesh(5e-3), Imperfection(seed=0), method)
        limit = shape.mesh_limit(2)
        for level in range(meshes):
            exact = shape.stiffness()
            cells = [
                f"{thickness} µm, {height} mm" if level == 0 else "",
                f"{5 / 2**level:g} mm",
                percent(read_back(shape, 2), exact),
                percent(read_back(shape, 1), exact),
                percent(exact, limit.stiffness) if level == 0 else "",
            ]
            print(f"| {' | '.join(cells)} |", flush=True)
            shape = shape.refined()


if __name__ == "__main__":
    main()
