"""What a user in Python meets first: names, reprs, materials by name, refused slips."""

import re
from dataclasses import replace

import numpy as np
import pytest
from conftest import FEP, FOIL, cylinder

import foilstudy
from foilstudy.base.errors import Refusal
from foilstudy.config import load_config
from foilstudy.export.contents import Contents
from foilstudy.measure.dynamics import (
    DynamicsOptions,
    EvenGrid,
    ModalDamping,
    RayleighDamping,
    StructuralDamping,
    Wanted,
    frequency_grid,
    full_order,
    interface_dynamic_stiffness,
    receptance,
)
from foilstudy.measure.dynamics.reductions.hintz_herting import HintzHerting
from foilstudy.measure.stiffness import Rings
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.materials import MATERIALS, Material, material
from foilstudy.model.patch import Patch
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.structures import stress_free_structure
from foilstudy.pipeline.surface import SurfaceGrid, sheet_from_grid

OPTIONS = DynamicsOptions(highest_hz=100.0, frequencies=5)


def test_the_package_shows_its_public_names_and_no_other():
    assert set(dir(foilstudy)) == {*foilstudy.__all__, "__version__"}
    for name in dir(foilstudy):
        assert getattr(foilstudy, name) is not None


@pytest.fixture(scope="module")
def start():
    return uncrumpled(FOIL, Mesh(15e-3))


@pytest.fixture(scope="module")
def structure(start):
    return stress_free_structure(start)


@pytest.fixture(scope="module")
def model(structure):
    return OPTIONS.reduced(structure)


def test_what_a_user_prints_fits_two_lines(start, structure, model):
    objects = [
        FOIL, FEP, Mesh(5e-3), Imperfection(), Method(), OPTIONS, start, start.recipe, start.patch,
        start.stressed, start.stressed.section, start.energies(), start.mesh_limit(0),
        structure, structure.stiffness, structure.static, model, start.vibration(OPTIONS),
        Rings.of(start.patch, start.points), Contents.of(start, OPTIONS),
        EvenGrid.of(model, OPTIONS.damping, 1.0, 100.0), load_config("config/thesis.yaml"),
    ]  # fmt: skip
    for each in objects:
        assert 10 < len(repr(each)) <= 210 and "\n" not in repr(each), type(each)
    assert str(load_config("config/thesis.yaml")) == (
        "<StudyConfig: thesis, 4 thicknesses x 5 heights x 6 realisations>"
    )
    assert repr(replace(FOIL, material="FEP")) == (
        "<Foil: 500 µm FEP, diameter 200 mm, 170 mm in a gap of 130 mm>"
    )


# --- materials by name ---------------------------------------------------------------------------


def test_a_material_may_be_a_name_everywhere():
    fep = material("FEP")
    assert material(fep) is fep and Foil(0.2, 0.17, 0.13, 5e-4, "FEP").material == fep
    sheet = cylinder(20e-3)
    named = Shell.elastic(sheet.patch, sheet.reference, "FEP", 5e-4)
    assert named.material == fep
    angle, height = np.meshgrid(np.linspace(0, 2 * np.pi, 49)[:-1], np.linspace(0, 0.13, 11))
    points = np.stack([0.1 * np.cos(angle), 0.1 * np.sin(angle), height], axis=-1)
    assert sheet_from_grid(SurfaceGrid(points), 1e-4, "PET").foil.material == material("PET")


@pytest.mark.parametrize(
    ("name", "hint"), [("fep", "FEP"), ("Aluminum", "aluminium"), ("stainles steel", "stainless")]
)
def test_an_unknown_material_is_refused_with_the_closest_one(name, hint):
    with pytest.raises(Refusal, match=f"{name}' is not a known material; did you mean {hint}"):
        Foil(0.2, 0.17, 0.13, 5e-4, name)


def test_a_material_like_no_other_gets_the_list():
    with pytest.raises(Refusal) as refusal:
        material("xyz")
    assert "did you mean" not in str(refusal.value)
    assert all(name in str(refusal.value) for name in MATERIALS)


# --- slips ---------------------------------------------------------------------------------------

SLIPS = {
    "thickness of a foil is -5e-05 m": lambda: replace(FOIL, thickness=-50e-6),
    "thickness of a foil is nan m": lambda: replace(FOIL, thickness=np.nan),
    "thickness of a foil is 0.5 m; .* below 0.1 m": lambda: replace(FOIL, thickness=0.5),
    "diameter of a foil is 200 m; .* at most 10 m": lambda: replace(FOIL, diameter=200),
    "gap height of a foil is 0 m": lambda: replace(FOIL, gap_height=0),
    "reference height of a foil is '170 mm' m": lambda: replace(FOIL, reference_height="170 mm"),
    "reference height of a foil is 0.1 m, in a gap of 0.13 m": lambda: crumple(
        replace(FOIL, reference_height=0.1)
    ),
    "Young's modulus of a material is -6.5e.08 Pa": lambda: replace(FEP, youngs_modulus=-650e6),
    "Poisson's ratio of a material is 0.6; .* above -1 and of at most 0.5": lambda: replace(
        FEP, poisson_ratio=0.6
    ),
    "density of a material is 0 kg/m3": lambda: Material(1e9, 0.3, 0.0, 1e6),
    "yield stress of a material is inf Pa": lambda: Material(1e9, 0.3, 1.0, np.inf),
    "amplitude of an imperfection is -1e-05 m": lambda: Imperfection(amplitude=-1e-5),
    "correlation length of an imperfection is -1 m": lambda: Imperfection(correlation_length=-1),
    "seed of an imperfection is 1.5; give a whole number": lambda: Imperfection(seed=1.5),
    "element size of a mesh is 0 m": lambda: Mesh(0.0),
    "'cornr' is not a known element; did you mean corner": lambda: Mesh(5e-3, "cornr"),
    "element of a cylinder's patch is -0.005 m": lambda: Patch.for_cylinder(0.2, 0.1, -5e-3),
    "thickness of a shell is 0 m": lambda: cylinder(20e-3, thickness=0.0),
    "share of the critical damping is 5; .* of at least 0 and below 1": lambda: ModalDamping(5),
    "share of the critical damping is -0.1": lambda: ModalDamping(-0.1),
    "loss factor is 3; ": lambda: StructuralDamping(3),
    "mass coefficient of Rayleigh damping is -1 1/s": lambda: RayleighDamping(-1.0, 0.0),
    "upper frequency of Rayleigh damping is 10 Hz; .* above 20 Hz": lambda: RayleighDamping.between(
        0.05, 20.0, 10.0
    ),
    "tolerance of a reduction is 1; ": lambda: Wanted(1.0),
    "a band from 800 to 1 Hz is none": lambda: DynamicsOptions(lowest_hz=800, highest_hz=1),
    "cut-off of a reduction is -1 Hz": lambda: DynamicsOptions(cutoff_hz=-1),
    "cut-off of a reduction is 0 Hz": lambda: HintzHerting(0.0),
    "number of frequencies is 1; give a whole number of at least 2": lambda: DynamicsOptions(
        frequencies=1
    ),
    "number of mode shapes is -1": lambda: DynamicsOptions(mode_shapes=-1),
    "'rational' is not a known reduction; did you mean": lambda: DynamicsOptions(
        reduction="rational"
    ),
    "a band from 0 to 800 Hz is none": lambda: frequency_grid(0, 800, 10),
}


@pytest.mark.parametrize("sentence", SLIPS)
def test_a_slip_is_refused_in_one_sentence(sentence):
    with pytest.raises(Refusal) as refusal:
        SLIPS[sentence]()
    text = str(refusal.value)
    assert re.search(sentence, text), text
    assert text.endswith(".") and "\n" not in text and len(text) < 200


GRIDS = {
    "3 Hz follows 5 Hz": [1.0, 5.0, 3.0],
    "5 Hz follows 5 Hz": [1.0, 5.0, 5.0, 7.0],
    "positive frequencies": [-1.0, 2.0],
    "positive  ?frequencies": [np.nan, 2.0],
    "one or several positive": [1.0, np.inf],
    "several positive frequencies": [[1.0, 2.0]],
}


@pytest.mark.parametrize("sentence", GRIDS)
def test_frequencies_that_do_not_rise_are_refused(structure, model, sentence):
    for respond in (
        lambda hz: interface_dynamic_stiffness(model, hz, ModalDamping(0.05)),
        lambda hz: receptance(model, hz, ModalDamping(0.05), "bottom_held"),
        lambda hz: full_order(structure, hz, ModalDamping(0.05)),
    ):
        with pytest.raises(Refusal, match=sentence):
            respond(np.array(GRIDS[sentence]))


def test_what_lies_on_a_bound_is_taken():
    assert ModalDamping(0.0).ratio == 0 and Imperfection(amplitude=0.0).amplitude == 0
    assert Material(1e9, 0.5, 1.0, 1.0).poisson_ratio == 0.5
    assert Imperfection(seed=np.int64(3)).seed == 3
