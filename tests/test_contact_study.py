"""Contact as a thing of studies: keys, jobs, records, cube."""

import numpy as np
import pytest

from foilstudy.base.record import read_record
from foilstudy.config import load_config
from foilstudy.config.scene import recipe_of
from foilstudy.measure.verdicts import names_of
from foilstudy.pipeline.crumpled import Crumpled
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


def study_with(**sections):
    content = {
        "study": {"name": "touching"},
        "sweep": {"thickness_um": [500], "overlength_percent": [120], "realisations": 1},
        "mesh": {"element_size_mm": 18},
        "relaxation": {"ramp_steps": 200},
        "stiffness": {"refinements": 0},
        "dynamics": {"shown_max_hz": 30, "frequencies": 3, "reduction": "guyan"},
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
    study = study_with(contact=BARRIER | {"ring_planes": True}, material=FIRM)
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


def test_without_contact_nothing_speaks_of_it():
    study = study_with()
    assert study.crumple_task(study.cells()[0]).contact.kind == "none"
    touching = [what for what in QUANTITIES.values() if what.only == "touching"]
    assert touching and not any(has(study, what) for what in touching)
