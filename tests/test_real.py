"""What separates simulation from measurement: models as data, laws, chart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from foilstudy.base.cube import open_cube
from foilstudy.base.errors import ConfigError, Refusal
from foilstudy.base.reference import published
from foilstudy.config import load_config
from foilstudy.measure.verdicts import FAULTS
from foilstudy.study.kernel.plan import Record
from foilstudy.study.real import studied, trial
from foilstudy.study.real import words as words_module
from foilstudy.study.real.figures import chart
from foilstudy.study.real.laws import fit, found, levels
from foilstudy.study.real.plan import STUDY
from foilstudy.study.real.settings import FOLDER, Ladder, cube_of, ladder
from foilstudy.study.real.studied import realisations
from foilstudy.study.real.tables import laws, page, trials
from foilstudy.study.real.words import words
from foilstudy.study.settings import read_settings

CASES = STUDY.parts[0].cases
LADDER = ladder("real")
BETA, GAMMA = -0.6, 1.5


def stiffness(case, scale=1.0):
    overlength = 100 * (case.height_mm / 130 - 1)
    return scale * (overlength / 31) ** BETA * (case.thickness_um / 250) ** GAMMA


def measured(case):
    law = published().power_laws["radial"]["experiment"].law
    return law.stiffness(100 * (case.height_mm / 130 - 1), case.thickness_um)


def record(case):
    """A record: stress-free and radially twice the measured stiffness, at 31 % five times."""
    times = 5 if case.height_mm == 170 else 2
    scatter = 1.01 ** (2 * (CASES.index(case) % 2) - 1)
    values = [stiffness(case), times * measured(case) * scatter]
    result = {"status": "converged", "message": "", "static_stiffness": values}
    result["frequency"] = [1.0, 20.0]
    return Record("trials", case, result | {"prestressed_stiffness": [-1.0, np.nan]}, None)


@pytest.fixture(scope="module")
def outcome():
    return found({"trials": {case: record(case) for case in CASES}})


def test_a_power_law_is_found_again():
    overlength, thickness = fit({case: stiffness(case, 7.0) for case in CASES})
    assert (overlength.value, thickness.value) == pytest.approx((BETA, GAMMA))


def test_many_seeds_of_the_same_foils_do_not_make_a_law_that_does_not_hold_well_known():
    foils = {(case.thickness_um, case.height_mm): case for case in CASES}
    bent = {case: stiffness(case) * (1 + (case.height_mm == 170)) for case in foils.values()}
    widths = []
    for seeds in (2, 20):
        values = {replace(c, seed=s): v * 1.001**s for c, v in bent.items() for s in range(seeds)}
        overlength, _ = fit(values)
        widths.append(overlength.high - overlength.low)
    assert widths[1] > 0.8 * widths[0]


def test_what_is_not_positive_has_no_logarithm():
    values = {case: stiffness(case) for case in CASES}
    values[CASES[0]] = -1.0
    assert fit(values)[0].value == pytest.approx(BETA)
    assert fit({case: np.nan for case in CASES}) is None


def test_one_thickness_makes_no_law():
    one = {c: stiffness(c) for c in CASES if c.thickness_um == CASES[0].thickness_um}
    assert fit(one) is None


def test_laws_are_held_against_the_measured_one(outcome):
    models = {step.name for step in LADDER.steps}
    radial = [law for law in outcome.laws if law.direction == "radial" and law.step in models]
    assert {law.step for law in radial} == {step.name for step in LADDER.steps}
    for law in radial:
        assert law.state == "stress-free"  # no tangent above is positive
        for term, times in zip(levels(), (2, 5, 2), strict=True):
            known = law.terms[term]
            assert known.low < times < known.high
            assert known.value == pytest.approx(times, rel=0.01)
    for law in outcome.laws:
        if law.step == "experiment":
            assert [law.terms[term].value for term in levels()] == [1, 1, 1]


def test_tables_and_chart_show_every_model(outcome):
    assert len(trials(outcome)) == len(CASES)
    assert "frequency_axial" not in trials(outcome)[0]
    assert trials(outcome)[0]["static_stiffness_axial"] == pytest.approx(stiffness(CASES[0]))
    assert {row["step"] for row in laws(outcome)} > {step.name for step in LADDER.steps}
    for step in LADDER.steps:
        assert step.words in page(outcome)
    labels = {text.get_text() for text in chart(outcome).axes[0].get_yticklabels()}
    of_studies = [entry.words for entry in LADDER.studied]
    assert labels == {"published simulation", *(step.words for step in LADDER.steps), *of_studies}


@pytest.mark.parametrize("step", LADDER.steps, ids=lambda step: step.name)
def test_every_model_is_a_configuration(step):
    case = next(case for case in CASES if case.step == step.name)
    study = load_config(trial._configured(case, LADDER.sections_of(step.name)))
    cell = study.cells()[case.seed]
    assert (cell.thickness_um, cell.seed) == (case.thickness_um, case.seed)


def test_a_step_has_the_sections_of_the_one_it_comes_after():
    names = {step.name: step for step in LADDER.steps}
    for step in names.values():
        if step.after is not None:
            inherited = LADDER.sections_of(step.after)
            mine = LADDER.sections_of(step.name)
            kept = set(inherited) - set(step.sections)
            assert {name: mine[name] for name in kept} == {n: inherited[n] for n in kept}


def test_another_content_is_another_case():
    assert len({(case.step, case.content) for case in CASES}) == len(LADDER.steps)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("after: elastic", "after: rubber", "comes after 'rubber', which is none of the steps"),
        ("name: plastic", "name: elastic", "two steps are called 'elastic'"),
        ("seeds: 2", "seeds: 0", "seeds: "),
        ("name: elastic_resolved", "name: elastic", "two models are called 'elastic'"),
    ],
)
def test_a_wrong_file_is_refused_in_a_sentence(tmp_path, old, new, words):
    path = tmp_path / "real.yaml"
    path.write_text((FOLDER / "real.yaml").read_text().replace(old, new, 1))
    with pytest.raises(ConfigError, match=words):
        read_settings(path, Ladder)


def test_models_may_be_studies_as_their_cubes_have_them(outcome):
    for entry in LADDER.studied:
        values = realisations(entry)
        assert {made.content for made in values} == set(entry.studies)
        assert {made.thickness_um for made in values} <= set(LADDER.thickness_um)
        assert {made.height_mm for made in values} <= set(LADDER.reference_height_mm)
        cubes = {name: open_cube(cube_of(name)) for name in entry.studies}
        for made, result in values.items():
            cell = cubes[made.content].sel(thickness=made.thickness_um, seed=made.seed)
            cell = cell.isel(overlength=list(cell["reference_height"]).index(made.height_mm))
            assert result["static_stiffness"] == pytest.approx(cell["static_stiffness"].values)
        laws_of = [law for law in outcome.laws if law.step == entry.name]
        assert {law.direction for law in laws_of} == {"axial", "radial"}
        assert all(law.of == len(values) for law in laws_of)


def test_a_realisation_with_a_fault_and_a_study_that_is_not_there_do_not_count(
    tmp_path, monkeypatch
):
    entry = LADDER.studied[0]
    with xr.open_dataset(cube_of(entry.studies[0])) as cube:
        spoilt = cube.load()
    sound = realisations(entry)
    (folder := tmp_path / entry.studies[0]).mkdir()
    monkeypatch.setattr(studied, "cube_of", lambda study: tmp_path / study / "cube.nc")
    with pytest.raises(Refusal, match="run that study, or remove it there"):
        realisations(entry)
    bit = spoilt["verdict"].attrs["flag_meanings"].split().index(FAULTS[0])
    spoilt["verdict"][0, 0, 0] = 1 << bit
    spoilt["status"] = spoilt["status"].astype(object)
    spoilt["status"][0, 2, 0] = "failed"
    spoilt["status"][0, 4, 0] = "not_needed"
    spoilt.to_netcdf(folder / "cube.nc")
    values = realisations(entry)
    assert len(values) == len(sound) - 1
    unknown = [made for made, r in values.items() if np.isnan(r["static_stiffness"]).all()]
    places = [(130, 135, 0), (130, 170, 0)]
    assert [(made.thickness_um, made.height_mm, made.seed) for made in unknown] == places


def test_what_is_shown_depends_on_the_cubes(tmp_path, monkeypatch):
    before = words("real")
    assert all(len(before[entry.name][1]) > 8 for entry in LADDER.studied)
    monkeypatch.setattr(words_module, "cube_of", lambda study: tmp_path / study / "cube.nc")
    after = words("real")
    changed = {name for name in before if before[name] != after[name]}
    assert changed == {entry.name for entry in LADDER.studied}


def test_a_trial_is_a_study_of_one_foil(monkeypatch):
    coarse = {"mesh": {"element_size_mm": 18}, "relaxation": {"ramp_steps": 100}}
    models = LADDER.model_copy(update={"sections": {**LADDER.sections, **coarse}})
    monkeypatch.setattr(trial, "ladder", {"real": models}.get)
    case = replace(CASES[0], thickness_um=500, height_mm=150, seed=1)
    result = trial.measure(case, "real")
    assert result["status"] == "converged"
    assert np.shape(result["static_stiffness"]) == (2,)
    assert np.all(np.array(result["static_stiffness"]) > 0)
    assert "control_points" not in result
