"""The dynamics study: its records, tables and figures, on a mesh of seconds."""

import csv

import numpy as np
import pytest

from foilstudy.base.files import read_json, write_json
from foilstudy.model.foil import Foil
from foilstudy.model.shell.elements import DEFAULT_ELEMENT
from foilstudy.pipeline.crumpled import Crumple
from foilstudy.plot.save import save
from foilstudy.study.dynamics import measure, plan, records, tables
from foilstudy.study.dynamics.figures import FIGURES


def test_names_say_which_model():
    for model in (*plan.CHARTED, *plan.CHECKED):
        assert plan.Model.named(model.name) == model
    assert len({model.name for model in plan.CHARTED}) == len(plan.CHARTED)


@pytest.fixture(scope="module")
def study(coarse_crumple, tmp_path_factory):
    """Every record made of the coarse crumple, whatever its name says."""
    sheet = coarse_crumple.sheet
    foil = Foil(0.2, 0.17, 0.13, 500e-6, sheet.material)
    points = coarse_crumple.points
    crumple = Crumple(foil, sheet.patch, points, sheet.reference, DEFAULT_ELEMENT)
    folder = tmp_path_factory.mktemp("dynamics")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measure, "read_crumple", lambda *_: crumple)
        patch.setattr(measure, "CUTOFFS_HZ", dict.fromkeys((0, 1, 2), (1000.0,)))
        patch.setattr(measure, "TOLERANCES", dict.fromkeys((0, 1, 2), (1e-3,)))
        patch.setattr(measure, "_FREQUENCIES", np.array([30.0, 300.0, 800.0]))
        made = {
            stressed: measure.chart(plan.Model(500, prestressed=stressed).name, "")
            for stressed in (False, True)
        }
        checked = measure.check(plan.Model(500).name, "")
    for model in plan.CHARTED:
        record = made[model.prestressed] | {"name": model.name}
        write_json(record, folder / f"charts/{model.name}.json")
    for model in plan.CHECKED:
        write_json(checked | {"name": model.name}, folder / f"checks/{model.name}.json")
    return records.Study.read(folder)


def test_default_reduction_meets_the_truth(study):
    model = plan.Model(500)
    (row,) = study.rows(model, "rational_krylov")
    assert row.error < 1e-3 and row.estimate < 1e-3 and row.valid_to_hz == 800
    assert study.checks[model]["error"] < 1e-3
    (stressed,) = study.rows(plan.Model(500, prestressed=True), "rational_krylov")
    assert stressed.error < 1e-3


def test_guyan_is_the_worst(study):
    errors = {row.method: row.error for row in study.rows(plan.Model(500))}
    assert max(errors, key=errors.get) == "guyan"


def test_modes_of_two_reductions_are_the_same(study):
    modes = study.charts[plan.Model(500)]["modes"]
    matrix = measure.mode_correlation(modes["rational_krylov"], modes["hintz_herting"])
    np.testing.assert_allclose(np.diag(matrix), 1, atol=1e-3)


def test_tables_hold_what_was_measured(study, tmp_path):
    tables.write_chart(study, tmp_path / "chart.csv")
    tables.write_checks(study, tmp_path / "checks.csv")
    tables.write_markdown(study, tmp_path / "page.md")
    with (tmp_path / "chart.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 4 * len(plan.CHARTED)
    assert {row["method"] for row in rows} == set(records.METHODS)
    with (tmp_path / "checks.csv").open() as file:
        assert len(list(csv.DictReader(file))) == len(plan.CHECKED)
    assert "largest error" in (tmp_path / "page.md").read_text()


@pytest.mark.parametrize("name", FIGURES)
def test_figures_can_be_drawn(name, study, tmp_path):
    save(FIGURES[name](study), tmp_path / name)
    assert (tmp_path / f"{name}.png").stat().st_size > 10_000


def test_a_failed_reduction_is_left_out(study, tmp_path):
    model = plan.Model(500)
    record = {"rows": [{"method": "guyan", "order": 0.0, "failed": "why"}]}
    write_json(record, tmp_path / "record.json")
    other = records.Study({model: read_json(tmp_path / "record.json")}, {})
    assert other.rows(model) == []
