"""Rearranging the code moves no number; see `frozen`."""

import os
import subprocess
import sys
from pathlib import Path

import frozen
import numpy as np
import pytest

from foilstudy.base.record import read_record
from foilstudy.config.foils import foil_of
from foilstudy.config.scene import recipe_of
from foilstudy.measure.stiffness import prestressed_stiffness
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.structures import stress_free_structure

KEPT_CELL = "t500um_h170mm_corner_krylov"
PARTS = ("crumple", "response", "refined", "cylinder")


def python(*words):
    """A job's process: one thread."""
    threads = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "MKL", "OPENBLAS", "NUMBA")}
    subprocess.run([sys.executable, *words], check=True, env=os.environ | threads)


@pytest.fixture(scope="module")
def cells(tmp_path_factory):
    """Folder with the records of every frozen cell, made as in a study: by compiled kernels."""
    folder = tmp_path_factory.mktemp("cells")
    python("-c", "from foilstudy.study.sweep.warmup import compile_kernels; compile_kernels()")
    python(str(Path(__file__).with_name("frozen.py")), str(folder))
    return folder


@pytest.mark.parametrize("name", frozen.CELLS)
def test_a_cell_is_the_same_to_the_last_bit(name, request):
    kept = frozen.read(name)
    if kept["processor"] != frozen.processor():
        pytest.skip("a crumple is chaotic, and its last bits belong to the processor it ran on")
    folder = request.getfixturevalue("cells") / name
    now = {part: frozen.frozen(*read_record(folder / f"{part}.nc")) for part in PARTS}
    for part, record in kept["records"].items():
        assert now[part]["status"] == record["status"], part
        gone = record["values"].keys() - now[part]["values"].keys()
        assert not gone, f"{part} lacks {gone}"
        moved = {k for k, v in record["values"].items() if now[part]["values"][k] != v}
        assert not moved, f"{part}: {moved}"


def test_the_stiffness_of_a_kept_shape_is_the_same_everywhere():
    study = frozen.study_of(KEPT_CELL)
    (cell,) = study.cells()
    task = study.crumple_task(cell)
    foil, recipe = foil_of(task), recipe_of(task)
    with np.load(frozen.FOLDER / "shape.npz") as kept:
        kept = dict(kept)
    shapes = kept["control_points"], kept["reference_control_points"]
    shape = Shape(foil, recipe.mesh.patch(foil), *shapes, recipe.mesh.element_at_work())
    energies = shape.energies()
    np.testing.assert_allclose(energies.membrane, kept["membrane_energy"], rtol=1e-9)
    np.testing.assert_allclose(energies.bending, kept["bending_energy"], rtol=1e-9)
    stiffness = stress_free_structure(shape).static.stiffness
    scale = np.abs(kept["interface_stiffness"]).max()
    np.testing.assert_allclose(stiffness, kept["interface_stiffness"], rtol=1e-9, atol=1e-9 * scale)
    stressed = prestressed_stiffness(shape.stressed, shape.points)
    np.testing.assert_allclose(stressed, kept["prestressed_stiffness"], rtol=1e-9)
