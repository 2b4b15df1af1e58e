"""Reductions beyond their band, the damping of stressed modes, and paths on a quarter."""

import numpy as np
import pytest
from conftest import FOIL
from scipy.sparse.linalg import spsolve

from foilstudy.base.costs import Cost
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.solve.continuation.pushed_sheet import PushedSheet
from foilstudy.study.kernel.plan import Record, case_name
from foilstudy.study.limits import bounds_tables, quarter, vibrations
from foilstudy.study.limits.bounds import STUDY, Quarter, Vibrating


def record(part, case, result):
    return Record(part, case, result, Cost())


def test_names_tell_cases_apart():
    for part in STUDY.parts:
        assert len({case_name(case) for case in part.cases}) == len(part.cases) > 0


def test_what_a_quarter_gives_are_derivatives_of_its_energy():
    one = quarter.quarter_of(FOIL, 18e-3, 10e-6, 0)
    rng = np.random.default_rng(3)
    q, motion = 1e-4 * rng.standard_normal((2, one.size))
    factor, step = 0.004, 1e-4
    tangent, rate = one.linearised(q, factor)
    along = (one.residual(q + step * motion, factor) - one.residual(q - step * motion, factor)) / (
        2 * step
    )
    np.testing.assert_allclose(tangent @ motion, along, atol=1e-5 * np.abs(along).max())
    step = 1e-7
    by_factor = (one.residual(q, factor + step) - one.residual(q, factor - step)) / (2 * step)
    np.testing.assert_allclose(rate, by_factor, atol=1e-5 * np.abs(by_factor).max())


def test_a_perfect_quarter_bears_a_quarter_of_the_force_of_its_cylinder():
    one = quarter.quarter_of(FOIL, 10e-3, 0.0, 0)
    start = uncrumpled(FOIL, Mesh(10e-3), Imperfection(amplitude=0.0))
    whole = PushedSheet(start.problem(), FOIL.shortening)
    forces = []
    for equations in (one, whole):
        q = np.zeros(equations.size)
        for _ in range(5):
            q -= spsolve(equations.linearised(q, 0.002)[0].tocsc(), equations.residual(q, 0.002))
        assert np.linalg.norm(equations.residual(q, 0.002)) < 1e-8 * equations.scale(q, 0.002)
        forces.append(equations.force(q, 0.002))
    assert 4 * forces[0] == pytest.approx(forces[1], rel=1e-3)


def test_a_path_on_a_quarter_tells_how_far_it_came():
    case = Quarter("arc_length", "cylinder", 500, 170, 18.0, 0, 10.0, 60)
    result = quarter.measure(case)
    assert result["status"] == "budget_spent" and result["factorisations"] == 60
    assert 0 < result["reached_within"] < result["reached"] < 0.05
    records = {"vibrations": {}, "quarters": {case: record("quarters", case, result)}}
    text = STUDY.tables["bounds.md"](STUDY.findings(records))
    assert "| 18 mm, 10 um | arc_length, cylinder | " in text and "| budget spent | 60 |" in text
    (row,) = bounds_tables.quarters(records)
    assert row["path"] == "arc_length" and row["reached"] == result["reached"]


def test_reduced_models_fail_beyond_their_band_and_say_how_far_they_reach():
    case = Vibrating(500, 170, 18.0, 0, 100.0)
    result = vibrations.measure(case)
    over = np.array(result["over_cutoff"])
    for name, found in result["reductions"].items():
        errors = np.array(found["errors"])
        valid = over * case.cutoff_hz <= found["valid_to_hz"]
        assert (errors[valid] <= vibrations.TOLERANCE).all(), name
        assert errors[-1] > 0.1, name  # four times the cut-off
        assert found["valid_to_hz"] < 2 * case.cutoff_hz, name
    # without stress a mode loses what its material does; compression takes off its stiffness alone
    assert min(result["loss"]) > 1.0
    assert result["stressed_eigenfrequencies"][0] < result["eigenfrequencies"][0]
    records = {"vibrations": {case: record("vibrations", case, result)}, "quarters": {}}
    text = STUDY.tables["bounds.md"](STUDY.findings(records))
    assert "| 500 um, 100 Hz | guyan | 12 |" in text
    assert len(bounds_tables.reductions(records)) == 4 * over.size
    assert len(bounds_tables.stressed_modes(records)) == vibrations.MODES
