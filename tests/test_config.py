"""The study configuration: what it accepts, what it refuses and how it says so."""

from __future__ import annotations

import json
import pickle
import subprocess
import sys
from pathlib import Path

import pytest
import runs
import yaml
from jsonschema import Draft202012Validator

from foilstudy.config import (
    Cell,
    ConfigError,
    CrumpleTask,
    Material,
    ResponseTask,
    StudyConfig,
    load_config,
)
from foilstudy.config._yaml import read_yaml
from foilstudy.config.docs import reference_page, schema_text
from foilstudy.config.sections import Stiffness
from foilstudy.model.materials import MATERIALS
from foilstudy.model.mesh_size import expected_energy_error
from foilstudy.present.statistics.trust import ERROR_MAX

CONFIG_FOLDER = Path(__file__).parents[1] / "config"
CONFIG_FILES = runs.STUDY_FILES
STUDY_FILES = [CONFIG_FOLDER / name for name in ("config.yaml", "thesis.yaml", "tiny.yaml")]


def study(**changes):
    """Valid configuration with sections, or keys within them, replaced."""
    content = {"sweep": {"thickness_um": [500, 50], "reference_height_mm": [170, 150]}}
    for section, keys in changes.items():
        old = content.get(section)
        merge = isinstance(old, dict) and isinstance(keys, dict)
        content[section] = old | keys if merge else keys
    return content


def problems_of(source):
    with pytest.raises(ConfigError) as caught:
        load_config(source)
    assert str(caught.value) == "\n".join(caught.value.problems)
    for problem in caught.value.problems:
        assert problem.endswith((".", "?"))
        assert "\n" not in problem
    return caught.value.problems


def problem_of(source):
    (problem,) = problems_of(source)
    return problem


# --- what is accepted -----------------------------------------------------------------------------


def test_defaults_are_the_published_case_on_a_mesh_that_resolves_it():
    config = load_config(study())
    assert config.study.name == "study"
    assert (config.sheet.diameter_mm, config.sheet.gap_height_mm) == (200, 130)
    assert config.material.model_dump() == {
        "name": "FEP",
        "law": "elastic",
        "youngs_modulus_mpa": 650,
        "poisson_ratio": 0.4,
        "density_kg_m3": 2150,
        "yield_stress_mpa": 12,
        "hardening_mpa": None,
        "relaxation_per_decade": 0,
    }
    assert config.sweep.realisations == 6
    assert (config.imperfection.kind, config.imperfection.amplitude_um) == ("gaussian", 10)
    assert (config.mesh.element_size_mm, config.mesh.energy_error_percent) == ("auto", 10)
    assert (config.dynamics.shown_min_hz, config.dynamics.shown_max_hz) == (1, 800)
    assert (config.dynamics.damping, config.dynamics.damping_percent) == ("modal", 5)
    assert config.dynamics.reduction == "rational_krylov"


def test_thesis_file_is_the_published_grid():
    config = load_config(CONFIG_FOLDER / "thesis.yaml")
    assert config.thicknesses_um == (50, 130, 250, 500)
    assert config.reference_heights_mm == (135, 150, 170, 200, 250)
    overlengths = (3.846, 15.385, 30.769, 53.846, 92.308)
    assert config.overlengths_percent == pytest.approx(overlengths, abs=1e-3)
    assert len(config.cells()) == 120
    assert config.mesh.element_size_mm == 5


@pytest.mark.parametrize(("name", "cells"), [("config", 18), ("thesis", 120), ("tiny", 8)])
def test_study_files_have_the_announced_size(name, cells):
    assert len(load_config(str(CONFIG_FOLDER / f"{name}.yaml")).cells()) == cells


def test_grid_is_sorted_and_crossed():
    config = load_config(study(sweep={"realisations": 2}))
    cells = config.cells()
    assert [(c.thickness_um, c.reference_height_mm, c.seed) for c in cells] == [
        (t, h, s) for t in (50, 500) for h in (150, 170) for s in (0, 1)
    ]
    assert config.seeds == (0, 1)
    assert len({(c.thickness_id, c.overlength_id, c.seed) for c in cells}) == len(cells)


def test_heights_and_overlengths_are_both_available():
    sweep = {"thickness_um": [50], "overlength_percent": [60, 30, 100 / 3]}
    config = load_config({"sweep": sweep})
    assert config.overlengths_percent == (30, 100 / 3, 60)
    assert config.reference_heights_mm == (169, 173.333333333, 208)
    ids = [cell.overlength_id for cell in config.cells()[:: config.sweep.realisations]]
    assert ids == ["h169mm", "h173p333mm", "h208mm"]


def test_ids_are_plain():
    cell = Cell(12.5, 167.5, 28.8, 3)
    assert (cell.thickness_id, cell.overlength_id) == ("t12p5um", "h167p5mm")
    cell = Cell(500.0, 170.0, 30.8, 0)
    assert (cell.thickness_id, cell.overlength_id) == ("t500um", "h170mm")


def test_cell_is_found_by_its_ids():
    config = load_config(study())
    for cell in config.cells():
        assert config.cell(cell.thickness_id, cell.overlength_id, str(cell.seed)) == cell
    for ids in (("t51um", "h150mm", 0), ("t50um", "h150mm", 6), ("t50um", "h150mm", "x")):
        with pytest.raises(ConfigError, match="t50um/h150mm/0 to t500um/h170mm/5"):
            config.cell(*ids)


def test_yaml_holds_the_whole_configuration(tmp_path):
    for file in STUDY_FILES:
        config = load_config(file)
        copy = tmp_path / file.name
        copy.write_text(config.to_yaml(), encoding="utf-8")
        assert load_config(copy) == config
        assert "residual_tolerance" in config.to_yaml()


@pytest.mark.parametrize("kind", ["gaussian", "smoothed", "buckling_modes"])
def test_tasks_round_trip_through_json(kind):
    config = load_config(study(imperfection={"kind": kind}, material={"youngs_modulus_mpa": 700}))
    cell = config.cells()[-1]
    for task in (config.crumple_task(cell), config.response_task(cell)):
        stored = json.loads(json.dumps(task.model_dump(mode="json")))
        assert type(task).model_validate(stored) == task
        assert task.overlength_percent == pytest.approx(cell.overlength_percent)
        assert (task.thickness_um, task.reference_height_mm, task.seed) == (500, 170, 5)


def test_tasks_hold_only_what_their_job_needs():
    config = load_config(study())
    changed = load_config(
        study(
            study={"name": "other"},
            report={"title": "Other"},
            sweep={"thickness_um": [500, 50, 60], "realisations": 9},
        )
    )
    cell = config.cell("t500um", "h170mm", 1)
    assert config.crumple_task(cell) == changed.crumple_task(cell)
    assert config.response_task(cell) == changed.response_task(cell)

    damped = load_config(study(dynamics={"damping_percent": 1}))
    assert damped.crumple_task(cell) == config.crumple_task(cell)
    assert damped.response_task(cell) != config.response_task(cell)

    slower = load_config(study(relaxation={"ramp_steps": 4000}))
    assert slower.crumple_task(cell) != config.crumple_task(cell)
    assert slower.response_task(cell) == config.response_task(cell)
    assert "stiffness" not in CrumpleTask.model_fields
    assert "imperfection" not in ResponseTask.model_fields


def test_configuration_is_immutable_and_pickles():
    config = load_config(study())
    config.cells()
    with pytest.raises(ValueError, match="frozen"):
        config.mesh.element_size_mm = 2.0
    assert pickle.loads(pickle.dumps(config)) == config


def test_only_a_smoothed_imperfection_has_a_correlation_length():
    smoothed = load_config(study(imperfection={"kind": "smoothed"})).imperfection
    assert smoothed.correlation_length_mm == 15
    assert load_config(study()).imperfection.correlation_length_mm is None
    text = problem_of(study(imperfection={"correlation_length_mm": 5}))
    assert "imperfection.correlation_length_mm" in text
    assert "smoothed" in text


# --- material -------------------------------------------------------------------------------------


def test_known_material_with_one_constant_of_its_own():
    material = load_config(study(material={"name": "PET", "poisson_ratio": 0.3})).material
    assert material.poisson_ratio == 0.3
    assert material.density_kg_m3 == MATERIALS["PET"].density_kg_m3


def test_own_material_by_constants():
    constants = {
        "youngs_modulus_mpa": 3000,
        "poisson_ratio": 0.35,
        "density_kg_m3": 1200,
        "yield_stress_mpa": 60,
    }
    material = load_config(study(material={"name": "paper", **constants})).material
    left_out = {"law": "elastic", "hardening_mpa": None, "relaxation_per_decade": 0}
    expected = {"name": "paper", **left_out, **constants}
    assert material.model_dump() == expected


@pytest.mark.parametrize("name", MATERIALS)
def test_every_known_material_is_valid_and_has_a_source(name):
    assert Material.model_validate({"name": name}).name == name
    assert MATERIALS[name].source


def test_unknown_material_without_constants():
    text = problem_of(study(material={"name": "fep", "poisson_ratio": 0.4}))
    assert text.startswith("material.name is 'fep', which is not a known material")
    assert "material.youngs_modulus_mpa, material.density_kg_m3" in text
    assert "material.poisson_ratio" not in text
    assert "did you mean FEP?" in text
    assert "polyimide" in text


@pytest.mark.parametrize(("value", "bound"), [(0.51, "at most 0.5"), (-1, "greater than -1")])
def test_poisson_ratio_out_of_range(value, bound):
    text = problem_of(study(material={"poisson_ratio": value}))
    assert text.startswith(f"material.poisson_ratio is {value}, out of range")
    assert bound in text


def test_material_name_that_is_no_text_is_the_only_problem():
    assert problem_of(study(material={"name": 6061})) == (
        "material.name is 6061, not text; put it in quotes."
    )


# --- keys -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "path", "remedy"),
    [
        ({"mesh": {"element_size": 5}}, "mesh.element_size", "did you mean mesh.element_size_mm?"),
        ({"sweep": {"realizations": 3}}, "sweep.realizations", "did you mean sweep.realisations?"),
        ({"material_": {}}, "material_", "did you mean material?"),
        (
            {"mesh": {"check_interval": 3}},
            "mesh.check_interval",
            "another section: relaxation.check_interval",
        ),
        ({"mesh": {"colour": 3}}, "mesh.colour", "mesh has element_size_mm"),
        ({"threads": 2}, "threads", "the top level has study, accuracy, sheet, material"),
    ],
)
def test_unknown_key_names_a_known_one(changes, path, remedy):
    text = problem_of(study(**changes))
    assert text.startswith(f"{path} is not a known key; ")
    assert remedy in text


def test_key_that_is_no_text():
    assert problem_of({**study(), 3: 4}).startswith("3 is not a known key")


@pytest.mark.parametrize("value", [None, 5, [1], "fine"])
def test_section_that_is_no_section(value):
    text = problem_of(study(mesh=value))
    assert text.startswith("mesh ")
    assert "element_size_mm" in text


def test_missing_sweep_and_thickness():
    assert problem_of({"study": {"name": "a"}}).startswith("sweep is missing; give")
    text = problem_of({"sweep": {"overlength_percent": [30]}})
    assert text == "sweep.thickness_um is missing; add it (Foil thicknesses)."


def test_every_problem_has_its_own_sentence():
    content = study(sweep={"thickness_um": [50, -1]}, mesh={"size": 2}, sheet={"diameter_mm": "2"})
    paths = [problem.split(" ")[0] for problem in problems_of(content)]
    assert sorted(paths) == ["mesh.size", "sheet.diameter_mm", "sweep.thickness_um[1]"]


# --- values ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "essence"),
    [
        (-50, "is -50, out of range; use a value of at least 0.1 um"),
        (0, "is 0, out of range"),
        ("500 um", "is the text '500 um', not a number; write the number alone in um"),
        ("500", "is the text '500', not a number; write it without quotes"),
        ("1e-6", "is the text '1e-6', not a number; write it as 1.0e-06"),
        (True, "is the truth value true, not a number"),
        (None, "is empty, not a number"),
        ([50], "is a list, not a number"),
        (float("nan"), "is nan, not a finite number"),
        (float("inf"), "is inf, not a finite number"),
        (10**400, "is a number of more than 15 digits, out of range"),
    ],
)
def test_impossible_thickness(value, essence):
    text = problem_of(study(sweep={"thickness_um": [50, 130, value]}))
    assert text.startswith("sweep.thickness_um[2] ")
    assert essence in text


def test_thickness_given_in_the_wrong_unit():
    text = problem_of(study(sweep={"thickness_um": [50, 6000]}))
    assert text.startswith("sweep.thickness_um[1] is 6000 um, more than 1/20 of the radius")
    assert "5000 um or less" in text


@pytest.mark.parametrize("value", [True, 2.5, "3", None])
def test_whole_numbers_are_not_guessed(value):
    text = problem_of(study(sweep={"realisations": value}))
    assert text.startswith("sweep.realisations is ")
    assert "not a whole number" in text


def test_whole_number_written_as_a_float():
    text = problem_of(study(relaxation={"ramp_steps": 2e3}))
    assert text.endswith("not a whole number; write 2000.")


def test_no_such_choice():
    text = problem_of(study(imperfection={"kind": "gauss"}))
    assert text.startswith("imperfection.kind is the text 'gauss'")
    assert "did you mean gaussian? use one of 'gaussian', 'smoothed' or 'buckling_modes'" in text


# --- the sweep ------------------------------------------------------------------------------------


def test_height_and_overlength_both_given():
    text = problem_of(study(sweep={"overlength_percent": [30]}))
    assert "sweep.reference_height_mm and sweep.overlength_percent are both given" in text
    assert "remove one" in text


def test_neither_height_nor_overlength():
    text = problem_of({"sweep": {"thickness_um": [50]}})
    assert "neither reference_height_mm nor overlength_percent" in text


def test_overlength_zero():
    text = problem_of({"sweep": {"thickness_um": [50], "overlength_percent": [30, 0]}})
    assert text.startswith("sweep.overlength_percent[1] is 0, out of range")


@pytest.mark.parametrize("height", [130, 120])
def test_height_not_above_the_gap(height):
    text = problem_of(study(sweep={"reference_height_mm": [150, height]}))
    assert text.startswith(f"sweep.reference_height_mm[1] is {height} mm, not above")
    assert "sheet.gap_height_mm (130 mm)" in text


@pytest.mark.parametrize("key", ["thickness_um", "reference_height_mm"])
def test_empty_sweep(key):
    assert problem_of(study(sweep={key: []})).startswith(f"sweep.{key} is empty; give at least one")


def test_single_value_instead_of_a_list():
    assert problem_of(study(sweep={"thickness_um": 50})) == (
        "sweep.thickness_um is 50, not a list; write [50]."
    )
    assert problem_of(study(report={"measured": "run.csv"})) == (
        "report.measured is the text 'run.csv', not a list; write [{file: ...}]."
    )


def test_repeated_value():
    text = problem_of(study(sweep={"reference_height_mm": [150, 170, 150.0]}))
    assert text == (
        "sweep.reference_height_mm[2] repeats sweep.reference_height_mm[0] (150); "
        "remove one of them."
    )


@pytest.mark.parametrize("key", ["thickness_um", "overlength_percent"])
def test_values_that_would_share_an_id(key):
    sweep = {"thickness_um": [50], "overlength_percent": [30]} | {key: [50, 50.0001]}
    text = problem_of({"sweep": sweep})
    assert text.startswith(f"sweep.{key}[1] (50.0001) and sweep.{key}[0] (50.0) are too close")
    assert "t50um" in text or "h195mm" in text


# --- checks that span keys ------------------------------------------------------------------------


def test_cutoff_below_the_shown_band():
    text = problem_of(study(dynamics={"reduction": "hintz_herting", "cutoff_hz": 500}))
    assert text.startswith("dynamics.cutoff_hz is 500 Hz, below the shown band")
    assert "dynamics.shown_max_hz (800 Hz)" in text


def test_cutoff_of_a_reduction_without():
    text = problem_of(study(dynamics={"cutoff_hz": 1000}))
    assert text.startswith("dynamics.cutoff_hz is given, but the reduction rational_krylov has no")
    assert "dynamics.reduction: hintz_herting" in text


@pytest.mark.parametrize(
    "dynamics", [{"damping": "rayleigh"}, {"rayleigh_hz": [20, 500]}], ids=["missing", "idle"]
)
def test_rayleigh_frequencies_go_with_rayleigh_damping(dynamics):
    text = problem_of(study(dynamics=dynamics))
    assert text.startswith("dynamics.rayleigh_hz goes with dynamics.damping: rayleigh")


def test_rayleigh_frequencies_rise():
    text = problem_of(study(dynamics={"damping": "rayleigh", "rayleigh_hz": [500, 20]}))
    assert "give two positive, rising frequencies" in text


def test_list_of_choices_left_empty():
    text = problem_of(study(export={"formats": None}))
    assert text.startswith("export.formats is empty, not a list; write [].")


def test_empty_band():
    text = problem_of(study(dynamics={"shown_min_hz": 800}))
    assert text.startswith("dynamics.shown_min_hz is 800 Hz, which is not below")


def test_element_too_coarse_around():
    text = problem_of(study(mesh={"element_size_mm": 30}, sheet={"gap_height_mm": 20}))
    assert text.startswith("mesh.element_size_mm is 30 mm, too coarse")
    assert "21 elements around" in text


def test_element_too_coarse_along():
    content = study(mesh={"element_size_mm": 22}, sheet={"diameter_mm": 400})
    text = problem_of(content)
    assert "7 along the shortest cylinder (at least 8)" in text
    remedy = float(text.partition("; use ")[2].split(" ")[0])
    load_config(content | {"mesh": {"element_size_mm": remedy}})


def test_element_size_given_in_metres():
    text = problem_of(study(mesh={"element_size_mm": 0.005}))
    assert "elements on the longest cylinder" in text
    assert "check that the value is in mm" in text


@pytest.mark.parametrize("which", ["refinements", "relaxed_refinements"])
def test_the_limit_of_elements_counts_either_refinement(which):
    stiffness = {"refinements": 0, "relaxed_refinements": 0} | {which: 2}
    content = study(mesh={"element_size_mm": 1.25})
    assert "refined twice" in problem_of(content | {"stiffness": stiffness})
    load_config(content | {"stiffness": dict.fromkeys(stiffness, 0)})


def test_a_demanded_error_refines_by_need_twice_at_most():
    content = study(sweep={"thickness_um": [500]})
    (cell, *_), demand = load_config(content).cells(), {"error_percent": 3}
    plain = load_config(content).response_task(cell)
    assert (plain.error_percent, plain.refinements) == (5, 2)  # of the tier
    task = load_config(content | {"stiffness": demand}).response_task(cell)
    assert (task.error_percent, task.refinements) == (3, 2)
    once = load_config(content | {"stiffness": demand | {"refinements": 1}})
    assert once.response_task(cell).refinements == 1
    assert load_config(yaml.safe_load(once.to_yaml())) == once


def test_refinements_by_need_stop_where_elements_become_too_many():
    """0.13 million elements can be halved once, not twice."""
    content = study(mesh={"element_size_mm": 0.9}, stiffness={"error_percent": 5})
    config = load_config(content)
    assert {config.response_task(cell).refinements for cell in config.cells()} == {1}
    fixed = content | {"stiffness": {"refinements": 2}}
    assert "refined twice" in problem_of(fixed)
    finer = content | {"mesh": {"element_size_mm": 0.4}}
    assert "refined once" in problem_of(finer)


def test_no_demand_is_larger_than_what_is_trusted():
    field = Stiffness.model_fields["error_percent"]
    (limit,) = (each.le for each in field.metadata if hasattr(each, "le"))
    assert limit == 100 * ERROR_MAX


def test_smooth_imperfection_that_the_mesh_cannot_follow():
    imperfection = {"kind": "smoothed", "correlation_length_mm": 3}
    mesh = {"element_size_mm": 5}
    text = problem_of(study(imperfection=imperfection, mesh=mesh))
    assert text.startswith("imperfection.correlation_length_mm is 3 mm")
    remedy = 1.01 * float(text.partition("; use ")[2].split(" ")[0])
    followed = imperfection | {"correlation_length_mm": remedy}
    load_config(study(imperfection=followed, mesh=mesh))


def test_auto_mesh_fits_around_and_along_the_shortest_cylinder():
    sheet = {"diameter_mm": 100, "gap_height_mm": 10}
    sweep = {"thickness_um": [1000], "reference_height_mm": [12, 40], "realisations": 1}
    config = load_config({"sheet": sheet, "sweep": sweep})
    assert [config.crumple_task(cell).mesh.element_size_mm for cell in config.cells()] == [1.5, 1.5]


def test_auto_mesh_is_finer_for_thinner_foils_and_smaller_errors():
    sweep = {"thickness_um": [130, 500], "realisations": 1}
    sizes = {}
    for error in (10, 20):
        mesh = {"element_size_mm": "auto", "energy_error_percent": error}
        config = load_config(study(sweep=sweep, mesh=mesh))
        assert config.mesh.element_size_mm == "auto"
        for cell in config.cells():
            task = config.crumple_task(cell)
            sizes[error, cell.thickness_um] = task.mesh.element_size_mm
            assert task.mesh.energy_error_percent is None
            radius = config.sheet.diameter_mm / 2 * 1e-3
            expected = expected_energy_error(
                task.mesh.element_size_mm * 1e-3, radius, cell.thickness_um * 1e-6
            )
            assert expected <= error / 100
    assert sizes[10, 130] < sizes[20, 130] < sizes[20, 500]
    assert sizes[10, 130] < sizes[10, 500] < sizes[20, 500]


def test_auto_mesh_has_a_default_error_and_survives_a_round_trip():
    config = load_config(study(mesh={"element_size_mm": "auto"}))
    assert config.mesh.energy_error_percent == 10
    assert load_config(yaml.safe_load(config.to_yaml())) == config
    assert StudyConfig.model_validate_json(config.model_dump_json()) == config


def test_auto_mesh_that_no_machine_can_hold():
    sweep = {"thickness_um": [1]}
    text = problem_of(study(sweep=sweep, mesh={"element_size_mm": "auto"}))
    assert "(auto, 1 um, 10 % of energy error)" in text
    assert "allow a larger mesh.energy_error_percent" in text


def test_energy_error_beside_a_given_size():
    text = problem_of(study(mesh={"element_size_mm": 5, "energy_error_percent": 5}))
    assert text.startswith("mesh.energy_error_percent is given")


def test_auto_mesh_for_an_element_whose_error_is_unknown():
    text = problem_of(study(mesh={"element_size_mm": "auto", "element": "one_point"}))
    assert "the mesh error of the one_point element is not known" in text


@pytest.mark.parametrize("name", ["a/b", "..", "", "my foil", "-x", "é", "a\n", "x" * 65])
def test_name_unusable_as_a_folder(name):
    text = problem_of(study(study={"name": name}))
    assert text.startswith("study.name is the text ")
    assert "letters, digits" in text


def test_name_that_is_a_number():
    assert problem_of(study(study={"name": 7})) == "study.name is 7, not text; put it in quotes."


# --- files and YAML -------------------------------------------------------------------------------


def write(folder, text):
    file = folder / "study.yaml"
    file.write_text(text, encoding="utf-8")
    return file


def test_file_missing(tmp_path):
    file = tmp_path / "nothing.yaml"
    assert problem_of(file) == f"{file}: there is no such file; check the path."


def test_folder_instead_of_a_file(tmp_path):
    assert "this is a folder" in problem_of(tmp_path)


def test_file_that_is_no_text(tmp_path):
    file = tmp_path / "study.yaml"
    file.write_bytes(b"\x89HDF\xff\xfe")
    assert "not a text file" in problem_of(file)


@pytest.mark.parametrize("text", ["", "# nothing yet\n", "{}"])
def test_empty_file(tmp_path, text):
    file = write(tmp_path, text)
    problem = problem_of(file)
    assert problem.startswith(f"{file}: the configuration is empty")
    assert "thickness_um" in problem


@pytest.mark.parametrize(("text", "what"), [("- 1\n", "a list"), ("word\n", "the text 'word'")])
def test_top_level_that_is_no_mapping(tmp_path, text, what):
    assert f"the top level is {what}, not a mapping" in problem_of(write(tmp_path, text))


@pytest.mark.parametrize("text", ["sweep:\n  a: [1\nmesh: 3\n", "sweep:\n\ta: 1\n", "a: b: c\n"])
def test_yaml_syntax_error_tells_the_line(tmp_path, text):
    problem = problem_of(write(tmp_path, text))
    assert ": line " in problem
    assert "not valid YAML" in problem


@pytest.mark.parametrize("text", ["mesh:\n  a: 1\n  b: 2\n  a: 3\n", "{a: 1, a: 2}"])
def test_key_given_twice(tmp_path, text):
    problem = problem_of(write(tmp_path, text))
    assert "key a is given twice" in problem


def test_problem_in_a_file_names_the_file(tmp_path):
    file = write(tmp_path, "sweep: {thickness_um: [-1], reference_height_mm: [150]}\n")
    assert problem_of(file).startswith(f"{file}: sweep.thickness_um[0] is -1")


def test_exponent_without_a_dot_is_a_number(tmp_path):
    file = write(
        tmp_path,
        "sweep: {thickness_um: [5e1], overlength_percent: [30]}\n"
        "relaxation: {residual_tolerance: 1e-7}\n",
    )
    config = load_config(file)
    assert config.relaxation.residual_tolerance == 1e-7
    assert config.thicknesses_um == (50,)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e-6", 1e-6),
        ("1.5E3", 1500.0),
        ("-.5", -0.5),
        ("3.", 3.0),
        ("010", 10),
        ("-7", -7),
        ("1:30", "1:30"),
        ("1_000", "1_000"),
        ("on", "on"),
        ("no", "no"),
        ("true", True),
        ("2026-01-01", "2026-01-01"),
        ("~", None),
        ("1e", "1e"),
        ('"1e-6"', "1e-6"),
        (".inf", float("inf")),
    ],
)
def test_scalars_follow_yaml_1_2(text, value):
    read = read_yaml(text)
    assert read == value
    assert type(read) is type(value)


def test_source_of_the_wrong_type():
    assert "from a list" in problem_of([1])


# --- generated files ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "generate"), [("README.md", reference_page), ("schema.json", schema_text)]
)
def test_generated_files_follow_the_model(name, generate):
    stored = (CONFIG_FOLDER / name).read_text(encoding="utf-8")
    assert stored == generate(), "run `python -m foilstudy.config`"


def test_generator_writes_both_files(tmp_path):
    command = [sys.executable, "-m", "foilstudy.config", str(tmp_path)]
    subprocess.run(command, check=True, capture_output=True)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["README.md", "schema.json"]


def test_reference_page_names_every_key():
    page = reference_page()
    assert all(f"## `{name}`" in page for name in StudyConfig.model_fields)
    for section, model in StudyConfig.sections().items():
        for key, entry in model.model_fields.items():
            assert entry.description, f"{section}.{key}"
            assert f"| `{key}` | " in page


def test_minimal_example_of_the_reference_page_is_valid(tmp_path):
    example = reference_page().partition("```yaml\n")[2].partition("```")[0]
    assert load_config(write(tmp_path, example)).study.name == "my-foil"


def schema_errors(content):
    schema = json.loads(schema_text())
    Draft202012Validator.check_schema(schema)
    return list(Draft202012Validator(schema).iter_errors(content))


@pytest.mark.parametrize("file", CONFIG_FILES, ids=lambda file: file.stem)
def test_schema_accepts_the_study_files(file):
    assert schema_errors(read_yaml(file.read_text(encoding="utf-8"))) == []


@pytest.mark.parametrize(
    "content",
    [
        {},
        study(mesh={"element_size": 5}),
        study(sweep={"overlength_percent": [30]}),
        study(sweep={"thickness_um": []}),
        study(sweep={"thickness_um": [-1]}),
        study(material={"name": "paper"}),
        study(material={"poisson_ratio": 0.6}),
        study(accuracy="quik"),
    ],
)
def test_schema_refuses_what_the_model_refuses(content):
    assert schema_errors(content)
    problems_of(content)


CONSTANTS_OF_FEP = {
    "youngs_modulus_mpa": 650, "poisson_ratio": 0.4, "density_kg_m3": 2150, "yield_stress_mpa": 12,
}  # fmt: skip


@pytest.mark.parametrize(
    "name", ["0E0", "1e3", "0x1F", "0o17", "1_000", "on", "12:30", "-.5", "null"]
)
def test_a_text_that_looks_like_a_number_is_written_as_a_text(name, tmp_path):
    """Numbers of YAML 1.2, which reads it, and words of 1.1, which writes it."""
    config = load_config(study(material={"name": name} | CONSTANTS_OF_FEP))
    path = tmp_path / "study.yaml"
    path.write_text(config.to_yaml(), encoding="utf-8")
    assert load_config(path) == config


@pytest.mark.parametrize("stress", [0, -3])
def test_a_foil_that_yields_at_nothing_is_refused(stress):
    plastic = {"law": "plastic", "yield_stress_mpa": stress}
    sweep = {"thickness_um": [500], "reference_height_mm": [170]}
    with pytest.raises(ConfigError, match=rf"yield_stress_mpa is {stress}, out of range; use a"):
        load_config({"sweep": sweep, "material": plastic})
