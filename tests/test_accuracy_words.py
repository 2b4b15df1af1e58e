"""What the words of accuracy cost and how far off they are: a side study as data."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from foilstudy.base.costs import Cost
from foilstudy.config import load_config
from foilstudy.config.accuracy import ACCURACIES
from foilstudy.study.accuracy.figures import chart
from foilstudy.study.accuracy.plan import NAME, STUDY
from foilstudy.study.accuracy.summary import QUANTITIES, SLOW, found, page, table, trials
from foilstudy.study.kernel.plan import Record
from foilstudy.study.real import trial
from foilstudy.study.real.settings import ladder

CASES = STUDY.parts[0].cases
STEPS = {step.name: step for step in ladder(NAME).steps}


def configured(name):
    case = next(case for case in CASES if case.step == name)
    return load_config(trial._configured(case, ladder(NAME).sections_of(name)))


def record(case):
    """Quick is twice as stiff axially in its own ramp, with a crumple that came to no rest."""
    axial = 2e3 if case.step == "quick" else 1e3
    scattered = axial * (1 + 0.1 * (case.seed % 2))
    energies = {"membrane_energy": 0.5, "bending_energy": 2.0, "stabilisation_energy": 0.01}
    times = {"seconds_crumple": 2.0, "seconds_static": 1.0, "seconds_dynamic": 1.5}
    values = {"static_stiffness_converged": np.array([scattered, 3e4]), **energies, **times}
    result = {"status": "converged", "message": "", "steps": 8000, **values}
    if case.step == "quick" and case.seed == 3:
        result = {"status": "failed", "message": "no rest"}
    return Record("trials", case, result, Cost(6.0, 5.0 + case.seed, 800.0))


@pytest.fixture(scope="module")
def outcome():
    return found({"trials": {case: record(case) for case in CASES}})


def test_every_word_is_measured_with_its_own_tolerances():
    assert set(ACCURACIES) <= set(STEPS)
    for name, word in ACCURACIES.items():
        study = configured(name)
        assert study.mesh.energy_error_percent == word.energy_error_percent
        assert study.relaxation.ramp_slowness == word.ramp_slowness
        assert study.stiffness.error_percent == word.stiffness_error_percent
        assert study.dynamics.tolerance == word.reduction_tolerance


def test_the_slow_one_has_ten_times_the_steps_on_the_same_mesh():
    quick, slow = configured("quick"), configured(f"quick{SLOW}")
    assert slow.relaxation_of(500).ramp_steps == 10 * quick.relaxation_of(500).ramp_steps
    assert slow.mesh_of(500) == quick.mesh_of(500)


def test_means_are_of_what_came_to_rest_and_ratios_of_means(outcome):
    known = {each.step: each for each in outcome.words}
    assert (known["quick"].rested, known["quick"].of) == (9, 10)
    assert known["quick"].means["axial"].n == 9
    assert known["quick"].ratios["axial"].value == pytest.approx(2.0, rel=0.02)
    assert known["standard"].ratios["radial"].value == 1.0
    assert not known["fine"].ratios
    assert known["standard"].cpu_seconds == 7.5
    assert known["standard"].seconds == {"crumple": 2.0, "static": 1.0, "dynamic": 1.5}


def test_tables_and_chart_have_every_word(outcome):
    assert {row["step"] for row in table(outcome)} == set(STEPS)
    assert {row["quantity"] for row in table(outcome)} == set(QUANTITIES)
    rows = trials(outcome)
    assert len(rows) == len(CASES)
    assert [row["status"] for row in rows if not np.isfinite(row["energy"])] == ["failed"]
    text = page(outcome)
    for step in STEPS.values():
        assert step.words in text
    assert "9 of 10" in text
    assert "quick over quick, but in ten times its ramp, 500 µm: energy **1.00**" in text
    panels = chart(outcome).axes
    assert [panel.get_title() for panel in panels] == list(QUANTITIES)
    assert all(len(panel.containers) == len(STEPS) for panel in panels)


def test_a_word_that_means_something_else_is_another_case(monkeypatch):
    before = {case.step: case.content for case in CASES}
    other = replace(ACCURACIES["quick"], ramp_slowness=5.0)
    monkeypatch.setitem(ACCURACIES, "quick", other)
    after = {case.step: case.content for case in ladder(NAME).trials()}
    changed = {step for step in before if before[step] != after[step]}
    assert changed == {"quick"}  # the slow one says its ramp itself
