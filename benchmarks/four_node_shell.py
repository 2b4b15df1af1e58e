"""Stiffness of crumples by a 4-node shell of a library, against the element of this project.

    .venv/bin/python benchmarks/four_node_shell.py [table.csv]      the table of docs/limits.md

The thin quadrilateral of Kratos (discrete Kirchhoff plate and a membrane with drilling rotations,
six unknowns at a node) on the corners of our elements: the same stress-free shape on the same mesh,
its edges clamped to the same rigid rings. Kratos is a requirement of development only
(`requirements/dev.in`).
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import KratosMultiphysics as Kratos
import numpy as np
import scipy.sparse as sparse
from KratosMultiphysics.StructuralMechanicsApplication import LinearElasticPlaneStress2DLaw

from foilstudy.measure.stiffness import InterfaceSystem, Rings, condense, fixed_stiffness
from foilstudy.measure.stiffness.rings import rigid_motion
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import knot_points
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.shape import Shape
from foilstudy.study.published import foil

ELEMENT = "ShellThinElementCorotational3D4N"
UNKNOWNS = 6
"""Of a node: three displacements, three rotations."""
CASES = ((500, 5.0), (500, 7.0), (50, 5.0), (50, 7.0))
"""Thickness (um) and element size (mm)."""
SEEDS, MESHES = 2, 3
RAMP_SLOWNESS = 10.0
"""As in the other tables of docs/limits.md."""
TABLE = Path(__file__).parents[1] / "results/limits/four_node_shell.csv"


def theirs(shape: Shape) -> np.ndarray:
    """Stiffness of the twelve ring motions by their element, shape (12, 12)."""
    nodes = knot_points(shape.points)
    matrix, ring = assembled(nodes, shape.foil), UNKNOWNS * nodes.shape[2]
    inner, owned = slice(ring, -ring), np.r_[:ring, -ring:0]
    motion = np.zeros((2 * ring, 12))
    for k, row in enumerate((0, -1)):
        centre = np.array([0.0, 0.0, nodes[2, row].mean()])
        block = node_motion(nodes[:, row].T - centre)
        motion[k * ring : (k + 1) * ring, UNKNOWNS * k : UNKNOWNS * (k + 1)] = block
    rows = matrix[inner]
    system = InterfaceSystem(
        rows[:, inner].tocsr(),
        rows[:, owned] @ motion,
        motion.T @ (matrix[owned][:, owned] @ motion),
    )
    return condense(system).stiffness


def ours(shape: Shape) -> np.ndarray:
    """The same by the element of the shape."""
    rings = Rings.of(shape.patch, shape.points)
    return condense(InterfaceSystem.split(shape.relieved().tangent(), rings)).stiffness


def assembled(nodes: np.ndarray, sheet: Foil) -> sparse.csr_matrix:
    """Stiffness of a closed sheet that is stress-free in this shape, six unknowns a node.

    Parameters
    ----------
    nodes : ndarray, shape (3, rows, columns)
        m.
    sheet : Foil
    """
    _, rows, columns = nodes.shape
    part = _part(nodes, sheet)
    number = np.arange(rows * columns).reshape(rows, columns)
    after = np.roll(number, -1, axis=1)
    quads = np.stack([number[:-1], after[:-1], after[1:], number[1:]], axis=2).reshape(-1, 4)
    size = 4 * UNKNOWNS
    local, force, blocks = Kratos.Matrix(size, size), Kratos.Vector(size), []
    for k, corners in enumerate((quads + 1).tolist(), 1):
        element = part.CreateNewElement(ELEMENT, k, corners, part.GetProperties(1))
        element.Initialize(part.ProcessInfo)
        element.CalculateLocalSystem(local, force, part.ProcessInfo)
        blocks.append(np.array(local, copy=True))
    places = (UNKNOWNS * quads[:, :, None] + np.arange(UNKNOWNS)).reshape(-1, size)
    across = np.repeat(places, size, axis=1).ravel(), np.tile(places, (1, size)).ravel()
    whole = 2 * (UNKNOWNS * number.size,)
    return sparse.coo_matrix((np.ravel(blocks), across), shape=whole).tocsr()


def _part(nodes: np.ndarray, sheet: Foil) -> Kratos.ModelPart:
    """Nodes and material; the model that owns it lives as long as it does."""
    Kratos.Logger.GetDefaultOutput().SetSeverity(Kratos.Logger.Severity.WARNING)
    part = _MODEL.CreateModelPart(f"sheet{len(_MODEL.GetModelPartNames())}")
    for name in ("DISPLACEMENT", "ROTATION"):
        part.AddNodalSolutionStepVariable(Kratos.KratosGlobals.GetVariable(name))
    for k, place in enumerate(nodes.reshape(3, -1).T.tolist(), 1):
        part.CreateNewNode(k, *place)
    for name in ("DISPLACEMENT", "ROTATION"):
        for axis in "XYZ":
            unknown = Kratos.KratosGlobals.GetVariable(f"{name}_{axis}")
            Kratos.VariableUtils().AddDof(unknown, part)
    properties, material = part.CreateNewProperties(1), sheet.material
    properties.SetValue(Kratos.YOUNG_MODULUS, material.youngs_modulus)
    properties.SetValue(Kratos.POISSON_RATIO, material.poisson_ratio)
    properties.SetValue(Kratos.DENSITY, material.density)
    properties.SetValue(Kratos.THICKNESS, sheet.thickness)
    properties.SetValue(Kratos.CONSTITUTIVE_LAW, LinearElasticPlaneStress2DLaw())
    return part


_MODEL = Kratos.Model()


def node_motion(arms: np.ndarray) -> np.ndarray:
    """Motion of nodes that turn with a rigid body, shape (6 nodes, 6), see `rigid_motion`."""
    motion = np.zeros((len(arms), UNKNOWNS, 6))
    motion[:, :3] = rigid_motion(arms).reshape(-1, 3, 6)
    motion[:, 3:, 3:] = np.eye(3)
    return motion.reshape(-1, 6)


def apart(one: np.ndarray, other: np.ndarray, radius: float) -> float:
    """Distance of two interface stiffnesses over the size of the second, rotations by the rim."""
    scale = np.tile(np.repeat([1.0, 1 / radius], 3), 2)
    one, other = (scale[:, None] * each * scale for each in (one, other))
    return float(np.linalg.norm(one - other) / np.linalg.norm(other))


def rows(thickness_um: int, size_mm: float, seed: int) -> list[dict]:
    """Of one crumple, a row for each mesh."""
    sheet = foil(thickness_um)
    method = Method.following(sheet, RAMP_SLOWNESS)
    shape = crumple(sheet, Mesh(1e-3 * size_mm), Imperfection(seed=seed), method)
    limit, found = shape.mesh_limit(MESHES - 1), []
    for halvings in range(MESHES):
        both = ours(shape), theirs(shape)
        (axial, radial), (their_axial, their_radial) = map(fixed_stiffness, both)
        found.append(
            {
                "thickness_um": thickness_um,
                "size_mm": size_mm,
                "seed": seed,
                "status": shape.status,
                "halvings": halvings,
                "axial": f"{axial:.6g}",
                "radial": f"{radial:.6g}",
                "their_axial": f"{their_axial:.6g}",
                "their_radial": f"{their_radial:.6g}",
                "limit_axial": f"{limit.stiffness[0]:.6g}",
                "limit_radial": f"{limit.stiffness[1]:.6g}",
                "error_axial": f"{limit.error[0]:.2g}",
                "error_radial": f"{limit.error[1]:.2g}",
                "apart": f"{apart(*both[::-1], sheet.diameter / 2):.4g}",
            }
        )
        shape = shape.refined()
    return found


def main() -> None:
    """Write the table."""
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else TABLE
    with path.open("w", newline="", buffering=1) as file:
        writer = None
        for case in CASES:
            for seed in range(SEEDS):
                for row in rows(*case, seed):
                    writer = writer or csv.DictWriter(file, row, lineterminator="\n")
                    if not file.tell():
                        writer.writeheader()
                    writer.writerow(row)


if __name__ == "__main__":
    main()
