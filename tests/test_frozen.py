"""Rearranging the code moves no number; see `frozen`."""

import numpy as np
import pytest

import frozen
from foilstudy.realisation.crumple import crumple
from foilstudy.realisation.crumpled import Crumple
from foilstudy.realisation.cylinder import cylinder_bounds
from foilstudy.realisation.record import read_record
from foilstudy.realisation.relax_refined import relax_refined
from foilstudy.realisation.respond import respond
from foilstudy.realisation.scene import foil_of
from foilstudy.realisation.structures import stress_free_structure
from foilstudy.stiffness import prestressed_stiffness

KEPT_CELL = "t500um_h170mm_corner_krylov"


def run_cell(name, folder):
    """Every record of a frozen cell, as it is kept."""
    study = frozen.study_of(name)
    (cell,) = study.cells()
    paths = {part: folder / f"{part}.nc" for part in ("crumple", "response", "refined", "cylinder")}
    crumple(study.crumple_task(cell), paths["crumple"])
    respond(study.response_task(cell), paths["crumple"], paths["response"])
    relax_refined(study.refine_task(cell), paths["crumple"], paths["refined"])
    cylinder_bounds(study, paths["cylinder"])
    return {part: frozen.frozen(*read_record(path)) for part, path in paths.items()}


@pytest.mark.parametrize("name", frozen.CELLS)
def test_a_cell_is_the_same_to_the_last_bit(name, tmp_path):
    kept = frozen.read(name)
    if kept["processor"] != frozen.processor():
        pytest.skip("a crumple is chaotic, and its last bits belong to the processor it ran on")
    now = run_cell(name, tmp_path)
    for part, record in kept["records"].items():
        assert now[part]["status"] == record["status"], part
        gone = record["values"].keys() - now[part]["values"].keys()
        assert not gone, f"{part} lacks {gone}"
        moved = {k for k, v in record["values"].items() if now[part]["values"][k] != v}
        assert not moved, f"{part}: {moved}"


def test_the_stiffness_of_a_kept_shape_is_the_same_everywhere():
    study = frozen.study_of(KEPT_CELL)
    (cell,) = study.cells()
    with np.load(frozen.FOLDER / "shape.npz") as kept:
        kept = dict(kept)
    attributes = {"element": study.mesh.element}
    shape = Crumple.recorded(foil_of(study.crumple_task(cell)), kept, attributes)
    sheet = shape.sheet(shape.reference)
    energies = sheet.energies(shape.points)
    np.testing.assert_allclose(energies.membrane, kept["membrane_energy"], rtol=1e-9)
    np.testing.assert_allclose(energies.bending, kept["bending_energy"], rtol=1e-9)
    stiffness = stress_free_structure(shape).static.stiffness
    scale = np.abs(kept["interface_stiffness"]).max()
    np.testing.assert_allclose(stiffness, kept["interface_stiffness"], rtol=1e-9, atol=1e-9 * scale)
    stressed = prestressed_stiffness(sheet, shape.points)
    np.testing.assert_allclose(stressed, kept["prestressed_stiffness"], rtol=1e-9)
