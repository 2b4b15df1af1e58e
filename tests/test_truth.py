"""How far the true stiffness depends on the method: steps as data, ratios of means."""

from __future__ import annotations

import numpy as np
import pytest

from foilstudy.base.confidence import MeanInterval, Ratio
from foilstudy.base.errors import ConfigError
from foilstudy.config import load_config
from foilstudy.study.kernel.plan import Record
from foilstudy.study.real import trial
from foilstudy.study.real.settings import FOLDER, Ladder, ladder
from foilstudy.study.settings import read_settings
from foilstudy.study.truth.figures import chart
from foilstudy.study.truth.influences import SHOWN, found, page, table
from foilstudy.study.truth.plan import STUDY

CASES = STUDY.parts[0].cases
MODELS = ladder("truth")
STEPS = {step.name: step for step in MODELS.steps}


def record(case):
    """True stiffness by the ramp of 2 000 steps three quarters of that by the usual one."""
    factor = 0.75 if case.step == "ramp_2000" else 1.0
    scattered = factor * 1e3 * case.thickness_um * (1 + 0.1 * (case.seed % 2))
    values = {"true_stiffness": [scattered, 3 * scattered], "static_stiffness": [1e4, 2e4]}
    return Record("trials", case, {"status": "converged", "message": "", **values}, None)


@pytest.fixture(scope="module")
def outcome():
    return found({"trials": {case: record(case) for case in CASES}})


@pytest.mark.parametrize("name", STEPS)
def test_every_way_is_a_configuration(name):
    mine = [case for case in CASES if case.step == name]
    seeds = STEPS[name].seeds or MODELS.seeds
    study = load_config(trial._configured(mine[-1], MODELS.sections_of(name)))
    assert study.cells()[mine[-1].seed].seed == seeds - 1
    assert len(mine) == seeds * len(STEPS[name].thickness_um or MODELS.thickness_um)


def test_what_it_stands_beside_has_its_foils(tmp_path):
    path = tmp_path / "truth.yaml"
    text = (FOLDER / "truth.yaml").read_text()
    path.write_text(text.replace("thickness_um: [500]", "thickness_um: [700]", 1))
    with pytest.raises(ConfigError, match="foil of 700 um and 170 mm, which 'usual', beside which"):
        read_settings(path, Ladder)


def test_a_ratio_of_means_is_found_with_its_interval(outcome):
    known = {(e.step, e.thickness_um, e.state, e.direction): e for e in outcome.influences}
    for thickness in (250, 500):
        for direction in ("axial", "radial"):
            each = known["ramp_2000", thickness, "with its stresses", direction]
            assert each.ratio.value == pytest.approx(0.75)
            assert each.ratio.low < 0.75 < each.ratio.high < 0.8
            assert each.mean.n == 10
    assert known["usual", 500, "with its stresses", "axial"].ratio is None
    assert known["usual", 500, "with its stresses", "axial"].of == 10
    assert known["kinetic", 500, "stress-free", "axial"].ratio.value == 1


def test_tables_have_every_way(outcome):
    assert {row["step"] for row in table(outcome)} == set(STEPS)
    for step in STEPS.values():
        assert step.words in page(outcome)
    assert "**0.75** (" in page(outcome)
    lines = [text.get_text() for text in chart(outcome).axes[0].get_yticklabels()]
    assert len(lines) == len({(e.step, e.thickness_um) for e in outcome.influences if e.ratio})


def test_the_interval_of_a_ratio_covers_it():
    """Of lognormal samples as scattered as crumples, in 95 % of the cases."""
    random = np.random.default_rng(0)
    drawn = np.exp(0.4 * random.standard_normal((400, 2, 10)))
    ratios = [Ratio.of(*(MeanInterval.of(each) for each in pair)) for pair in drawn]
    covered = np.mean([ratio.low < 1 < ratio.high for ratio in ratios])
    assert 0.91 < covered < 0.98


def test_what_one_value_says_has_no_interval():
    ratio = Ratio.of(MeanInterval.of([2.0]), MeanInterval.of([1.0, 1.0]))
    assert ratio.value == 2 and np.isnan(ratio.low)


def test_what_stands_beside_nothing_known_is_refused(tmp_path):
    path = tmp_path / "truth.yaml"
    text = (FOLDER / "truth.yaml").read_text().replace("beside: usual", "beside: nothing", 1)
    path.write_text(text)
    with pytest.raises(ConfigError, match="stands beside 'nothing', which is none of the steps"):
        read_settings(path, Ladder)


@pytest.mark.parametrize("step", ["kinetic", "usual"])
def test_a_stiffness_that_is_not_positive_makes_no_ratio(step):
    def turned(case):
        result = record(case)
        if case.step == step and case.seed == 3 and case.thickness_um == 500:
            return Record("trials", case, result.result | {"true_stiffness": [-1.0, 1.0]}, None)
        return result

    found_out = found({"trials": {case: turned(case) for case in CASES}})
    kinetic = [e for e in found_out.influences if e.step == "kinetic" and e.state == SHOWN[0]]
    assert [each.ratio is None for each in kinetic] == [True, False]
    assert "not positive in 1 of 10" in page(found_out)
