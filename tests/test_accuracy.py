"""One word for accuracy: what it decides, what wins over it, and what it leaves alone."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import yaml

from foilstudy import Accuracy, Foil, Mesh
from foilstudy.base.errors import Refusal
from foilstudy.config import ConfigError, StudyConfig, load_config, load_merged
from foilstudy.config.accuracy import ACCURACIES, STANDARD, completed
from foilstudy.config.chosen import accuracy_words, choices
from foilstudy.config.foils import patch_of
from foilstudy.config.slips import hurried, likely_slips, unresolved
from foilstudy.measure.stiffness import limit_by_need
from foilstudy.model.mesh_size import expected_energy_error
from foilstudy.study.sweep.expected import expected

ROOT = Path(__file__).parents[1]
SWEEP = {"thickness_um": [130, 500], "reference_height_mm": [150, 170], "realisations": 1}
WORDS = list(ACCURACIES)


def study(**sections):
    return load_config({"sweep": SWEEP} | sections)


def tasks_of(config):
    """Everything that the jobs of a study are told, as they store it."""
    for cell in config.cells():
        for task in (config.crumple_task(cell), config.response_task(cell)):
            yield task.model_dump_json(exclude_none=True)  # a record without a key counts as well
    yield config.cylinder_task()


@pytest.mark.parametrize("word", WORDS)
def test_the_values_of_a_tier_reach_the_tasks(word):
    tier, config = ACCURACIES[word], study(accuracy=word)
    for cell in config.cells():
        crumple, response = config.crumple_task(cell), config.response_task(cell)
        error = expected_energy_error(
            crumple.mesh.element_size_mm * 1e-3, 0.1, cell.thickness_um * 1e-6
        )
        assert 0.97 * tier.energy_error < error <= tier.energy_error * (1 + 1e-9)
        assert crumple.relaxation.ramp_steps == round(tier.ramp_slowness * 1e5 / cell.thickness_um)
        assert crumple.relaxation.ramp_slowness is None
        assert response.dynamics.tolerance == tier.reduction_tolerance
        assert response.error_percent == tier.stiffness_error_percent
        assert 1 <= response.refinements <= config.stiffness.refinements == 2


def test_a_finer_tier_asks_for_more_of_everything():
    quick, standard, fine = (ACCURACIES[word] for word in ("quick", "standard", "fine"))
    for coarser, finer in ((quick, standard), (standard, fine)):
        for path, value in coarser.values.items():
            more = finer.values[path] > value
            assert more if path == "relaxation.ramp_slowness" else finer.values[path] < value


def test_no_word_is_standard():
    assert list(tasks_of(study())) == list(tasks_of(study(accuracy="standard")))
    assert study().tier is STANDARD


@pytest.mark.parametrize("word", WORDS)
@pytest.mark.parametrize(
    ("section", "key", "value"),
    [
        ("mesh", "energy_error_percent", 7.0),
        ("relaxation", "ramp_slowness", 12.0),
        ("stiffness", "error_percent", 3.0),
        ("dynamics", "tolerance", 3e-3),
    ],
)
def test_a_given_key_wins_and_leaves_the_others_to_the_tier(word, section, key, value):
    config = study(accuracy=word, **{section: {key: value}})
    for path, of_tier in ACCURACIES[word].values.items():
        name, _, other = path.partition(".")
        found = getattr(getattr(config, name), other)
        assert found == (value if (name, other) == (section, key) else of_tier)


def test_a_size_of_the_elements_wins_over_the_error_of_the_energy():
    config = study(accuracy="fine", mesh={"element_size_mm": 6})
    assert (config.mesh.element_size_mm, config.mesh.energy_error_percent) == (6, None)
    assert config.relaxation.ramp_slowness == ACCURACIES["fine"].ramp_slowness


def test_steps_of_the_ramp_win_over_its_slowness():
    relaxation = study(relaxation={"ramp_steps": 1234}).relaxation
    assert (relaxation.ramp_steps, relaxation.ramp_slowness) == (1234, None)
    assert relaxation.resolved(200) == relaxation.model_copy(update={"relaxation_steps_max": 14000})
    with pytest.raises(ConfigError, match="ramp_steps settles the ramp; remove one of them"):
        study(relaxation={"ramp_steps": 1234, "ramp_slowness": 5})


@pytest.mark.parametrize(
    ("thickness_um", "given", "most"),
    [
        (50, {}, 140_000),
        (500, {}, 14_000),
        (1000, {}, 14_000),  # fewer would save nothing
        (50, {"ramp_slowness": 400}, 140_000),
        (50, {"ramp_slowness": 4}, 56_000),
        (50, {"ramp_steps": 2000}, 14_000),  # as in configurations of before
        (50, {"relaxation_steps_max": 300}, 300),
    ],
)
def test_a_slower_ramp_leaves_more_steps_to_come_to_rest(thickness_um, given, most):
    config = study(relaxation=given, sweep=SWEEP | {"thickness_um": [thickness_um]})
    for cell in config.cells():
        assert config.crumple_task(cell).relaxation.relaxation_steps_max == most


def test_a_number_of_refinements_wins_over_the_error_of_the_stiffness():
    """It is the fixed ladder of old; beside an error, the most that are made."""
    sweep = SWEEP | {"thickness_um": [500]}
    for refinements in range(4):
        config = study(accuracy="quick", sweep=sweep, stiffness={"refinements": refinements})
        task = config.response_task(config.cells()[0])
        assert (task.refinements, task.error_percent) == (refinements, None)
    both = {"refinements": 1, "error_percent": 3}
    assert study(stiffness=both).stiffness.model_dump(include=set(both)) == both
    relaxed = study(stiffness={"relaxed_refinements": 1}).stiffness
    assert (relaxed.refinements, relaxed.error_percent) == (2, STANDARD.stiffness_error_percent)


@pytest.mark.parametrize("word", WORDS)
def test_the_word_itself_enters_no_task(word):
    """From the word to the same values written out, and back, no record becomes stale."""
    written = {}
    for path, value in ACCURACIES[word].values.items():
        section, _, key = path.partition(".")
        written.setdefault(section, {})[key] = value
    for other in WORDS:
        assert list(tasks_of(study(accuracy=other, **written))) == list(
            tasks_of(study(accuracy=word))
        )


@pytest.mark.parametrize("word", WORDS)
def test_a_configuration_with_a_word_survives_a_round_trip(word):
    config = study(accuracy=word)
    assert load_config(yaml.safe_load(config.to_yaml())) == config
    assert StudyConfig.model_validate_json(config.model_dump_json()) == config


def test_an_unknown_word_is_one_sentence_with_the_closest_known():
    with pytest.raises(ConfigError) as caught:
        study(accuracy="standrad")
    assert str(caught.value) == (
        "accuracy is the text 'standrad', which is no choice; did you mean standard? "
        "use one of 'quick', 'standard' or 'fine'."
    )
    with pytest.raises(Refusal, match="'Quik' is no accuracy; did you mean quick?"):
        Accuracy.named("Quik")


@pytest.mark.parametrize("value", [None, 5, [], {}, {"quick": 1}, True])
def test_what_is_no_word_is_the_only_problem(value):
    with pytest.raises(ConfigError) as caught:
        study(accuracy=value)
    (problem,) = caught.value.problems
    assert problem.startswith("accuracy is ") and "use one of 'quick'" in problem


def test_the_word_is_taken_from_the_command_line():
    config = load_merged([ROOT / "config/config.yaml"], ["accuracy=quick"])
    assert config.tier is ACCURACIES["quick"]
    with pytest.raises(ConfigError, match="did you mean fine"):
        load_merged([ROOT / "config/config.yaml"], ["accuracy=fin"])


def test_completing_leaves_the_content_as_it_was_given():
    content = {"accuracy": "quick", "mesh": {"element_size_mm": "auto"}}
    kept = yaml.safe_dump(content)
    assert completed(content)["mesh"]["energy_error_percent"] == 25
    assert yaml.safe_dump(content) == kept


# --- what is said of it ---------------------------------------------------------------------------


def said(**sections):
    return accuracy_words(study(**sections).model_dump())


def test_keys_that_overrule_the_word_are_named():
    assert said(accuracy="quick") == "quick"
    assert said(dynamics={"tolerance": STANDARD.reduction_tolerance}) == "standard"
    # the same number as the error in per cent, but of another thing
    assert said(mesh={"element_size_mm": 10}, relaxation={"ramp_steps": 50}) == (
        "standard, overruled by mesh.element_size_mm: 10, relaxation.ramp_steps: 50"
    )


def test_choices_say_for_each_thickness_what_it_gets_and_why():
    head, thin, thick, wide, told = choices(study(accuracy="quick"))
    assert head == "Accuracy quick"
    assert thin.startswith("  130 um: elements of 2.6 mm (25 % energy error), 9231 steps of ramp")
    assert thick.startswith("  500 um: elements of 5.1 mm (25 % energy error), 2400 steps of ramp")
    assert thick.endswith("shape refined to 10 %, at most twice, reduction to 0.01")
    assert "The elements of foil of 130, 500 um are 0.72 times sqrt(R t) wide" in wide
    assert "The ramp hurries foil of 130, 500 um: 12 steps" in told
    _, both, *told = choices(study(mesh={"element_size_mm": 5}, relaxation={"ramp_steps": 2000}))
    assert len(told) == 4  # folds not resolved, first buckles that come early, shapes, the ramp
    assert both.startswith("  130 to 500 um: elements of 5 mm (as given), 2000 steps of ramp")


def test_elements_on_which_shapes_are_others_are_said_where_there_are_some():
    """On the 5 mm of the published study 500 um is at 0.71, and 130 um is not resolved at all."""
    assert unresolved(study()) == unresolved(study(accuracy="fine")) == []
    *_, sentence = unresolved(study(mesh={"element_size_mm": 5}))
    assert sentence.startswith("The elements of foil of 500 um are 0.71 times sqrt(R t) wide.")
    assert "mesh.energy_error_percent: 10" in sentence
    # what is advised is fine enough
    assert unresolved(study(mesh={"energy_error_percent": 10})) == []
    other = {"element_size_mm": 5, "element": "one_point"}
    assert not any("other shapes" in each for each in unresolved(study(mesh=other)))


def test_a_ramp_that_hurries_a_foil_is_said_where_there_is_one():
    """In the steps of the published study 500 um has 10 for each unit of R/t, 130 um 2.6."""
    assert hurried(study()) == hurried(study(accuracy="fine")) == []
    (sentence,) = hurried(study(relaxation={"ramp_steps": 2000}))
    assert sentence.startswith("The ramp hurries foil of 130, 500 um: 2.6 to 10 steps for each")
    (sentence,) = hurried(study(relaxation={"ramp_steps": 8000}))
    assert sentence.startswith("The ramp hurries foil of 130 um: 10 steps")
    steps = {"relaxation": {"ramp_steps": 2000}}
    installation = {"moves": [{"shorten_percent": 125}]}
    assert hurried(study(method={"path": "installation"}, installation=installation, **steps))
    assert not hurried(study(method={"path": "minimisation"}, **steps))


@pytest.mark.parametrize("thickness_um", [322, 130])
def test_no_rounding_makes_the_standard_ramp_a_hurried_one(thickness_um):
    """Of 13 mm and 322 um it has 807 steps, which are 39.98 for each unit of R/t."""
    sheet = {"diameter_mm": 13, "gap_height_mm": 13}
    sweep = {"thickness_um": [thickness_um], "reference_height_mm": [15], "realisations": 1}
    assert not hurried(study(sheet=sheet, sweep=sweep))


@pytest.mark.parametrize("given", [{"accuracy": "quick"}, {"relaxation": {"ramp_steps": 900}}])
def test_what_is_said_of_a_hurried_ramp_cures_it(given):
    (sentence,) = hurried(study(**given))
    (slowness,) = re.findall(r"set relaxation.ramp_slowness: (\d+)", sentence)
    assert not hurried(study(**given | {"relaxation": {"ramp_slowness": int(slowness)}}))
    yielding = {"law": "plastic", "name": "FEP"}
    (steps,) = (
        re.findall(r"set relaxation.ramp_steps: (\d+)", slip)
        for slip in likely_slips(study(material=yielding, relaxation={"ramp_steps": 900}))
        if "yields by the hurry" in slip
    )
    assert not hurried(study(material=yielding, relaxation={"ramp_steps": int(steps[0])}))


def test_a_size_that_the_tolerance_does_not_decide_says_what_does():
    wide = study(mesh={"energy_error_percent": 90})
    assert wide.sized_by(500) == "width of folds"
    sheet = {"diameter_mm": 100, "gap_height_mm": 10}
    sweep = {"thickness_um": [1000], "reference_height_mm": [12], "realisations": 1}
    assert study(sheet=sheet, sweep=sweep).sized_by(1000) == "cylinder size"


def test_in_python_the_word_sizes_the_mesh():
    foil = Foil(0.2, 0.17, 0.13, 500e-6, "FEP")
    sizes = [Mesh.resolving(foil, Accuracy.named(word).energy_error).element_size for word in WORDS]
    assert sizes == [5.1e-3, 3.22e-3, 2.04e-3]
    assert "quick" in repr(Accuracy.named("quick")) and len(repr(Accuracy.named("quick"))) < 200


# --- what it costs --------------------------------------------------------------------------------


def refinements_expected(**sections):
    return [len(each.elements) - 1 for each in expected(study(**sections)).configurations]


def test_sweeps_of_amplitude_are_counted_for_each_motion():
    """Axially one, radially two: the directions of the stiffness have so many axes."""
    plain, axial, both = (
        expected(study(amplitude={"directions": names})).configurations[0].seconds_of["response"]
        for names in ([], ["axial"], ["axial", "radial"])
    )
    assert axial > 2 * plain and both - plain == pytest.approx(3 * (axial - plain))


def test_a_shape_is_expected_to_be_refined_until_its_error_meets_the_demand():
    """Of which the width of the elements decides, where all meshes agree otherwise."""
    alike = np.array([1e4, 3e4])
    mesh, sweep = {"element_size_mm": 4}, SWEEP | {"thickness_um": [250, 500]}
    for percent in (10, 5, 2, 1, 0.3):
        stiffness = {"error_percent": percent, "refinements": 3}
        config = study(sweep=sweep, mesh=mesh, stiffness=stiffness)
        for cell, each in zip(config.cells(), expected(config).configurations, strict=True):
            patch = patch_of(config.crumple_task(cell))
            size = max(patch.size_around, patch.size_along)
            width = size / np.sqrt(0.1 * cell.thickness_um * 1e-6)
            stated = [limit_by_need([alike] * (k + 1), alike, width)[1] for k in (1, 2, 3)]
            met = [k for k, error in enumerate(stated, 1) if error <= percent / 100]
            assert len(each.elements) - 1 == min(met, default=3)


def test_no_more_refinements_are_expected_than_may_be_made():
    demand, sweep = {"error_percent": 0.01}, SWEEP | {"thickness_um": [500]}
    for most in (1, 2, 3):
        stiffness = demand | {"refinements": most}
        assert refinements_expected(sweep=sweep, stiffness=stiffness) == [most] * 2
        assert refinements_expected(sweep=sweep, stiffness={"refinements": most}) == [most] * 2


def test_a_finer_word_costs_more_and_memory_is_told_for_all_refinements():
    costs = [expected(study(accuracy=word)) for word in ("quick", "standard", "fine")]
    seconds = [cost.processor_seconds for cost in costs]
    assert seconds == sorted(seconds) and seconds[-1] > 3 * seconds[0]
    (quick, *_) = costs
    assert [len(each.elements) for each in quick.configurations] == [2] * 4
    assert quick.most_memory_mb > 2 * quick.peak_memory_mb
    fixed = expected(study(stiffness={"refinements": 2}))
    assert fixed.most_memory_mb == fixed.peak_memory_mb
    assert [len(each.elements) for each in fixed.configurations] == [3] * 4


def test_refinements_by_need_are_no_more_than_a_mesh_can_carry():
    sweep = SWEEP | {"thickness_um": [50], "reference_height_mm": [170, 250]}
    config = study(sweep=sweep)
    assert [config.response_task(cell).refinements for cell in config.cells()] == [1, 1]
    with pytest.raises(ConfigError, match="as a coarser accuracy does"):
        study(sweep=sweep, accuracy="fine")
