"""The map of methods that fail: its settings, one trial of each kind, and what is shown of it."""

import numpy as np
import pytest
from handmade import ridges
from matplotlib import pyplot as plt

from foilstudy.base.costs import Cost
from foilstudy.base.errors import ConfigError, Refusal
from foilstudy.measure.choices import STRESS_REMOVALS
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.pipeline.measures import STIFFNESS_MEASURES
from foilstudy.solve.choices import DAMPINGS, MASSES, PATHS
from foilstudy.study import jobs
from foilstudy.study.kernel.files import read_record
from foilstudy.study.kernel.plan import Record, case_name
from foilstudy.study.limits.figures import chart, gallery
from foilstudy.study.limits.map import found, mapped
from foilstudy.study.limits.measured import Measured
from foilstudy.study.limits.measures import measure as measure_every_way
from foilstudy.study.limits.measures import page as page_of_measures
from foilstudy.study.limits.measures import rows as rows_of_measures
from foilstudy.study.limits.plan import LIMITS, SETTINGS, STUDY, Trial
from foilstudy.study.limits.published import OBSERVATIONS
from foilstudy.study.limits.quick import STUDY as QUICK
from foilstudy.study.limits.settings import read_limits
from foilstudy.study.limits.tables import page, rows, verdict_words
from foilstudy.study.limits.trial import measure, recipe_of
from foilstudy.study.published import foil

FOIL = foil(500, 170)


def setting(words):
    """Name of the row that is called so."""
    (name,) = [s.name for s in SETTINGS.values() if s.words == words]
    return name


def trial(words, seed=0, thickness=500, size=18.0):
    return Trial(setting(words), thickness, 170, size, seed)


@pytest.mark.parametrize("name", SETTINGS)
def test_every_row_of_the_map_makes_a_recipe(name):
    recipe = recipe_of(Trial(name, 500, 170, 5.0, 0), FOIL)
    default = recipe_of(trial("default", size=5.0), FOIL)
    same = SETTINGS[name].words in (
        "default",
        "ramp of steps, 2000",
        "Gaussian, of the thickness, 0.02",
    )
    assert (recipe == default) == same


def test_the_map_has_every_mass_damping_path_and_element():
    changes = [change for s in SETTINGS.values() for change in s.changes]
    tried = {
        place: {value for where, value in changes if where == place}
        for place in (
            "method.path",
            "method.path.scheme.mass",
            "method.path.scheme.ramp_damping",
            "mesh.element",
        )
    }
    registries = (PATHS, MASSES, DAMPINGS, ELEMENTS)
    for (place, values), registry in zip(tried.items(), registries, strict=True):
        # a fitter's stops are no method that fails
        assert values == set(registry) - {next(iter(registry)), "installation"}, place
    assert {way.measure for way in LIMITS.measures.ways} == set(STIFFNESS_MEASURES)


def test_an_amplitude_may_count_in_thicknesses():
    recipe = recipe_of(trial("Gaussian, of the thickness, 0.1", thickness=100), foil(100))
    assert recipe.imperfection.amplitude == pytest.approx(10e-6)


def test_names_of_cases_tell_settings_apart():
    for study in (STUDY, QUICK):
        cases = study.part("trials").cases
        assert len({case_name(case) for case in cases}) == len(cases)


def test_a_malformed_file_is_refused_with_the_place(tmp_path):
    path = tmp_path / "limits.yaml"
    path.write_text("ramp_slowness: 10\nfoils: []\nquick: []\nmethods: [{group: mass}]\n")
    with pytest.raises(ConfigError, match=r"limits.yaml: methods.0.method: Field required"):
        read_limits(path)
    measures = "measures: {foils: [], ways: []}\n"
    measures += "bounds: {vibrating: [], quarters: [], ways: [], budget: 1}"
    path.write_text(
        f"ramp_slowness: 10\nfoils: []\nquick: []\nmethods: [{{group: a, method: b}}]\n{measures}\n"
    )
    with pytest.raises(ConfigError, match="none is called 'default'"):
        read_limits(path)


@pytest.mark.parametrize(
    ("words", "verdict"),
    [
        ("spectral mass, 0.9", "diverged"),
        ("arc length, sphere", "budget_spent"),
        ("element, uncontrolled", "hourglassed"),
    ],
)
def test_a_trial_is_judged(words, verdict, monkeypatch):
    if verdict == "budget_spent":
        changes = (*SETTINGS[setting(words)].changes[:1], ("method.path.budget", 5))
        short = SETTINGS[setting(words)].__class__("path", "short", "", changes)
        monkeypatch.setitem(SETTINGS, "short", short)
        one = Trial("short", 500, 170, 18.0, 0)
    else:
        one = trial(words, thickness=100 if verdict == "hourglassed" else 500, size=10.0)
    result = measure(one)
    assert verdict in result["verdicts"], result
    if verdict == "budget_spent":
        assert 0 <= result["reached"] < 0.1


def test_what_cannot_be_made_is_a_verdict_and_no_crash(monkeypatch):
    def refuse(*_):
        raise Refusal("no such foil.")

    monkeypatch.setattr("foilstudy.study.limits.trial.crumple", refuse)
    result = measure(trial("default"))
    assert result["verdicts"] == ["diverged"] and "no such foil" in result["message"]


SHAPE = ridges(0, 0.02).astype(np.float32)
GOOD = {
    "status": "converged",
    "message": "at rest",
    "verdicts": ["converged"],
    "membrane_energy": 1.0,
    "bending_energy": 4.0,
    "static_stiffness": [100.0, 300.0],
    "broad_wave_share": 0.4,
    "alternation": -0.5,
    "negative_eigenvalues": 0.0,
    "residual": 1e-9,
    "steps": 2000,
    "hessians": 1,
    "reached": 1.0,
    "seconds": 2.0,
    "points": SHAPE,
}
BAD = {
    "status": "diverged",
    "message": "unstable",
    "verdicts": ["diverged"],
    "points": np.empty(0, np.float32),
}


@pytest.fixture(scope="module")
def fields():
    """Of three methods on one foil: the default, one that is half as stiff, one that fails."""
    results = {
        trial("default", 0): GOOD,
        trial("default", 1): GOOD | {"static_stiffness": [120.0, 340.0]},
        trial("kinetic", 0): GOOD | {"static_stiffness": [50.0, 150.0]},
        trial("kinetic", 1): GOOD | {"static_stiffness": [60.0, 170.0]},
        trial("no mass scaling, 1.1", 0): BAD,
        trial("no mass scaling, 1.1", 1): GOOD | {"broad_wave_share": 0.97},
    }
    records = {case: Record("trials", case, result, Cost()) for case, result in results.items()}
    return mapped({"trials": records})


def test_a_ramp_too_fast_to_tell_its_work_keeps_its_doubt():
    """Which is infinite, and no number in a record."""
    hurried = GOOD | {"work_over_energy": None, "verdicts": ["converged", "rate_dependent"]}
    record = Record("trials", trial("default"), hurried, Cost())
    assert found(record) == ["converged", "rate_dependent"]
    unknown = Record("trials", trial("default"), GOOD | {"work_over_energy": None}, Cost())
    assert found(unknown) == ["converged"]


def test_a_bias_is_against_the_default_and_of_sound_trials(fields):
    default, kinetic, failing = fields
    assert default.bias["axial"].value == 0.0 and default.sound == 2
    assert kinetic.bias["axial"].value == pytest.approx(-0.5)
    assert kinetic.bias["radial"].value == pytest.approx(-0.5)
    # relative standard errors of 50, 60 and of 100, 120
    assert kinetic.bias["axial"].error == pytest.approx(0.5 * np.hypot(1 / 11, 1 / 11), rel=1e-9)
    assert failing.sound == 0 and np.isnan(failing.bias["axial"].value)


def test_tables_tell_what_became_of_each(fields):
    text = page(fields)
    assert "| damping | kinetic | 2 of 2 | none | +0 ± 0 % | -50 ± 6 % | -50 ± 4 % | 2 |" in text
    assert "diverged (1), folded globally (1)" in text
    table = rows(fields)
    assert len(table) == 6 and table[4]["axial"] is None and table[2]["axial"] == 50.0


def test_figures_show_each_verdict_and_an_example(fields):
    figure = chart(fields)
    texts = {text.get_text() for ax in figure.axes for text in ax.texts}
    assert {"+0", "-50", "XF"} <= texts
    assert len(figure.axes) == 3
    # of these rows one is published, of foil of this thickness
    assert [len(ax.patches) for ax in figure.axes] == [1, 1, 1]
    labels = [label.get_text() for label in figure.axes[0].get_yticklabels()]
    assert labels == ["default", "kinetic [2]", "no mass scaling, 1.1"]
    shown = [ax.get_title() for ax in gallery(fields).axes if ax.get_title()]
    assert [title.splitlines()[0] for title in shown] == ["sound", "folded globally"]
    plt.close("all")


def test_what_was_published_is_on_the_map():
    for observation in OBSERVATIONS:
        for row in observation.rows:
            assert any(row in (s.words, s.method) for s in SETTINGS.values()), row


def test_a_crumple_is_measured_in_every_way():
    case = Measured("", 500, 135, 18.0, 300, 0)
    result = measure_every_way(case)
    assert result["status"] == "converged"
    assert set(result["measures"]) == {way.name for way in LIMITS.measures.ways}
    assert set(result["removals"]) == set(STRESS_REMOVALS)
    tangent = result["measures"]["tangent"]["stiffness"]
    assert result["removals"]["reset"]["stiffness"] == pytest.approx(tangent)
    assert result["measures"]["displacement 0.1 mm"]["stiffness"] == pytest.approx(
        tangent, rel=0.01
    )
    records = {"measures": {case: Record("measures", case, result, Cost())}}
    (heads, _, first, *_) = page_of_measures(records).splitlines()
    assert "500 um, 135 mm, ramp 300" in heads and first == "| tangent, axial | 1.00 |"
    table = rows_of_measures(records)
    assert len(table) == 2 * (len(LIMITS.measures.ways) + len(STRESS_REMOVALS))


def test_a_corner_of_the_quick_map_by_its_jobs(tmp_path):
    """As the workflow calls them, and judged by the numbers in their records."""
    words = ("default", "no mass scaling, 1.1", "ring alone, no scaling, ramp, 100")
    part = QUICK.part("trials")
    corner = [
        case
        for case in part.cases
        if SETTINGS[case.setting].words in words and case.thickness_um == 500
    ]
    records = {}
    for case in corner:
        path = tmp_path / part.files(case_name(case))[0]
        path.parent.mkdir(exist_ok=True)
        jobs.measure(QUICK.name, part.name, case_name(case), path)
        records[case] = read_record(QUICK, path)
    fields = mapped({"trials": records})
    default, too_long, ring_alone = map(verdict_words, fields)
    assert (default, too_long) == ("none", "diverged (1)") and "folded globally (1)" in ring_alone
    assert [field.sound for field in fields] == [1, 0, 0]
