"""The stiffness of a foil as it stands, static and dynamic, and how records and page show it."""

import json
from dataclasses import replace

import numpy as np
import pytest
from conftest import FEP, FOIL
from synthetic import make_cube

from foilstudy.base.cube import open_cube
from foilstudy.base.record import read_record
from foilstudy.command.check import check
from foilstudy.config import load_config
from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.measure.stiffness import fixed_stiffness
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.true_state import TrueState, true_state
from foilstudy.present.figures import energy, history, stiffness
from foilstudy.present.report.laws import read_laws
from foilstudy.present.report.mesh import assess_mesh
from foilstudy.present.report.true_state import true_findings, true_grids
from foilstudy.present.statistics.cells import energy_left
from foilstudy.present.statistics.powerlaw import AS_IT_STANDS, PRESTRESSED, powerlaw_table
from foilstudy.present.statistics.summary import stiffness_summary
from foilstudy.present.strain import strain_findings
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cube import gather
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.expected import expected
from foilstudy.study.sweep.origins import cell_folder
from foilstudy.study.sweep.respond import respond_job

BAND = DynamicsOptions(lowest_hz=1, highest_hz=60, frequencies=4, eigenfrequencies=3)
COARSE, QUICK = Mesh(20e-3), Method(RelaxationPath(ramp_steps=400))


def crumpled(law):
    foil = replace(FOIL, material=replace(FEP, law=law))
    return crumple(foil, COARSE, Imperfection(seed=3), QUICK)


def test_of_elastic_foil_it_is_the_prestressed_stiffness():
    elastic = crumpled("elastic")
    state = true_state(elastic, BAND)
    np.testing.assert_allclose(state.stiffness, elastic.prestressed_stiffness(), rtol=1e-9)
    assert not elastic.beyond_elastic


def test_small_motions_about_the_state():
    plastic = crumpled("plastic")
    assert plastic.beyond_elastic
    state = true_state(plastic, BAND)
    assert state.negative_eigenvalues == 0
    # where both rings go together, nothing resists
    together = np.vstack([np.eye(6)[:, :3]] * 2)
    rest = state.interface @ together
    assert np.abs(rest).max() < 1e-6 * np.abs(state.interface[:3, :3]).max()
    # slow motions meet the static stiffness
    slow = np.abs(state.vibration.dynamic_stiffness[2, :, 0])
    np.testing.assert_allclose(slow, state.stiffness, rtol=2e-3)


def test_nothing_vibrates_about_an_unstable_shape():
    """A cylinder squeezed beyond its buckling and not let go."""
    start = uncrumpled(FOIL, COARSE, Imperfection(seed=3), QUICK)
    points = start.points.copy()
    points[2] *= 0.99
    state = true_state(replace(start, points=points), BAND)
    assert state.negative_eigenvalues > 0 and state.vibration is None


def test_a_ring_that_runs_away_has_no_stiffness_when_free():
    """On springs to a ring that is held; one that pushes has an inverse like the others."""
    springs = np.diag([2.0, 3.0, 4.0, 5.0, 6.0, 7.0])
    held = TrueState(np.kron([[1, -1], [-1, 1]], springs), 0, 0, None)
    np.testing.assert_allclose(held.free_stiffness, [4, 2 / (1 / 2 + 1 / 3)])
    springs[4, 4] = -6
    loose = TrueState(np.kron([[1, -1], [-1, 1]], springs), 0, 1, None)
    assert np.isnan(loose.free_stiffness).all() and np.array_equal(loose.stiffness, [4, 2.5])


def test_records_cube_and_page_have_it_where_foil_yields(tmp_path):
    study = load_config(
        {
            "material": {"law": "plastic"},
            "sweep": {"thickness_um": [500], "reference_height_mm": [170], "realisations": 1},
            "mesh": {"element_size_mm": 20},
            "relaxation": {"ramp_steps": 400},
            "stiffness": {"refinements": 0},
            "dynamics": {"shown_max_hz": 60, "frequencies": 4, "eigenfrequencies": 3},
        }
    )
    (cell,) = study.cells()
    folder = cell_folder(tmp_path, cell)
    folder.mkdir(parents=True)
    crumple_job(study.crumple_task(cell), folder / "crumple.nc")
    respond_job(study.response_task(cell), folder / "crumple.nc", folder / "response.nc")
    cylinder_bounds(study, tmp_path / "cylinder.nc")
    gather(study, tmp_path, tmp_path / "cube.nc")
    values, attributes = read_record(folder / "response.nc")
    assert attributes["status"] == "converged", attributes["message"]
    true = values["true_stiffness"]
    alone = Crumpled.recorded(folder / "crumple.nc").prestressed_stiffness()
    assert np.array_equal(true, alone) and np.array_equal(values["prestressed_stiffness"], alone)
    np.testing.assert_allclose(true, fixed_stiffness(values["true_interface_stiffness"]))
    assert not np.allclose(true, values["static_stiffness"], rtol=0.05)
    assert values["true_eigenfrequency"][0] < values["eigenfrequency"][0]
    cube = open_cube(tmp_path / "cube.nc")
    assert cube["true_dynamic_stiffness"].dtype == complex
    assert np.isfinite(cube["true_dynamic_stiffness"]).all()
    axial, radial = true_grids(cube)
    assert (axial.direction, radial.direction) == ("axial", "radial")
    assert [axial.rows[0].cells[0].mean, radial.rows[0].cells[0].mean] == list(true)
    # one law for it, and none for the pre-stressed state, which is the same
    table = powerlaw_table(cube).set_index(["direction", "source"])
    assert table.loc[("radial", AS_IT_STANDS), "n"] == 1
    laws = read_laws(powerlaw_table(cube), stiffness_summary(cube))
    listed = [law.source for law in laws[1].listed]
    assert AS_IT_STANDS in listed and PRESTRESSED not in listed
    # a mesh of 20 mm resolves no fold
    assert not axial.rows[0].cells[0].resolved
    ax = stiffness.draw(cube, "axial").axes[0]
    assert "as it stands: mean, min to max" in ax.get_legend_handles_labels()[1]
    # the energy that is left is the sum that the foil would give back
    crumple_values, _ = read_record(folder / "crumple.nc")
    parts = ("membrane", "bending", "stabilisation", "plastic_relief")
    left = sum(crumple_values[f"{name}_energy"] for name in parts)
    assert float(energy_left(cube).squeeze()) == pytest.approx(left, rel=1e-12)
    figure = energy.draw(cube)
    drawn = sum(patch.get_height() for patch in figure.axes[0].patches)
    assert drawn == pytest.approx(100, rel=1e-9)
    energies = history.draw([folder / "crumple.nc"]).axes[2]
    assert "left" in {text.get_text() for text in energies.texts}


def test_the_page_says_nothing_of_it_for_elastic_foil():
    cube = make_cube()
    assert true_grids(cube) == () and true_findings(cube) == []
    listed = read_laws(powerlaw_table(cube), stiffness_summary(cube))[0].listed
    assert AS_IT_STANDS not in {law.source for law in listed}
    internal = cube["membrane_energy"] + cube["bending_energy"] + cube["stabilisation_energy"]
    assert energy_left(cube).identical(internal)
    assert assess_mesh(cube).stabilisation_share


def test_the_page_says_how_many_would_run_away():
    cube = make_cube()
    loose = 0 * cube["steps"]
    loose[0, 0, 0] = 1.0
    cube["true_stiffness"] = cube["static_stiffness"]
    cube["true_ring_negative_eigenvalues"], cube["true_negative_eigenvalues"] = loose, 0 * loose
    (sentence,) = true_findings(cube)
    assert "1 would push a free top ring" in sentence


def test_strain_beyond_thin_shells_is_flagged():
    cube = make_cube()
    assert strain_findings(cube) == []
    cube["plastic_strain_max"] = 0 * cube["steps"] + 0.05
    assert strain_findings(cube) == []
    cube["plastic_strain_max"][0, 0, 0], cube["plastic_strain_max"][0, 1, 0] = 0.31, 0.12
    (sentence,) = strain_findings(cube)
    assert sentence.startswith(f"In 2 of {cube['steps'].size} foils")
    assert "0.12 to 0.31 at its worst point" in sentence


def test_what_is_more_than_elastic_costs_more_and_check_says_what_it_is(tmp_path, capsys):
    sections = {"sweep": {"thickness_um": [500], "reference_height_mm": [170]}}
    real = sections | {
        "material": {"law": "plastic", "relaxation_per_decade": 0.1},
        "method": {"path": "installation"},
        "installation": {"moves": [{"shorten_percent": 110}], "waiting_hours": 24},
        "specimen": {"ring_tilt_deg": 1},
    }
    elastic, plastic = (
        expected(load_config(each)).configurations[0].seconds_of for each in (sections, real)
    )
    assert 2 < plastic["crumple"] / elastic["crumple"] < 5
    assert plastic["response"] > 1.2 * elastic["response"]
    (tmp_path / "real.yaml").write_text(json.dumps(real))
    check(tmp_path / "real.yaml")
    said = capsys.readouterr().out
    for words in (
        "plastic from 12 MPa on",
        "ring_tilt_deg 1",
        "with 1 move of the ring",
        "24 hours",
    ):
        assert words in said
