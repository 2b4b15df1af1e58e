"""What the configuration accepts: every task can be made, `check` can say it, slips are named."""

import math

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st
from runs import STUDY_FILES

from foilstudy.command import main
from foilstudy.config import ConfigError, CrumpleTask, RefineTask, ResponseTask, load_config
from foilstudy.config.chosen import choices
from foilstudy.config.foils import foil_of, patch_of
from foilstudy.config.scene import dynamics_of, recipe_of
from foilstudy.config.slips import first_buckling, known_to_fail, likely_slips, unresolved
from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.supports.loads import edge_load
from foilstudy.solve.choices import DAMPINGS, MASSES
from foilstudy.solve.loading.buckling import buckling_modes
from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.study.published import FEP
from foilstudy.study.sweep.expected import costly, expected
from foilstudy.study.verification.candidates import CANDIDATES
from foilstudy.study.verification.stability import half_waves, radial_displacement, sliding_cell
from foilstudy.study.verification.theory_cylinder import Cylinder, classical_buckling_stress

FILES = STUDY_FILES
FOIL = {"thickness_um": [500], "reference_height_mm": [170]}


def spread(least, most):
    """Numbers of every order of magnitude, the ends among them."""
    logarithms = st.floats(math.log(least), math.log(most))
    inside = logarithms.map(lambda value: min(max(math.exp(value), least), most))
    return st.one_of(st.sampled_from([float(least), float(most)]), inside)


@st.composite
def contents(draw):
    """Contents of which a good part are accepted, to the corners of the ranges."""
    diameter, gap = draw(spread(1, 10_000)), draw(spread(1, 10_000))
    thickness = draw(spread(0.1, min(10_000, 25 * diameter)))
    sweep = {"thickness_um": [thickness], "realisations": draw(st.sampled_from([1, 3, 2000]))}
    percent = draw(st.lists(spread(0.01, 1000), min_size=1, max_size=3, unique=True))
    if draw(st.booleans()):
        sweep["overlength_percent"] = percent
    else:
        sweep["reference_height_mm"] = [gap * (1 + value / 100) for value in percent]
    size = min(math.pi * diameter / 24, gap / 8)
    coarser = draw(st.sampled_from([None, 1.0, 2.0, 7.0]))
    mesh = {"element_size_mm": "auto"} if coarser is None else {"element_size_mm": size / coarser}
    kind = draw(st.sampled_from(["gaussian", "smoothed", "buckling_modes"]))
    return {
        "sheet": {"diameter_mm": diameter, "gap_height_mm": gap},
        "material": {
            "name": draw(st.text(min_size=1, max_size=20)),
            "youngs_modulus_mpa": draw(spread(1e-3, 2e6)),
            "poisson_ratio": draw(st.sampled_from([-0.9, 0.0, 0.3, 0.5])),
            "density_kg_m3": draw(spread(0.1, 30_000)),
            "yield_stress_mpa": draw(spread(1e-6, 1e5)),
        },
        "sweep": sweep,
        "mesh": mesh,
        "imperfection": {"kind": kind, "amplitude_um": draw(spread(1e-9, 1e6))},
        "relaxation": {"residual_tolerance": draw(spread(1e-30, 0.9))},
        "stiffness": {
            "refinements": draw(st.integers(0, 3)),
            "relaxed_refinements": draw(st.integers(0, 2)),
        },
        "dynamics": {"shown_max_hz": draw(spread(2, 1e6)), "eigenfrequencies": 1000},
    }


@settings(
    max_examples=60,
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.filter_too_much, HealthCheck.function_scoped_fixture],
)
@given(content=contents())
def test_what_is_accepted_can_be_made_into_tasks(content, tmp_path, capsys):
    try:
        study = load_config(content)
    except ConfigError:
        assume(False)
    cells = study.cells()
    for cell in (cells[0], cells[-1]):
        assert study.cell(cell.thickness_id, cell.overlength_id, cell.seed) == cell
        task = study.crumple_task(cell)
        assert CrumpleTask.model_validate_json(task.model_dump_json()) == task
        assert foil_of(task).shortening > 0
        assert patch_of(task).elements_along >= 8
        assert recipe_of(task).mesh.element_size > 0
        response = study.response_task(cell)
        assert ResponseTask.model_validate_json(response.model_dump_json()) == response
        assert dynamics_of(response.dynamics).highest_hz > 0
        if study.stiffness.relaxed_refinements:
            refine = study.refine_task(cell)
            assert RefineTask.model_validate_json(refine.model_dump_json()) == refine
    assert load_config(yaml.safe_load(study.to_yaml())) == study
    path = tmp_path / "study.yaml"
    path.write_text(study.to_yaml(), encoding="utf-8")
    main(["check", str(path)])
    said = capsys.readouterr().out
    assert "no problem" in said
    assert all(slip in said for slip in [*likely_slips(study), *costly(expected(study))])


def test_a_height_is_bounded_whether_given_or_as_an_overlength():
    with pytest.raises(ConfigError, match="a height of 11700 mm over sheet.gap_height_mm"):
        load_config(
            {
                "sheet": {"gap_height_mm": 9000, "diameter_mm": 2000},
                "sweep": {"thickness_um": [500], "overlength_percent": [30]},
                "mesh": {"element_size_mm": 50},
            }
        )


# --- slips ----------------------------------------------------------------------------------------


def slips_of(**sections):
    content = {"sweep": FOIL, "mesh": {"element_size_mm": 5}}
    return likely_slips(load_config(content | sections))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_study_files_hold_no_slip(file):
    study = load_config(file)
    assert not likely_slips(study) and not costly(expected(study))
    assert not known_to_fail(study)


@pytest.mark.parametrize(
    ("sections", "essence"),
    [
        ({"method": {"mass": "nodal"}}, "method.mass is nodal"),
        ({"method": {"damping": "kinetic"}}, "method.damping is kinetic"),
        ({"mesh": {"element": "uncontrolled", "element_size_mm": 5}}, "mesh.element is uncontr"),
        ({"relaxation": {"ramp_steps": 100}}, "0.05 steps for each unit of R/t of 50 um"),
    ],
)
def test_what_is_known_to_fail_is_told_with_its_cure(sections, essence, capsys, tmp_path):
    content = {"sweep": FOIL | {"thickness_um": [50, 500]}, "mesh": {"element_size_mm": 5}}
    study = load_config(content | sections)
    (sentence,) = known_to_fail(study)
    assert essence in sentence and ("; use " in sentence or "give 1000 at least" in sentence)
    assert sentence in "\n".join(choices(study))  # the start of a run
    path = tmp_path / "study.yaml"
    path.write_text(study.to_yaml(), encoding="utf-8")
    main(["check", str(path)])
    assert sentence in capsys.readouterr().out


def test_elements_whose_rings_buckle_early_are_told_before_the_start():
    def said(thickness_um, **mesh):
        sweep = FOIL | {"thickness_um": [thickness_um]}
        return unresolved(load_config({"sweep": sweep, "mesh": mesh}))

    # 2.5 mm at 50 um is 1.1 sqrt(R t): rings of one element buckle at half the load
    (folds,) = said(50, element_size_mm=2.5)
    assert "rings of them buckle at 50 % of the load of theory" in folds and "use auto" in folds
    # at 500 um it is 0.35, 5 mm 0.71
    rings, shapes = said(500, element_size_mm=5)
    assert "comes to rest in other shapes" in shapes
    assert "at 80 % of the load of theory" in rings and "use 2.8 mm at most" in rings
    assert not said(500, element_size_mm=2.5) and not said(500) and not said(50)
    (other,) = said(50, element_size_mm=2.5, element="one_point")
    assert "rings" not in other  # which errs to the other side


@pytest.mark.parametrize("slenderness", [0.4, 0.8, 1.6])
def test_rings_buckle_as_early_as_is_said(slenderness):
    """Buckling of a strip of a perfect cylinder, three elements wide, by its tangent."""
    radius, thickness = 0.1, 50e-6
    size = slenderness * np.sqrt(radius * thickness)
    patch = Patch(3, 24, size, size, periodic=False)

    def surface(around, height):
        angle = around / radius
        return np.stack([radius * np.cos(angle), radius * np.sin(angle), height])

    points = fitted_control_points(patch, surface)
    strip = CANDIDATES["corner"].sheet(patch, points, FEP, thickness)
    load = edge_load(patch, points, "top", np.array([0.0, 0.0, -1.0]))
    held = sliding_cell(patch, points, 3 * size / radius)
    modes = buckling_modes(LoadedSheet(strip, held, load), 2)
    cylinder = Cylinder(radius, 24 * size, thickness, FEP)
    found = modes.factors[0] / (classical_buckling_stress(cylinder) * thickness)
    expected = first_buckling(slenderness, FEP.poisson_ratio)
    assert found == pytest.approx(expected, rel=0.02 if slenderness < 1 else 0.05)
    assert half_waves(radial_displacement(points, modes.shapes[0]))[1] == 0  # rings


def test_every_method_that_is_no_default_says_what_fails_with_it():
    for registry in (MASSES, DAMPINGS):
        default, *others = registry
        assert not registry.choice(default).caution
        assert all(registry.choice(name).caution for name in others)


@pytest.mark.parametrize(
    "name", ["FEP", "PET", "polyimide", "aluminium", "stainless steel"], ids=str
)
def test_no_known_material_is_a_slip(name):
    assert not slips_of(material={"name": name})


def own(**constants):
    """FEP with constants of its own."""
    return {"material": constants}


@pytest.mark.parametrize(
    ("sections", "essence"),
    [
        (
            {"sweep": FOIL | {"thickness_um": [0.2, 0.5, 500]}},
            "sweep.thickness_um holds 0.2 to 0.5",
        ),
        (
            {"sweep": FOIL | {"reference_height_mm": [130.000_01, 170]}},
            "sweep.reference_height_mm makes an overlength of 7.69231e-06 %, a hair above the gap",
        ),
        ({"sweep": {"thickness_um": [500], "overlength_percent": [0.05]}}, "overlength of 0.05 %"),
        ({"sweep": {"thickness_um": [500], "overlength_percent": [800]}}, "overlength of 800 %"),
        ({"sheet": {"diameter_mm": 8000}, "mesh": {"element_size_mm": 10}}, "sheet.diameter_mm is"),
        (
            {"sheet": {"diameter_mm": 3000}, "mesh": {"element_size_mm": 10}},
            "sheet.gap_height_mm is 130 mm beside sheet.diameter_mm of 3000 mm",
        ),
        (own(youngs_modulus_mpa=0.65), "not in GPa (650 MPa then)"),
        (own(youngs_modulus_mpa=68.9, density_kg_m3=2710), "not in GPa (68900 MPa then)"),
        (own(youngs_modulus_mpa=650_000, yield_stress_mpa=1e4), "stiffer than tungsten"),
        (own(density_kg_m3=2.15), "not in g/cm3 (2150 kg/m3 then)"),
        (own(density_kg_m3=25_000, youngs_modulus_mpa=2e4), "which no foil has"),
        (own(yield_stress_mpa=12_000), "material.yield_stress_mpa is 12000 MPa, 1.8e+03 %"),
        (own(poisson_ratio=-0.4), "check its sign"),
        ({"imperfection": {"amplitude_um": 10_000}}, "20 times the thickness of 500 um"),
        ({"relaxation": {"residual_tolerance": 1e-15}}, "below what rounding allows"),
        ({"relaxation": {"residual_tolerance": 0.5}}, "check its exponent"),
        ({"relaxation": {"ramp_steps": 10}}, "relaxation.ramp_steps is 10"),
        (
            {"mesh": {"element_size_mm": 0.5}, "stiffness": {"refinements": 0}},
            "mesh.element_size_mm is 0.5 mm for 500 um, which makes 4.3e+05 elements",
        ),
        (
            {"dynamics": {"shown_max_hz": 1e5}},
            "dynamics.shown_max_hz is 100000 Hz, where a bending",
        ),
    ],
)
def test_a_likely_slip_is_named(sections, essence):
    (slip,) = [slip for slip in slips_of(**sections) if essence in slip]
    assert slip.endswith(".") and "\n" not in slip


def test_a_study_of_weeks_and_a_job_beyond_a_machine_are_named():
    study = load_config(
        {
            "sweep": FOIL | {"realisations": 1000},
            "mesh": {"element_size_mm": 0.5},
            "stiffness": {"refinements": 0},
            "dynamics": {"shown_max_hz": 20_000},
        }
    )
    days, memory = costly(expected(study))
    assert "days of processor time" in days and "GB" in memory


def test_check_names_a_slip_at_its_end(tmp_path, capsys):
    (tmp_path / "a.yaml").write_text(f"sweep: {FOIL}\nmaterial: {{density_kg_m3: 2.15}}\n")
    main(["check", str(tmp_path / "a.yaml")])
    *_, head, slip = capsys.readouterr().out.splitlines()
    assert head == "Possible, but most likely a slip:" and "g/cm3" in slip
