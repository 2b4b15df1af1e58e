"""Contact as a thing of studies: keys, jobs, records, cube."""

import numpy as np
import pytest
import xarray as xr
import yaml

from foilstudy.base.cube import open_cube
from foilstudy.base.record import read_record
from foilstudy.config import ResponseTask, load_config
from foilstudy.config.scene import dynamics_of, recipe_of
from foilstudy.linalg import SolveError
from foilstudy.measure.verdicts import names_of
from foilstudy.pipeline import one_sided as one_sided_module
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.one_sided import one_sided
from foilstudy.present.datasheet.facts import link_facts
from foilstudy.present.datasheet.page import write_datasheet
from foilstudy.present.files import StudyFiles
from foilstudy.present.report import write_report
from foilstudy.present.report.small_motions import (
    bracket_findings,
    bracket_picture,
    bracket_rows,
    secant_findings,
    secant_rows,
)
from foilstudy.present.statistics.tables import write_tables
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cube import gather, has
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.expected import expected
from foilstudy.study.sweep.origins import cell_folder, crumple_origin
from foilstudy.study.sweep.quantities import QUANTITIES
from foilstudy.study.sweep.respond import respond_job

BARRIER = {"kind": "barrier"}
FIRM = {"law": "plastic", "yield_stress_mpa": 60.0}
"""Coarse elements of softer foil fold flat before anything touches."""


DYNAMICS = {"shown_max_hz": 30, "frequencies": 3, "reduction": "guyan"}


def study_with(**sections):
    content = {
        "study": {"name": "touching"},
        "sweep": {"thickness_um": [500], "overlength_percent": [120], "realisations": 1},
        "mesh": {"element_size_mm": 18},
        "relaxation": {"ramp_steps": 200},
        "stiffness": {"refinements": 0},
        "dynamics": DYNAMICS,
    }
    return load_config(content | sections)


def refusal(**sections):
    with pytest.raises(Exception) as caught:
        study_with(**sections)
    return str(caught.value)


def test_what_contact_cannot_go_with_is_refused_with_its_keys():
    assert "contact.reach_mm is given, but contact.kind is none" in refusal(
        contact={"reach_mm": 1.0}
    )
    assert "needs larger elements than 17.9 mm; reduce the reach to 7.2 mm" in refusal(
        contact=BARRIER | {"reach_mm": 9.0}
    )
    # thickness and reach together
    thick = {"thickness_um": [3000], "overlength_percent": [150], "realisations": 1}
    words = refusal(contact=BARRIER | {"reach_mm": 0.9}, sweep=thick, mesh={"element_size_mm": 5})
    assert "take a coarser mesh" in words
    for sections, key in (
        ({"method": {"path": "newton"}}, "method.path: newton"),
        ({"method": {"damping": "kinetic"}}, "method.damping: kinetic"),
        ({"mesh": {"element_size_mm": 6, "ramp_coarsenings": 1}}, "mesh.ramp_coarsenings is 1"),
        ({"stiffness": {"relaxed_refinements": 1}}, "stiffness.relaxed_refinements is 1"),
    ):
        assert key in refusal(contact=BARRIER, **sections)
        study_with(**sections)


def test_contact_is_part_of_what_a_crumple_was_made_of():
    without, touching = study_with(), study_with(contact=BARRIER | {"reach_mm": 0.8})
    tasks = [study.crumple_task(study.cells()[0]) for study in (without, touching)]
    assert recipe_of(tasks[0]).method.contact.kind == "none"
    contact = recipe_of(tasks[1]).method.contact
    assert (contact.kind, contact.reach, contact.ring_planes) == ("barrier", 0.8e-3, False)
    assert crumple_origin(tasks[0]).code != crumple_origin(tasks[1]).code
    cost = [
        expected(study).configurations[0].seconds_of["crumple"] for study in (without, touching)
    ]
    assert 2 < cost[1] / cost[0] < 8


@pytest.fixture(scope="module")
def touching(tmp_path_factory):
    """The records of a plastic foil with contact, and its study."""
    study = study_with(
        contact=BARRIER | {"ring_planes": True},
        material=FIRM,
        stiffness={"refinements": 0, "one_sided": ["axial"]},
        dynamics=DYNAMICS | {"contacts": ["normal", "stuck"]},
    )
    results = tmp_path_factory.mktemp("touching")
    (cell,) = study.cells()
    folder = cell_folder(results, cell)
    folder.mkdir(parents=True)
    crumple_job(study.crumple_task(cell), folder / "crumple.nc")
    respond_job(study.response_task(cell), folder / "crumple.nc", folder / "response.nc")
    cylinder_bounds(study, results / "cylinder.nc")
    return study, results, folder


def test_a_record_is_read_back_with_its_contact(touching):
    _, _, folder = touching
    values, attributes = read_record(folder / "crumple.nc")
    assert attributes["status"] == "converged", attributes["message"]
    assert values["contact_pairs"] > 0 < values["contact_gap_min"]
    assert 0 < values["contact_share"] < 1 < values["contact_shortened_steps"]
    assert values["self_crossing_share"] == 0
    crumpled = Crumpled.recorded(folder / "crumple.nc")
    assert crumpled.method.contact.ring_planes
    force = np.empty_like(crumpled.points)
    problem = crumpled.problem()
    energies = dict(zip(problem.energy_names, problem.force(crumpled.points, force), strict=True))
    assert energies["contact"] > 0
    assert energies["contact"] == pytest.approx(float(values["contact_energy"]), rel=1e-12)
    rings = np.linalg.norm(np.concatenate([force[:, :2], force[:, -2:]], axis=1))
    assert np.linalg.norm(force[:, 2:-2]) < 1e-8 * rings
    assert problem.numbers()["plastic_share"] == pytest.approx(float(values["plastic_share"]))
    assert problem.numbers()["contact_pairs"] == values["contact_pairs"]
    assert crumpled.arrival.shortened_steps == values["contact_shortened_steps"]


def test_the_cube_has_the_bracket_and_what_touches(touching):
    study, results, folder = touching
    cube = gather(study, results, results / "cube.nc")
    names = [f"stiffness_contacts_{kind}" for kind in ("ignored", "normal", "rigid", "stuck")]
    bracket = np.array([cube[name].values.reshape(2) for name in names])
    assert (np.diff(bracket, axis=0) >= 0).all() and (bracket[-1] > bracket[0]).all()
    assert np.allclose(bracket[0], cube["static_stiffness"].values.ravel(), rtol=1e-6)
    assert float(cube["contact_gap_min"].squeeze()) > 0
    assert cube["contact_gap_min"].attrs["units"] == "um"
    assert "self_crossing" not in names_of(float(cube["verdict"].squeeze()))
    crumpled = Crumpled.recorded(folder / "crumple.nc")
    low = [
        abs(crumpled.vibration(contacts=kind).dynamic_stiffness[0, 0, 0])
        for kind in ("ignored", "normal", "stuck")
    ]
    assert low == pytest.approx(bracket[[0, 1, 3], 0], rel=0.02)


def test_the_cube_has_the_dynamic_bracket_and_both_secants(touching, tmp_path):
    study, results, folder = touching
    gather(study, results, tmp_path / "cube.nc")
    cube = open_cube(tmp_path / "cube.nc").squeeze()
    at_rest = cube.sel(definition="transfer").isel(frequency=0)
    crumpled = Crumpled.recorded(folder / "crumple.nc")
    options = dynamics_of(study.dynamics)
    for kind in ("normal", "stuck"):
        static = cube[f"stiffness_contacts_{kind}"]
        dynamic = at_rest[f"dynamic_stiffness_contacts_{kind}"]
        np.testing.assert_allclose(abs(dynamic), static, rtol=0.02)
        vibration = crumpled.vibration(options, contacts=kind)
        found = cube[f"eigenfrequency_contacts_{kind}"]
        np.testing.assert_allclose(found, vibration.eigenfrequencies, rtol=1e-6)
        assert (found >= (1 - 1e-9) * cube["eigenfrequency"]).all()  # springs are never negative
    assert "dynamic_stiffness_contacts_rigid" not in cube
    secants = one_sided(crumpled, "axial")
    both = cube[["stiffness_loading", "stiffness_unloading"]].to_array()
    assert both.sel(direction="axial").values == pytest.approx(
        [secants.loading, secants.unloading], rel=1e-6
    )
    assert np.isnan(both.sel(direction="radial")).all()


def test_the_page_and_the_data_sheet_show_the_bracket_and_both_secants(touching, tmp_path):
    study, results, _ = touching
    gather(study, results, tmp_path / "cube.nc")
    files = StudyFiles.found(tmp_path / "cube.nc")
    write_tables(files.cube, files.folder)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    assert "In 1 of 1 configuration parts of the foil touch" in page
    for words in (
        "closed as springs",
        "Dynamic stiffness by what closed contacts do",
        "apart, or the other way",
    ):
        assert words in page
    cube = open_cube(tmp_path / "cube.nc")
    (row,) = bracket_rows(cube)
    stuck, opened = (cube[f"stiffness_contacts_{kind}"].squeeze() for kind in ("stuck", "ignored"))
    assert row.stiffness["axial", "stuck"] == stuck[0]
    assert row.factor["radial"] == stuck[1] / opened[1]
    assert (row.touching, row.n) == (1, 1)
    assert row.contacts == cube["contact_pairs"] + cube["contact_knots_at_rings"]
    assert [each.direction for each in secant_rows(cube)] == ["axial"]
    axial, radial = link_facts(cube).directions
    assert set(radial.beside) == {"contacts open", "contacts stuck", "as it stands"}
    assert set(axial.beside) == {
        *radial.beside,
        "as it stands, pushed together",
        "as it stands, pulled apart",
    }
    # of a negative one, too, as the page has it
    (stands,) = (row.as_it_stands for row in secant_rows(cube))
    assert axial.beside["as it stands"].interval.mean == pytest.approx(stands)
    write_datasheet(cube, tmp_path / "sheet.html")
    assert "axial, contacts stuck, N/m" in (tmp_path / "sheet.html").read_text("utf-8")


def altered(touching, folder, **values):
    """The cube of the foil that touches, with other values of some quantities."""
    study, results, _ = touching
    gather(study, results, folder / "cube.nc")
    cube = open_cube(folder / "cube.nc")
    return cube.assign({k: xr.full_like(cube[k], 1.0) * np.array(v) for k, v in values.items()})


def test_a_data_sheet_has_no_bracket_where_nothing_touches(touching, tmp_path):
    nowhere = altered(touching, tmp_path, contact_pairs=0.0, contact_knots_at_rings=np.nan)
    missing = nowhere.assign_coords(seed=[1]).copy(deep=True)
    missing["status"] = missing["status"].astype(object)
    missing["status"][:] = "not_needed"
    both = xr.concat([nowhere, missing], "seed", data_vars="all")
    assert not any("contacts" in words for words in link_facts(both).directions[0].beside)


def test_planes_alone_are_contact_and_no_contact_at_all_is_said(touching, tmp_path):
    planes = altered(touching, tmp_path, contact_pairs=0.0, contact_knots_at_rings=40.0)
    assert [row.contacts for row in bracket_rows(planes)] == [40.0]
    nowhere = altered(touching, tmp_path, contact_pairs=0.0, contact_knots_at_rings=np.nan)
    assert not bracket_rows(nowhere) and "in none of the shapes" in bracket_findings(nowhere)[0]
    assert bracket_picture(nowhere) == ("", b"")


def test_means_of_the_bracket_are_those_of_the_foils_that_touch(touching, tmp_path):
    cube = altered(touching, tmp_path)
    other = altered(
        touching, tmp_path, contact_pairs=0.0, contact_knots_at_rings=np.nan,
        stiffness_contacts_stuck=1.0, stiffness_contacts_ignored=1.0,
    ).assign_coords(seed=[1])  # fmt: skip
    (row,) = bracket_rows(xr.concat([cube, other], "seed", data_vars="all"))
    (alone,) = bracket_rows(cube)
    assert (row.touching, row.n) == (1, 2)
    assert row.factor == alone.factor and row.stiffness == alone.stiffness


def test_what_is_said_of_both_ways_follows_their_signs(touching, tmp_path):
    ways = {"stiffness_loading": [900.0, np.nan], "stiffness_unloading": [2000.0, np.nan]}
    positive = altered(touching, tmp_path, **ways, true_stiffness=[1000.0, 1.0])
    assert (
        "axially 0.90 times pushed together and 2.00 times pulled apart"
        in secant_findings(positive)[-1]
    )
    negative = altered(touching, tmp_path, **ways, true_stiffness=[-1000.0, 1.0])
    assert len(secant_findings(negative)) == 1 and secant_rows(negative)[0].as_it_stands == -1000
    ways["stiffness_unloading"] = [np.nan, np.nan]
    assert "No foil found" in secant_findings(altered(touching, tmp_path, **ways))[0]


def test_where_nothing_touches_the_dynamic_bracket_costs_nothing(tmp_path, monkeypatch):
    few = {"thickness_um": [500], "overlength_percent": [5], "realisations": 1}
    contacts = DYNAMICS | {"contacts": ["stuck"]}
    study = study_with(contact=BARRIER, sweep=few, dynamics=contacts)
    (cell,) = study.cells()
    crumple_job(study.crumple_task(cell), tmp_path / "crumple.nc")
    monkeypatch.setattr(Crumpled, "vibration", None)
    respond_job(study.response_task(cell), tmp_path / "crumple.nc", tmp_path / "response.nc")
    values, _ = read_record(tmp_path / "response.nc")
    for name in ("dynamic_stiffness_{}re", "dynamic_stiffness_{}im", "eigenfrequency{}"):
        stuck = "_contacts_stuck" if name.endswith("{}") else "contacts_stuck_"
        np.testing.assert_array_equal(values[name.format(stuck)], values[name.format("")])


def test_small_motions_of_which_the_answer_is_known_are_refused():
    sides = {"refinements": 0, "one_sided": ["axial"]}
    assert "set material.law: plastic" in refusal(stiffness=sides)
    assert "set contact.kind: barrier" in refusal(dynamics=DYNAMICS | {"contacts": ["stuck"]})
    twice = {"refinements": 0, "one_sided": ["axial", "axial"]}
    assert "names one twice" in refusal(stiffness=twice, contact=BARRIER)
    study_with(stiffness=sides, contact=BARRIER)


def test_what_is_not_asked_for_leaves_no_trace_in_tasks_and_cubes():
    plain = study_with(contact=BARRIER)
    told = plain.to_yaml() + plain.response_task(plain.cells()[0]).model_dump_json()
    assert "one_sided" not in told and "contacts" not in told
    sides = {"refinements": 0, "one_sided": ["axial", "radial"]}
    asked = study_with(
        contact=BARRIER, stiffness=sides, dynamics=DYNAMICS | {"contacts": ["stuck"]}
    )
    task = asked.response_task(asked.cells()[0])
    assert ResponseTask.model_validate_json(task.model_dump_json()) == task
    assert load_config(yaml.safe_load(asked.to_yaml())) == asked
    dear, cheap = (
        expected(each).configurations[0].seconds_of["response"] for each in (asked, plain)
    )
    assert dear > 2 * cheap


def test_what_cannot_be_measured_is_left_out_and_said(touching, tmp_path, monkeypatch):
    study, _, folder = touching
    monkeypatch.setattr(one_sided_module, "minimised", _singular)
    monkeypatch.setattr(Crumpled, "vibration", _singular)
    (cell,) = study.cells()
    respond_job(study.response_task(cell), folder / "crumple.nc", tmp_path / "response.nc")
    values, attributes = read_record(tmp_path / "response.nc")
    assert attributes["status"] == "converged" and np.isfinite(values["static_stiffness"]).all()
    for name in ("stiffness_loading", "dynamic_stiffness_contacts_stuck_re"):
        assert np.isnan(values[name]).all()
    assert "not both secants (axial)" in attributes["message"]
    assert "dynamic stiffness with closed contacts (normal, stuck) not" in attributes["message"]


def _singular(*_):
    raise SolveError("singular")


def test_without_contact_nothing_speaks_of_it():
    study = study_with()
    assert study.crumple_task(study.cells()[0]).contact.kind == "none"
    touching = [what for what in QUANTITIES.values() if what.only == "touching"]
    assert touching and not any(has(study, what) for what in touching)
