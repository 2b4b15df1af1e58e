"""Crumple in memory, in one call, and what is recorded of it."""

import sys
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import FEP
from test_problem import sliding

import foilstudy
from foilstudy import Crumpled, Foil, Imperfection, Mesh, Method, crumple
from foilstudy.base.record import read_record
from foilstudy.base.registry import Choice
from foilstudy.base.spec import dumped, loaded, plain
from foilstudy.config import load_config
from foilstudy.config.foils import foil_of
from foilstudy.config.scene import recipe_of
from foilstudy.measure.choices import REDUCTIONS, STRESS_REMOVALS, STRUCTURAL_DAMPINGS
from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.model.imperfections import IMPERFECTIONS
from foilstudy.model.materials import MATERIALS, material
from foilstudy.model.patch import knot_points, refine
from foilstudy.model.shell.elements import ELEMENTS, LESSER_MODELS
from foilstudy.model.shell.material import LAWS
from foilstudy.model.shell.material.elastic import Elastic
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.measures import STIFFNESS_MEASURES
from foilstudy.solve.choices import DAMPINGS, MASSES, PATHS, SEARCHES
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.pace import SLOWNESS
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.sweep.crumple import crumple_job, values_of
from foilstudy.study.sweep.quantities import quantities

FOIL = Foil(0.2, 0.15, 0.13, 500e-6, material("FEP"))
COARSE = Mesh(15e-3)
QUICK = Method(RelaxationPath(200))


@pytest.fixture(scope="module")
def crumpled():
    return crumple(FOIL, COARSE, Imperfection(seed=3), QUICK)


def test_one_call_gives_a_stable_equilibrium_that_says_what_it_is(crumpled):
    assert (crumpled.status, crumpled.arrival.negative_eigenvalues) == ("converged", 0)
    assert crumpled.points[2].max() - crumpled.points[2].min() < FOIL.reference_height
    assert repr(crumpled) == (
        "<Crumpled: 500 µm FEP, diameter 200 mm, 150 mm in a gap of 130 mm, 15 mm corner elements, "
        "converged>"
    )


def test_measurements_follow_in_one_call_each(crumpled):
    axial, radial = crumpled.stiffness()
    assert 0 < axial and 0 < radial
    limit = crumpled.mesh_limit(1)
    assert np.array_equal(limit.levels[0], [axial, radial]) and len(limit.levels) == 2
    assert (crumpled.prestressed_stiffness() < crumpled.stiffness()).all()
    vibration = crumpled.vibration(DynamicsOptions(highest_hz=100.0, frequencies=5))
    # at rest the transfer stiffness is the static one
    quasi_static = vibration.dynamic_stiffness[0, :, 0].real
    np.testing.assert_allclose(quasi_static, crumpled.stiffness(), rtol=1e-2)
    assert len(repr(vibration)) < 150 and len(repr(limit)) < 150


def test_refined_it_has_the_same_surface_and_settles_lower(crumpled):
    fine = crumpled.refined()
    coarse_knots, fine_knots = knot_points(crumpled.points), knot_points(fine.points)
    np.testing.assert_allclose(fine_knots[:, ::2, ::2], coarse_knots, rtol=0, atol=1e-15)
    settled = fine.settled()
    assert settled.status == "converged"
    assert settled.energies().total < fine.energies().total


def test_a_ramp_on_a_coarser_mesh_ends_on_the_one_asked_for():
    mesh = Mesh(7.5e-3, ramp_coarsenings=1)
    assert mesh.patch(FOIL) == mesh.of_ramp().patch(FOIL).refined()
    crumpled = crumple(FOIL, mesh, Imperfection(seed=3), QUICK)
    assert (crumpled.status, crumpled.arrival.negative_eigenvalues) == ("converged", 0)
    assert crumpled.arrival.residual <= 1e-8
    start = uncrumpled(FOIL, mesh, Imperfection(seed=3), QUICK)
    assert crumpled.patch == start.patch.refined() == mesh.patch(FOIL)
    assert np.array_equal(crumpled.reference, refine(start.reference))
    # work and history are those of both meshes
    pushed = QUICK.path.push(start.problem(), FOIL.shortening)
    settled = QUICK.path.settle(crumpled.problem(), refine(pushed.points))
    assert np.array_equal(settled.points, crumpled.points)
    assert crumpled.arrival.steps == pushed.steps + settled.steps
    assert np.array_equal(crumpled.arrival.history.residual, pushed.history.residual)
    assert set(crumpled.arrival.costs) == {"relaxing", "settling"}


def test_every_mesh_between_that_of_the_ramp_and_the_last_is_relaxed():
    crumpled = crumple(FOIL, Mesh(3.75e-3, ramp_coarsenings=2), Imperfection(seed=3), QUICK)
    assert (crumpled.status, crumpled.arrival.negative_eigenvalues) == ("converged", 0)
    assert crumpled.patch == Mesh(15e-3).patch(FOIL).refined().refined()


@pytest.mark.parametrize("height", [0.17, 0.25])
def test_an_elastic_foil_has_one_shape_whatever_its_modulus(height):
    """All forces, masses and stiffnesses scale with it, and by powers of four without rounding."""
    soft, stiff = (
        crumple(
            replace(FOIL, reference_height=height, material=replace(FEP, youngs_modulus=modulus)),
            COARSE, Imperfection(), QUICK,
        )
        for modulus in (325e6, 1300e6)
    )  # fmt: skip
    assert soft.status == "converged"
    assert np.abs(stiff.points - soft.points).max() < 1e-12
    assert stiff.stiffness() == pytest.approx(4 * soft.stiffness(), rel=1e-9)


def test_it_can_be_looked_at(crumpled):
    axes = crumpled.plot()
    (image,) = axes.images
    assert image.get_array()[..., 3].max() > 0
    assert axes.get_title().startswith("500 µm FEP")


def test_a_job_records_what_the_call_returns(tmp_path):
    """The study of one cell, and the same in memory, to the last bit; the file needs no task."""
    study = load_config(
        {
            "sweep": {"thickness_um": [500], "reference_height_mm": [150], "realisations": 1},
            "mesh": {"element_size_mm": 15, "element": "one_point"},
            "relaxation": {"ramp_steps": 200},
        }
    )
    task = study.crumple_task(study.cells()[0])
    crumple_job(task, tmp_path / "crumple.nc")
    foil, recipe = foil_of(task), recipe_of(task)
    called = crumple(foil, recipe.mesh, recipe.imperfection, recipe.method)
    back = Crumpled.recorded(tmp_path / "crumple.nc")
    assert (back.foil, back.recipe) == (foil, recipe)
    assert back.patch == called.patch and back.element == called.element
    assert np.array_equal(back.points, called.points)
    assert np.array_equal(back.reference, called.reference)
    assert (back.status, back.message) == (called.status, called.message)
    assert back.arrival.steps == called.arrival.steps
    _, attributes = read_record(tmp_path / "crumple.nc")
    assert type(task).model_validate_json(attributes["task"]) == task


def test_what_is_no_crumple_is_refused(tmp_path):
    study = load_config(
        {
            "sweep": {"thickness_um": [500], "reference_height_mm": [150], "realisations": 1},
            "mesh": {"element_size_mm": 15},
            "imperfection": {"amplitude_um": 1e6},
            "relaxation": {"ramp_steps": 20, "relaxation_steps_max": 20},
        }
    )
    crumple_job(study.crumple_task(study.cells()[0]), tmp_path / "crumple.nc")
    with pytest.raises(ValueError, match=r"crumple\.nc: the realisation has left no shape \(div"):
        Crumpled.recorded(tmp_path / "crumple.nc")


class Sliding(Elastic):
    """A law with a memory: a slider between one point of the foil and where it stood."""

    def terms(self, shell):
        return (sliding(shell, yield_force=0.5),)


def test_a_law_with_a_memory_is_one_class_and_one_line(monkeypatch):
    """Its state, energies and history come out of the same call and go into the same record."""
    monkeypatch.setitem(sys.modules, "foilstudy.sliding", SimpleNamespace(Sliding=Sliding))
    monkeypatch.setitem(LAWS.choices, "sliding", Choice("sliding:Sliding", "slides"))
    foil = replace(FOIL, material=replace(material("FEP"), law="sliding"))
    crumpled = crumple(foil, COARSE, Imperfection(seed=3), QUICK)
    assert crumpled.status == "converged", crumpled.message
    *without_memory, anchor = crumpled.arrival.state
    assert without_memory == [None] and anchor != crumpled.problem().terms[1].rest
    values = quantities(values_of(crumpled))
    slider = crumpled.problem().terms[1]
    stretch = crumpled.points[2, slider.row, slider.column] - anchor
    assert values["slider_energy"].values == pytest.approx(0.5 * slider.stiffness * stretch**2)
    assert values["history_slider_energy"].values[-1] == values["slider_energy"].values
    again = crumpled.settled()
    assert (again.arrival.steps, again.arrival.state) == (0, crumpled.arrival.state)
    assert np.array_equal(again.points, crumpled.points)


METHODS = [
    Method(),
    Method(RelaxationPath(77, settling=SettleOptions(1e-6, search="quasi_newton"))),
    FOIL,
    Imperfection("smoothed", 1e-5, 0.015, 4),
    Mesh(2.5e-3, "one_point"),
    DynamicsOptions(reduction="guyan", cutoff_hz=100.0),
]


@pytest.mark.parametrize("spec", METHODS, ids=lambda spec: type(spec).__name__)
def test_a_specification_comes_back_from_its_record(spec):
    assert loaded(type(spec), dumped(spec)) == spec
    hash(spec)  # nothing in it can change


def test_a_record_of_another_release_is_refused():
    content = dumped(FOIL).replace("gap_height", "gap")
    with pytest.raises(ValueError, match="from another release: its Foil has"):
        loaded(Foil, content)


@pytest.mark.parametrize(
    "registry",
    [ELEMENTS, LAWS, IMPERFECTIONS, MASSES, DAMPINGS, SEARCHES, PATHS, STRESS_REMOVALS,
     REDUCTIONS, STRUCTURAL_DAMPINGS, STIFFNESS_MEASURES, LESSER_MODELS],
    ids=lambda registry: registry.kind,
)  # fmt: skip
def test_every_choice_can_be_loaded_and_knows_its_name(registry):
    for name in registry:
        choice = registry[name]
        assert callable(choice)
        assert getattr(choice, "kind", getattr(choice, "name", name)) == name
    with pytest.raises(ValueError, match=f"is not a known {registry.kind}; use one of"):
        registry["nothing"]


def test_a_strategy_of_a_configuration_reaches_the_method():
    mass = {"kind": "spectral", "safety": 1.5, "single": False}
    assert plain(Method())["path"]["scheme"]["mass"] == mass
    study = load_config(
        {
            "sweep": {"thickness_um": [500], "reference_height_mm": [150]},
            "relaxation": {"ramp_steps": 123, "check_interval": 7},
        }
    )
    path = recipe_of(study.crumple_task(study.cells()[0])).method.path
    assert (path.ramp_steps, path.check_interval) == (123, 7)


@pytest.mark.parametrize("thickness_um", [25, 50, 130, 500, 1000])
def test_without_a_method_a_foil_is_crumpled_as_by_a_study(thickness_um):
    """Steps of ramp and rest as R/t, which at 500 um of the published case are those of a path."""
    sweep = {"thickness_um": [thickness_um], "reference_height_mm": [150]}
    study = load_config({"sweep": sweep, "material": {"name": "FEP"}})
    foil = replace(FOIL, thickness=thickness_um * 1e-6)
    method = uncrumpled(foil, COARSE).method
    assert method == recipe_of(study.crumple_task(study.cells()[0])).method
    assert method.path.ramp_steps == round(SLOWNESS * 0.1 / foil.thickness)
    assert (method == Method()) == (thickness_um == 500)


def test_materials_are_known_by_name():
    assert replace(material("FEP"), name="") == FEP
    assert {material(name).name for name in MATERIALS} == set(MATERIALS)
    with pytest.raises(ValueError, match="'tin' is not a known material; use one of FEP"):
        material("tin")


def test_the_face_of_the_package_lists_what_it_has():
    assert {"Foil", "crumple", "open_cube", "__version__"} <= set(dir(foilstudy))
    assert all(getattr(foilstudy, name).__name__ == name for name in foilstudy.__all__)
