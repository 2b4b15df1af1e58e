"""The dynamics study: its records, tables and figures, on a mesh of seconds."""

import numpy as np
import pytest
from side_study import write_results

from foilstudy.model.foil import Foil
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.pipeline.shape import Shape
from foilstudy.plot.save import save
from foilstudy.study.dynamics import measure, plan, records, tables
from foilstudy.study.kernel.files import read_records


@pytest.fixture(scope="module")
def study(coarse_crumple, tmp_path_factory):
    """Every record made of the coarse crumple, whatever its name says."""
    sheet = coarse_crumple.sheet
    foil = Foil(0.2, 0.17, 0.13, 500e-6, sheet.material)
    points = coarse_crumple.points
    crumple = Shape(foil, sheet.patch, points, sheet.reference, Corner())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(measure, "crumple_of", lambda *_: crumple)
        patch.setattr(measure, "CUTOFFS_HZ", dict.fromkeys((0, 1, 2), (1000.0,)))
        patch.setattr(measure, "TOLERANCES", dict.fromkeys((0, 1, 2), (1e-3,)))
        patch.setattr(measure, "_FREQUENCIES", np.array([30.0, 300.0, 800.0]))
        made = {
            stressed: measure.chart(plan.Model(500, prestressed=stressed), {})
            for stressed in (False, True)
        }
        checked = measure.check(plan.Model(500), {})
    folder = tmp_path_factory.mktemp("dynamics")
    results = {
        "charts": {model: made[model.prestressed] for model in plan.CHARTED},
        "checks": dict.fromkeys(plan.CHECKED, checked),
        "shapes": dict.fromkeys(plan.STUDY.part("shapes").cases, {"points": points}),
    }
    write_results(plan.STUDY, results, folder)
    return plan.STUDY.findings(read_records(plan.STUDY, folder))


def test_default_reduction_meets_the_truth(study):
    model = plan.Model(500)
    (row,) = records.succeeded(study, model, "rational_krylov")
    assert row.error < 1e-3 and row.estimate < 1e-3 and row.valid_to_hz == 800
    assert study["checks"][model]["error"] < 1e-3
    (stressed,) = records.succeeded(study, plan.Model(500, prestressed=True), "rational_krylov")
    assert stressed.error < 1e-3


def test_guyan_is_the_worst(study):
    errors = {row.method: row.error for row in records.succeeded(study, plan.Model(500))}
    assert max(errors, key=errors.get) == "guyan"


def test_modes_of_two_reductions_are_the_same(study):
    modes = study["charts"][plan.Model(500)]["modes"]
    matrix = measure.mode_correlation(modes["rational_krylov"], modes["hintz_herting"])
    np.testing.assert_allclose(np.diag(matrix), 1, atol=1e-3)


def test_tables_hold_what_was_measured(study):
    rows = tables.reductions(study)
    assert len(rows) == 4 * len(plan.CHARTED)
    assert {row["method"] for row in rows} == set(records.METHODS)
    assert len(tables.checks(study)) == len(plan.CHECKED)
    assert "largest error" in tables.page(study)


@pytest.mark.parametrize("name", plan.STUDY.figures)
def test_figures_can_be_drawn(name, study, tmp_path):
    save(plan.STUDY.figures[name](study), tmp_path / name)
    assert (tmp_path / f"{name}.png").stat().st_size > 10_000


def test_a_failed_reduction_is_left_out():
    model = plan.Model(500)
    chart = {"rows": [{"method": "guyan", "order": 0.0, "failed": "why"}]}
    assert records.succeeded({"charts": {model: chart}}, model) == []
