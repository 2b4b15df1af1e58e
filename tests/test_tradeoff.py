"""Speed against accuracy: settings as data, errors and times of made-up records, and the knees."""

import csv
from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest
from side_study import write_results

from foilstudy.base.errors import ConfigError, Refusal
from foilstudy.base.tables import csv_text
from foilstudy.config import load_config
from foilstudy.config.scene import dynamics_of, method_of
from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumpled import Recipe
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.study.changes import changed, value_at
from foilstudy.study.kernel.files import read_records
from foilstudy.study.settings import read_settings
from foilstudy.study.tradeoff import ensembles, figures, panel, tables
from foilstudy.study.tradeoff.adaptive import present
from foilstudy.study.tradeoff.frozen import Static
from foilstudy.study.tradeoff.knees import beaten, worth_more
from foilstudy.study.tradeoff.pace import in_turns
from foilstudy.study.tradeoff.plan import LADDERS, RESOLVED, STUDY
from foilstudy.study.tradeoff.points import bias, default_of, text_of
from foilstudy.study.tradeoff.settings import Point, Settings

ROOT = Path(__file__).parents[1]
RECIPE = Recipe(Mesh(5e-3), Imperfection(), Method())


# --- settings ------------------------------------------------------------------------------------


@pytest.mark.parametrize("ladder", LADDERS, ids=lambda ladder: ladder.name)
def test_every_setting_changes_the_default_of_its_ladder(ladder):
    default = default_of(ladder)
    assert ladder.default.applied(default) == default
    for point in set(ladder.points) - {ladder.default}:
        assert point.applied(default) != default, point


def test_a_setting_is_changed_in_its_place_and_unit_and_nothing_else():
    place = "method.path.scheme.mass.safety"
    assert value_at(changed(RECIPE, place, 3.0), place) == 3.0
    assert changed(changed(RECIPE, place, 3.0), place, value_at(RECIPE, place)) == RECIPE
    assert changed(RECIPE, "mesh.element_size_mm", 2.5).mesh == Mesh(2.5e-3)
    assert value_at(RECIPE, "mesh.element_size_mm") == 5.0
    assert value_at(RECIPE, "method.path") == "relaxation"
    assert changed(RECIPE, "method.path", "relaxation") == RECIPE
    modal = Point(change="cutoff_hz", value=900, beside="reduction.hintz_herting")
    assert modal.applied(DynamicsOptions()) == DynamicsOptions("hintz_herting", cutoff_hz=900)


def test_a_place_that_is_none_is_refused_with_those_there_are():
    with pytest.raises(Refusal, match="Mesh has no 'size'; use one of element, element_size"):
        changed(RECIPE, "mesh.size", 1.0)
    with pytest.raises(Refusal, match="'straight' is not a known path; use one of relaxation"):
        changed(RECIPE, "method.path", "straight")


def test_a_malformed_file_is_refused_with_the_place(tmp_path):
    path = tmp_path / "tradeoff.yaml"
    path.write_text("panel: [{family: size, change: way.size_mm}]", encoding="utf-8")
    with pytest.raises(ConfigError, match=r"tradeoff.yaml: panel.0.values: Field required"):
        read_settings(path, Settings)


def test_the_charted_defaults_are_those_of_a_study():
    config = load_config({"sweep": {"thickness_um": [500], "reference_height_mm": [170]}})
    assert method_of(config.crumple_task(config.cells()[0])) == Method()
    assert dynamics_of(config.dynamics) == DynamicsOptions()
    stiffness = Static().error_percent, Static().refinements
    assert stiffness == (config.stiffness.error_percent, config.stiffness.refinements)


# --- what is measured ----------------------------------------------------------------------------


def test_turns_take_the_least_time_of_each_and_the_result_of_the_own():
    calls = []
    result, times = in_turns(lambda: calls.append("own") or 3, lambda: calls.append("default"))
    assert result == 3
    assert calls == ["default"] + ["own", "default"] * 20
    assert 0 <= times["seconds"] < 1 and 0 <= times["pace"] < 1


def test_an_ensemble_is_crumpled_by_its_seeds_and_says_which_failed():
    """A mesh of 15 mm, so that it is quick; too little mass, so that it cannot rest."""
    point = Point(500, 170, 15.0, 2)
    found = ensembles.measure(point)
    assert np.isfinite(found["energy"]).all() and found["energy"][0] != found["energy"][1]
    assert (np.array(found["radial"]) > np.array(found["axial"])).all()
    assert len(found["seconds"]) == 2 and 0 < found["pace"] < sum(found["seconds"])
    unstable = Point(500, 170, 15.0, 2, "method.path.scheme.mass.safety", 0.3)
    failed = ensembles.measure(unstable)
    assert np.isnan(failed["energy"]).all() and len(failed["seconds"]) == 2


def test_a_panel_is_held_against_itself():
    surface = np.zeros((3, 11, 17))
    true = {"energy": 2.0, "surface": surface}
    moved = surface + np.array([0.0, 0.0, 1.5e-4])[:, None, None]
    assert panel.errors(true, true) == {"energy": 0.0, "shape": 0.0}
    found = panel.errors({"energy": 2.2, "surface": moved}, true)
    assert found == pytest.approx({"energy": 0.1, "shape": 0.01})
    lost = panel.errors({"energy": None, "surface": moved}, true)
    assert np.isnan(list(lost.values())).all()


# --- what is made of it --------------------------------------------------------------------------


def test_the_interval_of_a_bias_covers_the_truth_as_often_as_it_says():
    rng = np.random.default_rng(0)
    draws = [
        bias(rng.normal(1.1, 0.3, 10), rng.normal(1.0, 0.1, 10), of_itself=False)
        for _ in range(2000)
    ]
    covered = np.mean([abs(draw.value - 0.1) < draw.interval for draw in draws])
    assert 0.94 < covered < 0.98  # a little wide, as the smaller ensemble decides


def test_what_came_to_no_rest_does_not_count_in_a_mean():
    true = np.array([1.0, 1.2, 0.8])
    assert bias([2.0, 2.2, np.nan], true).value == pytest.approx(1.1)
    assert np.isnan(bias([2.0, np.nan, np.nan], true).value)
    assert bias(true, true, of_itself=True).interval < bias(true, true).interval
    assert bias(true, true).scatter == pytest.approx(0.2)


ADAPTIVE = {
    "elements": 24, "energy": 1.0, "levels": [[0, 0, 1, 1, 1, 1], [0, 0, 1, 1, 1, 1]] * 2,
    "shares": [0, 0, 0.25, 0.75, 0, 0], "errors": [0.05, 0.2, 0.4, 0.6],
    "gain": {"ideal": 3.0, "unbalanced": 2.2, "tree": 2.0, "graded": 1.2}, "kernel": 8.0,
    "ramp": {"steps": [0.5, 1.0], "shortening": [0.5, 1.0], "size": [2.0, 1.0], "share": 0.4,
             "by_stage": 0.15, "coarsened": 0.5},
}  # fmt: skip


@pytest.fixture
def study(tmp_path):
    """Made-up records: a time and an error for each point, one setting of each ladder without."""
    results = defaultdict(dict)
    surface = np.zeros((3, 11, 17))
    results["truth"]["panel"] = {"energy": 2.0, "energy_error": 0.002, "surface": surface}
    results["steps"]["all"] = [
        {"thickness_um": t, "size_mm": size, "seconds_per_step": 0.01 * size**-2.0}
        for t in (500, 50)
        for size in (5.0, 2.5, 1.25)
    ]
    for case in RESOLVED:
        results["adaptive"][case] = ADAPTIVE
    for case in STUDY.part("shapes").cases:
        results["shapes"][case] = {"points": np.zeros((3, 2, 2)), "dynamic": [1.0]} | {
            "static": [100.0, 200.0],
            "static_error": [1.0, 2.0],
        }
    for ladder in LADDERS:
        for k, point in enumerate(ladder.points):
            results[ladder.part][point] = _made_up(ladder, k)
    records = read_records(STUDY, write_results(STUDY, results, tmp_path))
    return STUDY.findings(records)


def _made_up(ladder, k):
    """Of the k-th point; jobs run slower and slower, and the last point has no answer."""
    last, pace = k == len(ladder.points) - 1, 1.0 + 0.1 * k
    times = {"seconds": pace * (1.0 + k), "pace": pace}
    error = np.nan if last else 0.01 * k
    if ladder.part == "panel":
        return times | {"energy": 2.0 + 2 * error, "surface": np.zeros((3, 11, 17))}
    if ladder.part == "static":
        return times | {"axial": error, "radial": 0.0 - error}
    if ladder.part == "dynamic":
        one = {"failed": "too many modes"} if last else times | {"error": error, "size": 9}
        return {"reduction": one, "grid": one}
    values = [np.nan, 1.0, 1.1] if last else [0.9, 1.0, 1.1]
    crumples = {key: values for key in ensembles.QUANTITIES}
    return crumples | {"seconds": [times["seconds"]] * 3, "pace": pace}


def test_every_point_has_a_row_for_each_quantity_and_the_default_one_in_each_family(study):
    for ladder in LADDERS:
        families = {family.family for family in ladder.families}
        rows = study.of(ladder=ladder.name)
        assert {row.family for row in rows if row.default} == families
        changes = sum(len(family.values) for family in ladder.families)
        quantities = {"panel": 2, "static": 2, "dynamic": 1, "ensembles": 3}[ladder.part]
        assert len(rows) == quantities * (changes + len(families))


def test_ratios_leave_out_how_fast_the_machine_was(study):
    """The k-th point takes k + 1 times the default, whatever the pace of its job."""
    for ladder in LADDERS:
        for row in study.of(ladder=ladder.name):
            if np.isfinite(row.ratio):
                assert row.ratio == pytest.approx(round(row.ratio))
                assert row.seconds == pytest.approx(row.ratio)
        assert {row.ratio for row in study.of(ladder=ladder.name, default=True)} == {1.0}


def test_what_found_no_answer_is_empty_and_on_no_front(study):
    rows = list(csv.DictReader(csv_text(tables.rows(study)).splitlines()))
    lost = [row for row in rows if row["ladder"] == "static, 500 um" and not row["error"]]
    assert lost and not any(row["front"] == "True" for row in lost)
    failed = [row for row in rows if row["failed"] == "1"]
    assert {row["ladder"].split(",")[0] for row in failed} == {"ensembles"}


def test_the_front_is_what_nothing_beats_in_both(study):
    """Made-up errors and times rise together, so that the default alone is there."""
    fronts = study.of(ladder="static, 500 um", quantity="axial", front=True)
    assert fronts and all(row.default for row in fronts)


def test_the_page_tells_defaults_intervals_and_failures(study):
    page = tables.page(study)
    assert "| refinements at most | 2 (default) | 1.00 | 1 | **+0 ± 1 %** | **+0 ± 1 %** |" in page
    assert "Natural scatter of a realisation: energy 10%, axial 10%, radial 10%." in page
    assert ", 1 failed |" in page
    assert "reference ±" in page


def test_every_figure_is_drawn_with_a_panel_for_each_family_and_quantity(study):
    assert len(figures.panel(study).axes) == 2 * len(LADDERS[0].families)
    of_static = [ladder for ladder in LADDERS if ladder.part == "static"]
    rows = sum(len(ladder.families) for ladder in of_static)
    assert len(figures.static(study).axes) == 2 * rows
    ensemble = figures.ensemble(study, "ensembles, 500 um")
    texts = {text.get_text() for ax in ensemble.axes for text in ax.texts}
    assert {"1000", "8000", "one point"} <= texts
    exponents = [text.get_text() for text in figures.run_time(study).axes[0].legend_.texts]
    assert exponents[0] == "500 µm: exponent -2.00 ± 0.00"


def test_what_adapting_saves_is_a_row_and_a_map_for_each_crumple(study):
    rows = list(csv.DictReader(csv_text(present.rows(study)).splitlines()))
    assert [row["thickness_um"] for row in rows] == [str(c.thickness_um) for c in RESOLVED]
    assert float(rows[0]["gain_with_kernel"]) == pytest.approx(0.25)
    assert float(rows[0]["area_2h"]) == 0.25 and float(rows[0]["area_1h"]) == 0.75
    maps = [image.get_array() for ax in present.figure(study).axes for image in ax.images]
    assert [image.shape for image in maps] == [(4, 6)] * len(RESOLVED)


# --- the knees -----------------------------------------------------------------------------------


def row(value, ratio, error, default=False, ladder="a", quantity="energy", failed=0):
    return {
        "ladder": ladder, "setting": "steps", "value": value, "quantity": quantity,
        "ratio": ratio, "error": error, "interval": 0.02, "failed": failed, "default": default,
        "held": True,
    }  # fmt: skip


DEFAULT = row("2000", 1.0, 0.01, default=True)


def test_a_default_is_beaten_by_what_is_cheaper_and_as_accurate():
    sentences = ["steps 500 is as accurate as the default 2000 in 0.50 of the time"]
    assert beaten([DEFAULT, row("500", 0.5, -0.03)]) == sentences


@pytest.mark.parametrize(
    "other",
    [
        row("1000", 0.85, 0.0),
        row("500", 0.5, 0.04),
        row("500", 0.5, -0.04),
        row("500", 0.5, 0.0, failed=1),
        row("500", None, 0.0),
    ],
)
def test_it_is_not_by_what_is_no_cheaper_less_accurate_or_fails(other):
    assert beaten([DEFAULT, other]) == []


def test_an_error_that_is_not_known_is_no_accuracy():
    """It is 40 ± 50 %, as its crumples scatter, where that of the default is 1 ± 2 %."""
    unknown = row("500", 0.5, 0.4) | {"interval": 0.5}
    assert beaten([DEFAULT, unknown]) == []
    assert beaten([DEFAULT | {"interval": 0.5}, unknown]) != []


def test_what_no_study_has_is_not_held():
    rows = [DEFAULT, row("500", 0.5, 0.0)]
    assert beaten([each | {"held": False} for each in rows]) == []


def test_it_is_not_by_what_fails_in_another_quantity_or_ladder():
    for place in ({"ladder": "b"}, {"quantity": "axial"}):
        rows = [DEFAULT, row("500", 0.5, 0.0)]
        assert beaten(rows)
        rows += [DEFAULT | place, row("500", 0.5, 0.1) | place]
        assert beaten(rows) == []


def test_what_is_hardly_dearer_and_far_more_accurate_is_named():
    rough = row("2000", 1.0, 0.3, default=True)
    (sentence,) = worth_more([rough, row("4000", 1.2, 0.1)])
    assert sentence.startswith("a: steps 4000 errs half") and sentence.endswith(
        "1.20 times the time"
    )
    assert worth_more([rough, row("4000", 1.5, 0.1), row("3000", 1.1, 0.2)]) == []
    assert worth_more([rough, row("4000", None, 0.1), row("3000", 1.1, None)]) == []
    assert worth_more([DEFAULT, row("4000", 1.2, 0.0)]) == []  # accurate as it is
    # worse in another quantity
    other = [row("2000", 1.0, 0.01, default=True, quantity="axial")]
    other += [row("4000", 1.2, 0.04, quantity="axial")]
    assert worth_more([rough, row("4000", 1.2, 0.1), *other]) == []


# --- the results of the repository ---------------------------------------------------------------


NUMBERS = ("ratio", "error", "interval", "failed")


@pytest.fixture(scope="module")
def charted():
    """Rows of the table as it was written."""
    with (ROOT / "results/tradeoff/tradeoff.csv").open(encoding="utf-8") as file:
        return [
            each
            | {key: float(each[key]) if each[key] else None for key in NUMBERS}
            | {key: each[key] == "True" for key in ("held", "default")}
            for each in csv.DictReader(file)
        ]


def test_no_setting_beats_a_default(charted):
    assert beaten(charted) == []


def test_none_but_the_frequencies_is_hardly_dearer_and_far_more_accurate(charted):
    """Which are stored, each for all realisations; docs/tradeoff.md says so."""
    found = worth_more(charted)
    assert len(found) == 2 and all("frequencies 400" in sentence for sentence in found)


def test_the_table_is_of_these_settings_and_of_the_defaults_as_they_are(charted):
    wanted = set()
    for ladder in LADDERS:
        for family in ladder.families:
            first = next(each for each in ladder.families if each.family == family.family)
            wanted.add((ladder.name, family.family, text_of(ladder, first, ladder.default), True))
            wanted |= {
                (ladder.name, family.family, text_of(ladder, family, point), False)
                for point in ladder.default.points(family)
            }
    found = {(e["ladder"], e["setting"], e["value"], e["default"]) for e in charted}
    assert found == wanted
