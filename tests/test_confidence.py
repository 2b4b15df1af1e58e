"""How well a study knows its means: the interval, and where it is shown."""

import html
import re
import shutil

import numpy as np
import pytest
from synthetic import FAILED, SyntheticCase, make_cube, ten_percent, write_cube, write_study

from foilstudy.base.confidence import MeanInterval
from foilstudy.base.outcome import NOT_NEEDED, STATUSES
from foilstudy.present.configuration import configuration
from foilstudy.present.files import StudyFiles
from foilstudy.present.report import write_report
from foilstudy.present.report.equilibrium import assess_equilibrium
from foilstudy.present.report.findings import health_sentence
from foilstudy.present.report.grid import wish_findings
from foilstudy.present.report.health import assess
from foilstudy.present.statistics.summary import stiffness_summary
from foilstudy.present.statistics.tables import write_tables

# --- the interval ---------------------------------------------------------------------------------


def lognormal(rng, cv, shape):
    """Values of mean 1 whose logarithms are normal."""
    sigma = np.sqrt(np.log1p(cv**2))
    return np.exp(rng.normal(-(sigma**2) / 2, sigma, shape))


def skewed(rng, cv, shape):
    """Values of mean 1 of a gamma distribution."""
    return rng.gamma(cv**-2, cv**2, shape)


def covered(samples):
    """Share of samples whose interval holds the mean of 1."""
    means = [MeanInterval.of(sample) for sample in samples]
    return np.mean([mean.low <= 1 <= mean.high for mean in means])


@pytest.mark.parametrize("draw", [lognormal, skewed])
@pytest.mark.parametrize("cv", [0.1, 0.3, 0.6])
@pytest.mark.parametrize("n", [6, 12, 24])
def test_the_interval_covers_the_mean_of_skewed_values(draw, cv, n):
    """As docs/method.md states: 93 to 95 %; of 4000 samples, within 0.8 % (two deviations)."""
    assert 0.922 < covered(draw(np.random.default_rng(n), cv, (4000, n))) < 0.962


def test_the_interval_is_that_of_the_mean_and_positive():
    values = np.array([5.0, 6.0, 7.0, 8.0, 20.0, 14.0])
    mean = MeanInterval.of([*values, np.nan, -1.0])
    assert mean.n == 6 and mean.mean == values.mean()
    factor = np.exp(2.5706 * values.std(ddof=1) / values.mean() / np.sqrt(6))  # t of 5 degrees
    np.testing.assert_allclose([mean.low, mean.high], [10 / factor, 10 * factor], rtol=1e-4)
    wide = MeanInterval.of([1.0, 100.0])
    assert 0 < wide.low < 50.5 < wide.high
    for few in ([], [3.0]):
        assert MeanInterval.of(few).half_width == np.inf
        assert MeanInterval.of(few).values_for(0.2) == np.inf


@pytest.mark.parametrize("half_width", [0.02, 0.2, 1.0])
def test_so_many_values_of_such_scatter_are_just_enough(half_width):
    values = lognormal(np.random.default_rng(0), 0.35, 10)
    n = MeanInterval.of(values).values_for(half_width)
    cv = values.std(ddof=1) / values.mean()

    def half_width_of(count):
        """Of so many values with the same coefficient of variation."""
        ends = np.resize([-1.0, 1.0], count) if count % 2 == 0 else np.linspace(-1, 1, count)
        ends = ends / ends.std(ddof=1)
        return MeanInterval.of(1 + cv * ends).half_width

    assert half_width_of(n) <= half_width
    assert n == 2 or half_width_of(n - 1) > half_width


# --- what is shown --------------------------------------------------------------------------------


NOT_THERE = (NOT_NEEDED, "")


def unequal(wish=20, cv=ten_percent, **options):
    """Four configurations of six realisations, of which the first took four."""
    verdicts = {(0, 0, 4): NOT_THERE, (0, 0, 5): NOT_THERE, (1, 1, 5): FAILED}
    cube = make_cube((50.0, 500.0), (135.0, 170.0), cv=cv, verdicts=verdicts, **options)
    cube.attrs["config"] = cube.attrs["config"].replace(
        "report: {", f"sweep: {{realisations: auto, realisations_max: 6}}\n"
        f"report: {{confidence_percent: {wish}, "
    )  # fmt: skip
    return cube


def test_counts_are_of_the_realisations_that_were_wanted():
    cube = unequal()
    health = assess(cube)
    assert health.total == 22 and health.counts["failed"] == 1
    assert set(health.counts) == set(STATUSES)
    assert [flagged.status for flagged in health.flagged] == ["failed"]
    assert health_sentence(health) == "21 of 22 realisations converged; 1 failed."
    settling = assess_equilibrium(cube, configuration(cube))
    assert (settling.cells, [row.cells for row in settling.thicknesses]) == (22, [10, 12])
    summary = stiffness_summary(cube)
    axial = summary[summary["direction"] == "axial"]
    assert axial["n"].tolist() == [4, 6, 6, 5]
    assert axial["n_failed"].tolist() == [0, 0, 0, 1]


def test_the_table_has_the_interval_of_the_mean_that_answers():
    cube = unequal()
    row = stiffness_summary(cube).iloc[0]
    values = cube["static_stiffness_converged"].values[0, 0, :4, 0]
    mean = MeanInterval.of(values)
    assert (row["best_low"], row["best_high"], row["best_n"]) == (mean.low, mean.high, 4)
    assert row["best_low"] < row["mesh_limit_mean"] < row["best_high"]
    assert (row["wished_half_width"], row["wish_takes"]) == (0.2, mean.values_for(0.2))
    plain = stiffness_summary(unequal(case=SyntheticCase(refinements=0))).iloc[0]
    assert plain["best_low"] < plain["mean"] < plain["best_high"]
    without = stiffness_summary(make_cube(seeds=3, cv=ten_percent))
    assert without["wish_takes"].isna().all() and without["best_low"].notna().all()
    assert wish_findings(without, None) == []


def test_the_page_says_whether_the_wish_was_met(tmp_path):
    page = page_of(unequal(), tmp_path / "met")
    assert "4 to 6 seeds" in page and "21 of 22 realisations converged" in page
    assert "in both directions of 4 of 4 configurations." in page
    assert "n = 4 to 6" in page
    cube = unequal(wish=5, cv=lambda overlength, direction: 0.3 if overlength > 10 else 0.01)
    page = page_of(cube, tmp_path / "missed")
    assert (
        "±5 % wide, as wished, in both directions of 2 of 4 configurations with at most 6" in page
    )
    takes = stiffness_summary(cube).set_index(["thickness_um", "overlength_percent"])
    assert re.search(
        r"Not: \d+ µm at 30.8 % \(n = [56], ±\d+ % \w+ly; the wish takes about \d+", page
    )
    assert takes["wish_takes"].max() > 100


def test_a_configuration_without_a_result_is_named():
    verdicts = {(0, 0, seed): FAILED for seed in range(6)}
    cube = make_cube((50.0, 500.0), (135.0, 170.0), cv=ten_percent, verdicts=verdicts)
    cube.attrs["config"] += "  confidence_percent: 20\n"
    cube.attrs["config"] = cube.attrs["config"].replace(
        "report: {title: Synthetic study}\n", "report:\n"
    )
    (text,) = wish_findings(stiffness_summary(cube), None)
    assert text.endswith("of 3 of 4 configurations. Not: 50 µm at 3.85 % (n = 0).")


def page_of(cube, folder):
    """Text of the page of a cube."""
    files = StudyFiles(write_cube(cube, folder / "cube.nc"))
    write_tables(files.cube, folder)
    text = write_report(files, folder / "report.html").read_text("utf-8")
    return html.unescape(re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", text)))


def test_records_of_the_wanted_realisations_are_enough_for_the_pictures(tmp_path):
    cube = unequal()
    write_study(cube, tmp_path)
    for seed in "45":
        shutil.rmtree(tmp_path / "realisations/t50um/h135mm" / seed)
    assert len(StudyFiles.found(tmp_path / "cube.nc").crumple_paths) == 22
