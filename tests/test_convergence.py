"""The convergence study: its imperfect foils, fits, records, tables and figures."""

import csv
from collections import defaultdict
from xml.etree import ElementTree

import numpy as np
import pytest
from side_study import write_results

from foilstudy.base.files import read_json, write_json
from foilstudy.base.tables import csv_text
from foilstudy.model.mesh_size import element_size_for, expected_energy_error
from foilstudy.plot.save import save
from foilstudy.study.convergence import crumpling, plan, stops, tables
from foilstudy.study.convergence.analysis import fit, means, slope
from foilstudy.study.convergence.plan import STUDY
from foilstudy.study.convergence.records import ensemble as read_ensemble
from foilstudy.study.kernel.files import read_records
from foilstudy.study.published import THICKNESSES_UM, CrumpleCase

COARSE = CrumpleCase("corner", 500, 150, 12.0, 0)
SIZES = np.array(plan.SIZES_MM)


# --- plan ----------------------------------------------------------------------------------------


def test_every_mesh_resolves_the_imperfection_and_begins_with_the_same_foil():
    """The areas of the imperfect foils differ by the error of their fit alone."""
    areas = []
    for size in (7.0, 5.0, 2.5):
        crumple = crumpling.imperfect(CrumpleCase("corner", 500, 170, size, 3))
        areas.append(crumple.stressed.section.areas.sum())
    assert np.ptp(areas) < 1e-5 * areas[0]


# --- analysis ------------------------------------------------------------------------------------


def ensemble(limit=3.5, coefficient=0.05, order=1.7, scatter=0.0, seeds=3):
    rng = np.random.default_rng(0)
    values = limit + coefficient * SIZES**order
    return {s: v * (1 + scatter * rng.standard_normal(seeds)) for s, v in zip(SIZES, values)}


def test_fit_finds_limit_and_order_of_exact_data():
    data = {s: v * np.array([0.99, 1.01]) for s, v in ensemble(seeds=1).items()}
    found = fit(data)
    assert found.limit == pytest.approx(3.5, rel=1e-3)
    assert found.order == pytest.approx(1.7, abs=0.01)
    np.testing.assert_allclose(found(SIZES), [v.mean() for v in data.values()], rtol=1e-4)


def test_stated_uncertainty_of_the_limit_covers_the_truth():
    found = fit(ensemble(scatter=0.05))
    assert 0.0 < found.limit_error < 0.5
    assert abs(found.limit - 3.5) < 3 * found.limit_error


def test_standard_error_falls_with_the_number_of_seeds():
    values = np.array([0.9, 1.0, 1.1])
    _, mean, error = means({1.0: values, 2.0: np.tile(values, 4)})
    np.testing.assert_allclose(mean, 1.0)
    assert error[0] == pytest.approx(2 * error[1])


def test_fit_refuses_what_it_cannot_answer():
    with pytest.raises(ValueError, match="two seeds on one mesh"):
        means({1.0: np.ones(1), 2.0: np.ones(1)})
    with pytest.raises(ValueError, match="cannot be fitted to 2 element sizes"):
        fit({1.0: np.array([1.0, 1.1]), 2.0: np.array([2.0, 2.1])})


def test_slope_is_the_exponent():
    exponent, error = slope(SIZES, 3.0 * SIZES**-2.1)
    assert exponent == pytest.approx(-2.1)
    assert error < 1e-10


# --- element size of a stated error --------------------------------------------------------------


@pytest.mark.parametrize("thickness", [50e-6, 130e-6, 500e-6])
@pytest.mark.parametrize("error", [0.05, 0.1])
def test_chosen_size_is_the_largest_that_keeps_the_error(thickness, error):
    size = element_size_for(error, 0.1, thickness)
    assert expected_energy_error(size, 0.1, thickness) <= error
    assert expected_energy_error(1.01 * size, 0.1, thickness) > error


def test_foils_of_one_shape_have_meshes_of_one_shape():
    """Radius and thickness twice as large: the same cylinder on another scale."""
    one, two = element_size_for(0.05, 0.1, 1e-4), element_size_for(0.05, 0.2, 2e-4)
    assert two == pytest.approx(2 * one, rel=0.01)


def test_no_size_is_chosen_beyond_what_was_measured():
    assert element_size_for(1.0, 0.1, 1e-3) == pytest.approx(np.sqrt(0.1 * 1e-3), rel=0.01)


def test_crumples_of_the_study_obey_the_expected_error():
    """500 um, 0.17 m, default element: energies of the seeds (J) from docs/convergence.md."""
    energies = {
        7.032e-3: (5.78, 4.61, 5.01),
        4.993e-3: (4.20, 4.32, 4.13),
        3.987e-3: (3.81, 4.07, 3.86),
        2.497e-3: (3.72, 3.70),
    }
    sizes, mean, error = means({size: np.array(values) for size, values in energies.items()})
    shape = 1 + np.array([expected_energy_error(size, 0.1, 500e-6) for size in sizes])
    limit = (mean * shape / error**2).sum() / (shape**2 / error**2).sum()
    assert (np.abs(mean - limit * shape) < 1.5 * error).all()


# --- runs ----------------------------------------------------------------------------------------


def test_a_coarse_crumple_has_all_its_numbers(monkeypatch, tmp_path):
    monkeypatch.setattr(crumpling, "_REFINEMENTS_MAX", 1)
    monkeypatch.setattr(crumpling, "_CORRELATION", 20e-3)
    record = crumpling.run(COARSE)
    assert (record["status"], record["negative_eigenvalues"]) == ("converged", 0)
    assert record["residual"] <= 1e-8
    parts = ("membrane_energy", "bending_energy", "stabilisation_energy")
    assert sum(record[part] for part in parts) == pytest.approx(record["strain_energy"])
    assert min(record["static_stiffness"]) > 0
    assert np.isfinite(record["static_limit"]).all()
    write_json(record, tmp_path / "record.json")
    again = read_json(tmp_path / "record.json")
    np.testing.assert_array_equal(again["static_stiffness"], record["static_stiffness"])


def test_a_stopped_crumple_comes_to_rest(monkeypatch):
    monkeypatch.setattr(crumpling, "_CORRELATION", 20e-3)
    monkeypatch.setattr(stops, "STOPS", (1e-1, 1e-3, 1e-5, 1e-6))
    records = stops.run_stops(COARSE)
    stiffness = np.array([record["static_stiffness"] for record in records])
    change = np.abs(stiffness[:-1] / stiffness[-1] - 1).max(axis=1)
    assert change[0] > change[-1]
    assert change[-1] < 1e-3
    assert records[-1]["negative_eigenvalues"] == 0


# --- tables and figures --------------------------------------------------------------------------


def fake_record(case, size=None):
    size = size or case.size_mm
    energy = 3.0 + 0.05 * size**2 + 0.1 * case.seed
    stiffness = [1e3 * (1 + 0.02 * size), 2e3 * (1 + 0.02 * size)]
    return {
        "status": "converged", "message": "", "size_mm": size, "elements": 100,
        "strain_energy": energy, "membrane_energy": 0.2 * energy, "bending_energy": 0.79 * energy,
        "stabilisation_energy": 0.01 * energy, "static_stiffness": stiffness,
        "static_limit": [None, None] if size < 2 else stiffness,
        "static_limit_error": [None, None] if size < 2 else [1.0, 1.0],
        "prestressed_stiffness": [0.5 * v for v in stiffness], "residual": 1e-9,
        "negative_eigenvalues": 0, "ramp_steps": 2000, "steps": 4000, "hessians": 1,
        "cpu_seconds_relaxing": 10.0, "cpu_seconds_settling": 1.0, "cpu_seconds_static": 1.0,
        "peak_memory_mb": 300.0,
    }  # fmt: skip


def fake_stop(residual):
    stiffness = [1e3 * (1 + residual), 2e3 * (1 - residual)]
    return {
        "residual": residual, "strain_energy": 1.0, "negative_eigenvalues": 0,
        "static_stiffness": stiffness, "prestressed_stiffness": stiffness,
    }  # fmt: skip


@pytest.fixture(scope="module")
def synthetic_study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("convergence")
    results = defaultdict(dict)

    def write(part, case, result):
        results[part][case] = result

    for case in plan.crumples():
        write("crumples", case, fake_record(case))
    for case in plan.MULTILEVEL:
        levels = [fake_record(case, size) | {"level": k} for k, size in enumerate((5, 2.5, 1.25))]
        write("levels", case, levels)
    for case in plan.STOPPED:
        write("stops", case, [fake_stop(residual) for residual in plan.STOPS])
    timing = [
        {"thickness_um": t, "size_mm": s, "elements": 1, "seconds_per_step": 1e-2 * s**-2.1}
        for t in THICKNESSES_UM
        for s in plan.SIZES_MM
    ]
    write("timing", "steps", timing)
    return STUDY.findings(read_records(STUDY, write_results(STUDY, results, folder)))


def test_tables_hold_every_run(synthetic_study):
    text = csv_text(tables.crumples(synthetic_study))
    rows = list(csv.DictReader(text.splitlines()))
    assert len(rows) == len(plan.crumples()) + 3 * len(plan.MULTILEVEL)
    fine = [row for row in rows if row["asked_size_mm"] == "1.25"]
    assert fine and all(row["static_limit_axial"] == "" for row in fine)
    assert len(tables.stops(synthetic_study)) == len(plan.STOPPED) * len(plan.STOPS)


def test_text_states_limits_and_exponents(synthetic_study):
    text = tables.page(synthetic_study)
    assert "exponent -2.10 +- 0.00" in text
    assert "order 2.0" in text
    assert "nan" not in text


@pytest.mark.parametrize("name", STUDY.figures)
def test_figures_are_drawn_whole(synthetic_study, tmp_path, name):
    save(STUDY.figures[name](synthetic_study), tmp_path / name)
    assert (tmp_path / f"{name}.png").read_bytes()[:4] == b"\x89PNG"
    ElementTree.parse(tmp_path / f"{name}.svg")


def test_a_realisation_that_did_not_converge_is_left_out_of_means(synthetic_study):
    case = plan.crumples()[0]
    records = dict(synthetic_study["crumples"])
    records[case] = records[case] | {"status": "not_converged"}
    key = ("strain_energy", case.thickness_um)
    assert len(read_ensemble({"crumples": records}, *key)[case.size_mm]) == 2
    assert len(read_ensemble(synthetic_study, *key)[case.size_mm]) == 3
