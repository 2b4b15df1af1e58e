"""Records of benchmarks: what they demand, and that tables and pages say what was computed."""

from dataclasses import asdict

import numpy as np
import pytest
from runs import ROOT, snakemake
from test_workflow import TINY

from foilstudy.base.costs import Cost
from foilstudy.base.files import read_json
from foilstudy.study.kernel.files import read_record, write_record
from foilstudy.study.kernel.plan import Record, case_name
from foilstudy.study.verification.candidates import CANDIDATES
from foilstudy.study.verification.figures import draw
from foilstudy.study.verification.plan import BENCHMARKS, ELEMENT_NAMES, STUDY
from foilstudy.study.verification.records import Benchmark, Checked, Curve, Picture, Plot
from foilstudy.study.verification.summary import benchmarks_of, page, problems, rows, table

MESHES = (10, 20, 30)


def quantity(values, **changes):
    known = {"reference": 3.0, "exact": True, **changes}
    return Checked("height", "m", known.pop("reference"), "theory", "side", MESHES, values, **known)


def converging(power, factor=0.5, limit=3.0):
    return tuple(limit + factor * np.array(MESHES, float) ** -power)


@pytest.mark.parametrize("power", [1.0, 2.0, 3.5])
@pytest.mark.parametrize("exact", [True, False])
def test_order_is_found_with_and_without_the_exact_value(power, exact):
    found = quantity(converging(power), exact=exact).rate
    assert found == pytest.approx(power, rel=1e-6)


def test_values_that_converge_as_they_should_raise_no_problem():
    assert quantity(converging(2.0)).problems() == ()


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (converging(2.0, limit=3.1), "3.35 % off"),
        (converging(1.0, factor=0.2), "order 1.00, theory says 2"),
        ((3.002, 2.999, 3.0003), "one side"),
    ],
)
def test_every_demand_that_is_missed_has_its_sentence(values, sentence):
    assert any(sentence in problem for problem in quantity(values).problems())


def test_a_family_is_judged_by_its_common_error():
    """One error passes through zero and shows no order of its own."""
    crossing = tuple(3.0 + np.array([-2.0, 0.1, 1.0]) * 1e-3)
    steady = converging(2.0, factor=2.0)
    family = tuple(quantity(values, family="spectrum") for values in (crossing, steady))
    assert quantity(crossing).problems() != ()
    benchmark = Benchmark("name", "Title", "corner", family)
    assert benchmark.problems() == ()
    assert benchmark.rate(family[0]) == benchmark.rate(family[1]) > 1.7


def test_a_quantity_needs_one_value_per_mesh():
    with pytest.raises(ValueError, match="3 meshes and 2 values"):
        quantity((1.0, 2.0))


def test_records_are_read_as_they_were_written(tmp_path):
    grid = np.linspace(0.0, 1.0, 12).reshape(3, 2, 2)
    picture = Picture.of("shape", grid, grid[0])
    plot = Plot("u", "F", (Curve("tip", (0.0, 1.0), (0.0, 2.0), (1.0,), (2.1,)),))
    benchmark = Benchmark("name", "Title", "corner", (quantity(converging(2.0)),), plot, (picture,))
    case = STUDY.part("benchmarks").cases[0]
    path = tmp_path / STUDY.part("benchmarks").files(case_name(case))[0]
    write_record(STUDY, Record("benchmarks", case, asdict(benchmark), Cost()), path)
    (read,) = benchmarks_of({"benchmarks": {case: read_record(STUDY, path)}})
    np.testing.assert_equal(asdict(read), read_json(path)["result"])
    assert page([read]) == page([benchmark]) and rows([read]) == rows([benchmark])


def test_large_pictures_are_thinned_but_keep_their_corners():
    points = np.random.default_rng(0).standard_normal((3, 500, 30))
    picture = Picture.of("shape", points, points[0])
    kept = np.array(picture.points)
    assert kept.shape[1] < 200 and kept.shape[2] == 30
    np.testing.assert_allclose(kept[:, [0, -1]], points[:, [0, -1]], atol=2e-3)


def test_every_nonlinear_benchmark_is_there_under_its_name():
    bound = {name: getattr(lazy.load(), "__self__", None) for name, lazy in BENCHMARKS.items()}
    names = {name: case.name for name, case in bound.items() if case is not None}
    assert len(names) == 5 and all(name == key for key, name in names.items())


def test_every_element_under_test_is_there_under_its_name():
    assert tuple(CANDIDATES) == ELEMENT_NAMES
    assert all(candidate.name == name for name, candidate in CANDIDATES.items())


def test_a_benchmark_that_misses_a_demand_is_told():
    good = Benchmark("good", "Good", "corner", (quantity(converging(2.0)),))
    bad = Benchmark("bad", "Bad", "corner", (quantity(converging(2.0, limit=3.1)),))
    assert problems([good]) == []
    found = problems([good, bad])
    assert found and all(problem.startswith("bad, corner: height: ") for problem in found)
    assert page([good, bad]).endswith("".join(f"- {problem}\n" for problem in found))
    assert [row["met"] for row in rows([good, bad])] == [True, False]


def test_workflow_plans_one_job_per_benchmark_and_element(tmp_path):
    run = snakemake(tmp_path, TINY, "-n", "verify")
    assert run.returncode == 0, run.stderr
    assert (
        f"{len(ELEMENT_NAMES) * len(BENCHMARKS)} verify_benchmarks, 1 verify_present" in run.stdout
    )


def both_elements():
    """One benchmark of one family of values, as two elements see it."""
    coarse, fine = quantity(converging(1.0), expected_rate=1.0), quantity(converging(2.0))
    return [
        Benchmark("name", "Title", element, (q, q))
        for element, q in (("corner", coarse), ("one_point", fine))
    ]


def test_table_has_a_row_for_every_quantity_with_the_elements_side_by_side():
    rows = table(both_elements()).splitlines()
    assert "corner: mesh | error | order | one point: mesh | error | order" in rows[0]
    row = "height | 3 m | theory | 30 | +0.56 % | 1.0 (1) | 30 | +0.019 % | 2.0 (2) |"
    assert len(rows) == 4 and all(line.endswith(row) for line in rows[2:])


def test_figure_draws_the_convergence_of_every_element_on_equal_axes():
    axes = draw(both_elements()).subfigs[0].axes
    assert [ax.get_title() for ax in axes] == ["element corner", "element one point"]
    assert axes[0].get_ylim() == axes[1].get_ylim()


def test_page_shows_the_table_and_the_figures_of_the_last_run():
    results = ROOT / "results/verification"
    page = (ROOT / "docs/verification.md").read_text(encoding="utf-8")
    assert (results / "verification.md").read_text(encoding="utf-8") in page
    for name in BENCHMARKS:
        assert f"../results/verification/figures/{name}.png" in page
        assert (results / f"figures/{name}.png").is_file()
