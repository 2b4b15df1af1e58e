"""The statistics recover known truths and agree with independent formulas."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from scipy import stats
from synthetic import COARSE, EXPONENT, FAILED, LAW, PET, SyntheticCase, make_cube

from foilstudy.base.reference import PowerLaw, published
from foilstudy.config import load_config
from foilstudy.present.comparison import comparable, comparison_sentence
from foilstudy.present.statistics.cells import samples
from foilstudy.present.statistics.eigenfrequency import eigenfrequency_table
from foilstudy.present.statistics.powerlaw import (
    AS_IT_STANDS,
    LIMIT,
    SIMULATED,
    TRUSTED,
    answering_source,
    fit_power_law,
    powerlaw_table,
    simulated_law,
    sources_in,
)
from foilstudy.present.statistics.regression import fit_linear
from foilstudy.present.statistics.summary import stiffness_summary
from foilstudy.present.statistics.tables import TABLES, write_tables
from foilstudy.present.statistics.trust import assess_trust
from foilstudy.present.statistics.variability import (
    coefficient_of_variation,
    coefficient_of_variation_interval,
    variability_law_table,
    variability_table,
)

CONFIG = Path(__file__).parents[1] / "config"
KEYS = {"alpha": "constant", "beta": "overlength", "gamma": "thickness"}


def noisy_cube(**kwargs):
    return make_cube(cv=lambda overlength, direction: 0.1 + 1e-3 * overlength, **kwargs)


@pytest.mark.parametrize("direction", ["axial", "radial"])
def test_power_law_of_exact_data_is_recovered(direction):
    fitted = simulated_law(make_cube(), direction)
    law = fitted.law
    np.testing.assert_allclose((law.alpha, law.beta, law.gamma), LAW[direction], rtol=1e-10)
    assert fitted.fit.n == 120
    assert fitted.fit.r2 == pytest.approx(1)
    alpha, beta, gamma = LAW[direction]
    assert law.stiffness(30.0, 250.0) == pytest.approx(np.exp(alpha) * 30**beta * 250**gamma)


def test_power_law_matches_the_normal_equations():
    data = samples(noisy_cube(), "static_stiffness", direction="axial")
    law = fit_power_law(data)
    X = np.column_stack(
        [np.ones(data.value.size), np.log(data.overlength_percent), np.log(data.thickness_um)]
    )
    y = np.log(data.value)
    inverse = np.linalg.inv(X.T @ X)
    coefficients = inverse @ X.T @ y
    residuals = y - X @ coefficients
    variance = residuals @ residuals / (y.size - 3)
    error = np.sqrt(variance * np.diag(inverse))
    half = stats.t.ppf(0.975, y.size - 3) * error
    np.testing.assert_allclose([law.fit.value[k] for k in KEYS.values()], coefficients, rtol=1e-9)
    for i, key in enumerate(KEYS.values()):
        assert law.fit.std_error[key] == pytest.approx(error[i], rel=1e-9)
        assert law.fit.low[key] == pytest.approx(coefficients[i] - half[i], rel=1e-9)
        assert law.fit.high[key] == pytest.approx(coefficients[i] + half[i], rel=1e-9)
    assert law.fit.residual_std == pytest.approx(np.sqrt(variance))
    assert law.fit.r2 == pytest.approx(1 - residuals @ residuals / np.sum((y - y.mean()) ** 2))


def test_residual_checks_tell_uneven_and_skewed_scatter_from_plain_scatter():
    x = np.linspace(0, 1, 200)
    noise = np.random.default_rng(0).standard_normal(x.size)
    plain = fit_linear(2 * x + noise, {"x": x})
    assert plain.heteroscedasticity_p() > 0.05 and plain.normality_p() > 0.05
    uneven = fit_linear(2 * x + x * noise, {"x": x})
    assert uneven.heteroscedasticity_p() < 1e-6
    skewed = fit_linear(2 * x + np.exp(noise), {"x": x})
    assert skewed.normality_p() < 1e-6


def test_lack_of_fit_tells_a_bent_law_from_a_straight_one():
    straight = simulated_law(noisy_cube(), "axial")
    assert straight.fit.lack_of_fit_p(straight.configuration) > 0.05
    cube = noisy_cube()
    bend = np.exp(0.2 * np.log(cube["overlength"] / 30) ** 2)
    bent = simulated_law(cube.assign(static_stiffness=cube["static_stiffness"] * bend), "axial")
    assert bent.fit.lack_of_fit_p(bent.configuration) < 1e-6


def test_interval_covers_the_truth_at_its_nominal_rate():
    rng = np.random.default_rng(3)
    x = np.linspace(0, 1, 12)
    covered = 0
    for _ in range(400):
        fit = fit_linear(1 + 2 * x + rng.standard_normal(12), {"x": x})
        covered += fit.low["x"] < 2 < fit.high["x"]
    assert 0.91 < covered / 400 < 0.985


def test_prediction_band_matches_the_textbook_formula():
    rng = np.random.default_rng(5)
    x = rng.uniform(0, 10, 20)
    y = 3 - 0.5 * x + 0.2 * rng.standard_normal(20)
    fit = fit_linear(y, {"x": x})
    at = np.array([0.0, 4.0, 12.0])
    mean, low, high = fit.predict({"x": at})
    s = np.sqrt(np.sum(fit.residuals**2) / 18)
    half = (
        stats.t.ppf(0.975, 18)
        * s
        * np.sqrt(1 / 20 + (at - x.mean()) ** 2 / np.sum((x - x.mean()) ** 2))
    )
    np.testing.assert_allclose(high - mean, half)
    np.testing.assert_allclose(mean - low, half)


def test_failed_cells_do_not_enter_and_not_converged_ones_do():
    cube = make_cube(
        verdicts={
            (0, 0, 2): FAILED,
            (3, 4, 0): FAILED,
            (1, 1, 1): ("not_converged", "steps used up"),
        }
    )
    law = simulated_law(cube, "axial")
    assert law.fit.n == 118
    assert law.law.beta == pytest.approx(LAW["axial"][1])


def test_values_that_have_no_logarithm_do_not_enter():
    cube = make_cube()
    cube["static_stiffness"][0, 0, 0, 0] = -5.0
    cube["static_stiffness"][1, 1, 1, 0] = np.inf
    assert simulated_law(cube, "axial").fit.n == 118


@pytest.mark.parametrize(
    ("kwargs", "lost", "note"),
    [
        ({"thickness_um": (500.0,)}, "gamma", "thickness takes one value only"),
        ({"reference_height_mm": (170.0,)}, "beta", "overlength takes one value only"),
    ],
)
def test_degenerate_sweep_drops_its_regressor(kwargs, lost, note):
    row = powerlaw_table(noisy_cube(**kwargs)).set_index("source").loc["simulation"].iloc[0]
    assert np.isnan(row[lost])
    assert note in row["note"]
    kept = "beta" if lost == "gamma" else "gamma"
    assert row[f"{kept}_low"] < LAW["axial"][1 if kept == "beta" else 2] < row[f"{kept}_high"]


def test_single_realisation_and_no_realisation_give_nan_and_a_note():
    one = make_cube(thickness_um=(500.0,), reference_height_mm=(170.0,), seeds=1)
    none = make_cube(
        thickness_um=(500.0,), reference_height_mm=(170.0,), seeds=1, verdicts={(0, 0, 0): FAILED}
    )
    row = powerlaw_table(one).iloc[0]
    assert np.isnan(row["alpha_se"]) and "no degree of freedom" in row["note"]
    row = powerlaw_table(none).iloc[0]
    assert np.isnan(row["alpha"]) and row["n"] == 0 and "no usable realisation" in row["note"]


def test_published_laws_reproduce_the_quoted_stiffness():
    # The stiffness the publication's fits give at 500 um, 30.8 %, axial and radial.
    laws = published().power_laws
    overlength = 100 * 40 / 130
    assert laws["axial"]["simulation"].law.stiffness(overlength, 500) == pytest.approx(
        10807, rel=1e-4
    )
    assert laws["axial"]["experiment"].law.stiffness(overlength, 500) == pytest.approx(
        4340, rel=1e-3
    )
    assert laws["radial"]["simulation"].law.stiffness(overlength, 500) == pytest.approx(
        28084, rel=1e-4
    )


def test_powerlaw_table_has_every_direction_and_source():
    table = powerlaw_table(noisy_cube(relaxed_again=True))
    published_sources = {"published simulation", "published experiment"}
    assert set(table["source"]) == (set(SIMULATED) - {AS_IT_STANDS}) | published_sources
    assert len(table) == 2 * 6
    row = table.set_index(["direction", "source"]).loc[("radial", "published experiment")]
    assert (row["beta"], row["beta_se"]) == (-0.55, 0.04)
    simulated = table[table["source"] == "simulation"]
    assert (simulated["beta_se_clustered"] > 0).all()


def test_a_source_without_values_has_no_law():
    cube = noisy_cube()
    assert "simulation pre-stressed refined" not in sources_in(cube)
    unmeasured = cube["static_stiffness_converged"] * np.nan
    old = cube.assign(static_stiffness_converged=unmeasured).drop_vars("prestressed_stiffness")
    assert sources_in(old) == ["simulation"]
    assert set(variability_table(old)["quantity"]) == {"static_stiffness"}


@pytest.mark.parametrize(
    ("source", "shift"), [("simulation mesh limit", 0.3), ("simulation pre-stressed", -0.2)]
)
def test_thickness_exponents_of_mesh_limit_and_pre_stress_are_recovered(source, shift):
    law = simulated_law(make_cube(), "radial", source).law
    assert law.gamma == pytest.approx(LAW["radial"][2] + shift)
    assert law.beta == pytest.approx(LAW["radial"][1])


def test_negative_pre_stressed_values_are_counted_and_leave_the_law_alone():
    cube = make_cube(verdicts={(0, 0, 0): FAILED})
    cube["prestressed_stiffness"][3, 4, :2, 0] = [-7.0, 0.0]
    table = powerlaw_table(cube).set_index(["direction", "source"])
    row = table.loc[("axial", "simulation pre-stressed")]
    assert row["note"] == "2 of 119 values are not positive and do not enter"
    assert (row["n"], row["beta"]) == (117, pytest.approx(LAW["axial"][1]))
    assert table.loc[("radial", "simulation pre-stressed"), "note"] == ""
    assert table.loc[("axial", "simulation"), "n"] == 119


def test_scatter_of_pre_stressed_values_counts_those_below_zero():
    cube = make_cube(thickness_um=(500.0,), reference_height_mm=(170.0, 250.0), seeds=3)
    cube["prestressed_stiffness"][0, :, :, 0] = [[-1.0, 2.0, 5.0], [-4.0, -1.0, 2.0]]
    table = variability_table(cube)
    rows = table[(table["quantity"] == "prestressed_stiffness") & (table["direction"] == "axial")]
    assert list(rows["n_not_positive"]) == [1, 2]
    assert rows["cv"].iloc[0] == pytest.approx(1.5)
    # A spread over a negative mean measures nothing.
    assert np.isnan(rows["cv"].iloc[1])


def test_regression_of_the_scatter_is_that_of_the_stress_free_stiffness():
    cube = noisy_cube()
    wild = cube.assign(prestressed_stiffness=cube["prestressed_stiffness"] ** 3)
    pd.testing.assert_frame_equal(variability_law_table(wild), variability_law_table(cube))


def test_coefficient_of_variation_is_exact_where_it_is_prescribed():
    table = variability_table(noisy_cube())
    assert len(table) == 3 * 2 * 20
    expected = 0.1 + 1e-3 * table["overlength_percent"]
    np.testing.assert_allclose(table["cv"], expected, rtol=1e-10)
    assert (table["cv_low"] < table["cv"]).all() and (table["cv"] < table["cv_high"]).all()


def test_coefficient_of_variation_interval_covers_the_truth_for_six_realisations():
    rng = np.random.default_rng(11)
    covered = 0
    for values in 1 + 0.15 * rng.standard_normal((1000, 6)):
        low, high = coefficient_of_variation_interval(coefficient_of_variation(values), 6)
        covered += low < 0.15 < high
    assert covered / 1000 == pytest.approx(0.95, abs=0.02)


def test_coefficient_of_variation_interval_without_a_bound_is_infinite():
    assert coefficient_of_variation_interval(0.9, 3)[1] == np.inf
    assert np.isnan(coefficient_of_variation_interval(np.nan, 1)).all()


def test_variability_law_recovers_its_slope():
    law = variability_law_table(noisy_cube())
    np.testing.assert_allclose(law["slope"], 1e-3, rtol=1e-8)
    np.testing.assert_allclose(law["constant"], 0.1, rtol=1e-8)
    assert (law["n"] == 20).all()


def test_variability_of_single_realisations_is_nan():
    cube = make_cube(seeds=1)
    assert variability_table(cube)["cv"].isna().all()
    assert variability_law_table(cube)["slope"].isna().all()


def test_eigenfrequency_exponent_is_recovered_beside_the_published_one():
    table = eigenfrequency_table(make_cube()).set_index("thickness_um")
    np.testing.assert_allclose(table["exponent"], EXPONENT, rtol=1e-9)
    assert table.loc[50.0, "published_exponent"] == -2.06
    assert table.loc[500.0, "published_exponent"] == -2.42
    assert np.isnan(table.loc[130.0, "published_exponent"])


def test_summary_compares_each_configuration_with_the_published_fits():
    cube = noisy_cube(verdicts={(3, 2, 5): FAILED, (3, 2, 1): ("not_converged", "steps used up")})
    table = stiffness_summary(cube)
    assert len(table) == 40
    row = table[
        (table["thickness_um"] == 500)
        & (table["reference_height_mm"] == 170)
        & (table["direction"] == "axial")
    ].iloc[0]
    values = cube["static_stiffness"].to_numpy()[3, 2, :5, 0]
    assert (row["n"], row["n_failed"], row["n_not_converged"]) == (5, 1, 1)
    assert row["mean"] == pytest.approx(values.mean())
    assert row["cv"] == pytest.approx(values.std(ddof=1) / values.mean())
    assert row["ratio_simulation"] == pytest.approx(values.mean() / 10807, rel=1e-4)
    assert (row["min"], row["max"]) == (values.min(), values.max())


# --- which stiffness is trusted ------------------------------------------------------------------


def test_everything_resolved_and_accurate_is_trusted():
    cube = make_cube()
    trust = assess_trust(cube)
    assert trust.trusted.all() and not trust.doubted.any()
    np.testing.assert_allclose(trust.mesh_error, 0.05)
    np.testing.assert_allclose(trust.slenderness.sel(thickness=50), 2 / np.sqrt(100 * 0.05))
    assert answering_source(cube, "axial") == LIMIT
    assert stiffness_summary(cube)["trusted"].all()


def test_a_crumple_is_resolved_up_to_the_end_of_the_fit():
    trust = assess_trust(make_cube(case=COARSE))
    # 5 mm over sqrt(R t) is 2.2, 1.4, 1.0 and 0.7
    assert list(trust.trusted.any(["overlength", "direction"]).values) == [False, False, True, True]
    assert (trust.unresolved == ~trust.trusted).all()


def test_a_stated_error_of_more_than_a_fifth_of_one_value_is_not_trusted():
    cube = noisy_cube()
    limit = cube["static_stiffness_converged"]
    cube["static_stiffness_mesh_error"][3, 4, 5, 0] = 0.201 * limit[3, 4, 5, 0]
    cube["static_stiffness_mesh_error"][3, 3, 5, 0] = 0.199 * limit[3, 3, 5, 0]
    trust = assess_trust(cube)
    assert int(trust.doubted.sum()) == 1 and trust.inaccurate[3, 4, 0]
    assert trust.trusted.sel(direction="radial").all()


def test_a_value_without_a_stated_error_is_not_trusted():
    cube = make_cube(verdicts={(0, 0, 0): FAILED})
    cube["static_stiffness_mesh_error"][1, 1, 1, 1] = np.nan
    trust = assess_trust(cube)
    assert int(trust.unstated.sum()) == 1 and trust.unstated[1, 1, 1]
    none = assess_trust(make_cube(case=SyntheticCase(refinements=0)))
    assert none.unstated.all() and not none.trusted.any()
    assert assess_trust(make_cube().assign_attrs(config="")).unresolved.all()


def test_a_cell_without_result_is_neither_trusted_nor_doubted():
    trust = assess_trust(make_cube(seeds=1, verdicts={(0, 0, 0): FAILED}))
    assert not trust.known[0, 0].any()
    assert not trust.trusted[0, 0].any() and not trust.doubted[0, 0].any()


def wrong_below_250_um(thickness_um):
    """The mesh limit is off by a factor that the law of the others does not follow."""
    return np.where(np.asarray(thickness_um) < 250, 3.0, 1.0)


def test_the_law_that_answers_is_of_the_trusted_configurations_alone():
    cube = make_cube(case=COARSE)
    wrong = (
        cube["static_stiffness_converged"]
        * wrong_below_250_um(cube["thickness"])[:, None, None, None]
    )
    cube = cube.assign(static_stiffness_converged=wrong)
    assert answering_source(cube, "axial") == TRUSTED
    table = powerlaw_table(cube).set_index(["direction", "source"])
    assert table.index.get_level_values("source")[0] == TRUSTED
    row = table.loc[("axial", TRUSTED)]
    assert row["n"] == 60 and row["gamma"] == pytest.approx(LAW["axial"][2] + 0.3)
    assert abs(table.loc[("axial", LIMIT), "gamma"] - row["gamma"]) > 0.3


def test_no_law_answers_where_nothing_is_trusted():
    cube = make_cube(case=SyntheticCase(mesh_error=lambda t, o: 2.1))
    assert answering_source(cube, "axial") is None
    assert TRUSTED not in set(powerlaw_table(cube)["source"])


# --- one meaning of an interval ------------------------------------------------------------------


def bent_cube():
    cube = noisy_cube()
    bend = np.exp(0.2 * np.log(cube["overlength"] / 30) ** 2)
    names = ("static_stiffness", "static_stiffness_converged")
    return cube.assign({name: cube[name] * bend for name in names})


def test_intervals_are_clustered_where_the_law_lacks_fit():
    table = powerlaw_table(bent_cube())
    row = table[table["source"] == "simulation"].iloc[0]
    assert row["interval"] == "clustered" and row["lack_of_fit_p"] < 0.05
    factor = stats.t.ppf(0.975, 19)  # of 20 configurations
    for name in KEYS:
        half = max(
            factor * row[f"{name}_se_clustered"], stats.t.ppf(0.975, 117) * row[f"{name}_se"]
        )
        assert row[f"{name}_high"] - row[name] == pytest.approx(half, rel=1e-9)
        assert row[name] - row[f"{name}_low"] == pytest.approx(half, rel=1e-9)
    straight = powerlaw_table(noisy_cube()).iloc[0]
    assert straight["interval"] == "independent"


def test_clustered_interval_covers_the_truth_where_independent_ones_do_not():
    """The configurations depart from the law by chance; seeds scatter little about each."""
    rng = np.random.default_rng(7)
    x = np.repeat(np.linspace(0, 1, 12), 5)
    cluster = np.repeat(np.arange(12), 5)
    covered = {"independent": 0, "clustered": 0}
    for _ in range(300):
        y = 2 * x + np.repeat(rng.standard_normal(12), 5) + 0.2 * rng.standard_normal(60)
        plain = fit_linear(y, {"x": x})
        fit = plain.allowing_for(cluster)
        assert fit.interval == "clustered"
        covered["independent"] += plain.low["x"] < 2 < plain.high["x"]
        covered["clustered"] += fit.low["x"] < 2 < fit.high["x"]
    assert covered["independent"] / 300 < 0.75
    assert covered["clustered"] / 300 > 0.88


def test_band_of_a_clustered_fit_agrees_with_its_interval():
    rng = np.random.default_rng(7)
    x, cluster = np.repeat(np.linspace(-1, 1, 8), 4), np.repeat(np.arange(8), 4)
    y = 2 * x + np.repeat(rng.standard_normal(8), 4) + 0.1 * rng.standard_normal(32)
    fit = fit_linear(y, {"x": x}).allowing_for(cluster)
    mean, low, high = fit.predict({"x": np.zeros(1)})
    assert (mean[0], low[0], high[0]) == pytest.approx(
        (fit.value["constant"], fit.low["constant"], fit.high["constant"])
    )


def test_eigenfrequency_interval_allows_for_heights_that_depart_from_the_law():
    cube = noisy_cube()
    bend = np.exp(0.5 * np.log(cube["reference_height"] / 180) ** 2 / 0.05)
    table = eigenfrequency_table(
        cube.assign(first_eigenfrequency=cube["first_eigenfrequency"] * bend)
    )
    assert (table["interval"] == "clustered").all()
    half = (table["exponent_high"] - table["exponent_low"]) / 2
    assert (half > 2.05 * table["exponent_se"]).all()


# --- what the published results hold for ---------------------------------------------------------


@pytest.mark.parametrize(
    ("case", "why"),
    [
        (SyntheticCase(diameter_mm=120, gap_height_mm=80), "diameter 120 mm instead of 200"),
        (SyntheticCase(diameter_mm=205), "diameter 205 mm instead of 200"),
        (SyntheticCase(gap_height_mm=127), "gap 127 mm instead of 130"),
        (SyntheticCase(material=PET), "E 4000 MPa instead of 650"),
    ],
)
def test_nothing_published_stands_beside_another_case(case, why):
    cube = make_cube(seeds=2, case=case)
    assert comparable(cube) is None
    assert why in comparison_sentence(cube)
    assert not powerlaw_table(cube)["source"].str.startswith("published").any()
    for table in (stiffness_summary(cube), eigenfrequency_table(cube)):
        assert not [name for name in table if "published" in name or "ratio" in name]


def test_nothing_published_stands_beside_a_sweep_beyond_its_own():
    thin = make_cube(thickness_um=(25.0, 500.0), seeds=1)
    assert "thickness 25 to 500 µm outside 50 to 500" in comparison_sentence(thin)
    tall = make_cube(reference_height_mm=(135.0, 300.0), seeds=1)
    assert "overlength 3.85 to 131 % outside 3.85 to 92.3" in comparison_sentence(tall)
    assert "does not tell foil and gap" in comparison_sentence(thin.assign_attrs(config=""))


def test_the_published_case_bears_what_a_handbook_leaves_open():
    near = SyntheticCase(
        diameter_mm=203, gap_height_mm=131, material=published_material().replace("650", "630")
    )
    # the heights make the same overlengths in the other gap
    cube = make_cube(reference_height_mm=(137.0, 170.0, 250.0), seeds=1, case=near)
    assert comparable(cube) is not None and comparison_sentence(cube) == ""


@pytest.mark.parametrize("accuracy", ["quick", "fine"])
@pytest.mark.parametrize(
    "imperfection",
    [
        {"kind": "gaussian", "amplitude_um": 10},
        {"kind": "smoothed", "amplitude_um": 100, "correlation_length_mm": 30},
        {"kind": "buckling_modes", "amplitude_um": 50},
    ],
)
def test_the_published_case_may_have_any_imperfection_mesh_and_part_of_the_sweep(
    imperfection, accuracy
):
    raw = yaml.safe_load((CONFIG / "resolved.yaml").read_text("utf-8"))
    study = load_config(raw | {"imperfection": imperfection, "accuracy": accuracy})
    for thickness, heights in ((130.0, 250.0, 500.0), (135.0, 250.0)), ((250.0,), (170.0,)):
        cube = make_cube(thickness, heights, seeds=2).assign_attrs(config=study.to_yaml())
        assert comparable(cube) is not None and comparison_sentence(cube) == ""
        assert powerlaw_table(cube)["source"].str.startswith("published").sum() == 4
        for table in (stiffness_summary(cube), eigenfrequency_table(cube)):
            assert [name for name in table if "published" in name]


def published_material():
    return SyntheticCase().material


def test_both_forms_of_the_law_give_the_same_stiffness():
    law = PowerLaw(-0.4, -1.07, 2.09)
    free = law.dimensionless(radius_mm=60.0, youngs_modulus_mpa=4000.0)
    assert free.gamma == pytest.approx(1.09)
    for overlength, thickness in ((15.0, 25.0), (60.0, 100.0)):
        share = free.stiffness(overlength / 100, thickness * 1e-6 / 0.06)
        stiffness = share * 4000e6 * thickness * 1e-6
        assert stiffness == pytest.approx(law.stiffness(overlength, thickness), rel=1e-12)


def test_write_tables_writes_readable_files_and_leaves_no_temporary(tmp_path):
    cube = noisy_cube()
    paths = write_tables(cube, tmp_path / "tables")
    assert {p.name for p in (tmp_path / "tables").iterdir()} == {f"{name}.csv" for name in TABLES}
    assert len(pd.read_csv(paths[0])) == 2 * 5
    first = [p.read_bytes() for p in paths]
    again = [p.read_bytes() for p in write_tables(cube, tmp_path / "tables")]
    assert first == again
