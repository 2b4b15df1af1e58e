"""The comparison of elements: what it measures, and that its table and chart come of it."""

import csv
from collections import defaultdict

import numpy as np
import pytest
from side_study import write_results

from foilstudy.base.tables import csv_text
from foilstudy.model.patch import cylinder_control_points
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.pipeline.method import Mesh
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import stress_free_stiffness
from foilstudy.study.elements import plan, summary
from foilstudy.study.elements.bending import ring_error
from foilstudy.study.elements.chart import draw
from foilstudy.study.elements.frozen import frozen_errors
from foilstudy.study.elements.plan import BASELINE, COARSE_MM, DEFAULT, FROZEN, STUDY
from foilstudy.study.elements.summary import variant_row
from foilstudy.study.elements.variants import VARIANTS
from foilstudy.study.kernel.files import read_records
from foilstudy.study.published import foil


def test_the_default_and_the_baseline_are_those_of_the_package():
    assert VARIANTS[DEFAULT].element == Corner()
    assert VARIANTS[BASELINE].element == OnePoint()


@pytest.mark.parametrize("name", [DEFAULT, "corner_1_bend_4", "cas_1", "staggered_1"])
def test_elements_without_locking_bend_a_coarse_ring_within_a_tenth(name):
    """The orders of the modes are right, too: another mode would be several times off."""
    assert ring_error(VARIANTS[name], 0.1) < 0.1


def test_full_quadrature_locks_in_a_thin_ring_as_the_inverse_square_of_its_thickness():
    """Membrane energy that bending cannot avoid, over bending energy: (h/t)^2."""
    errors = [ring_error(VARIANTS["gauss_3"], slenderness) for slenderness in (0.02, 0.01)]
    assert np.log2(errors[1] / errors[0]) == pytest.approx(2.0, abs=0.05)


def test_the_default_does_not_lock_in_a_thin_ring():
    errors = [ring_error(VARIANTS[DEFAULT], slenderness) for slenderness in (0.02, 0.01)]
    assert errors[1] == pytest.approx(errors[0], rel=0.1)


def test_errors_of_a_frozen_shape_are_relative_to_the_mean_of_the_referees():
    sheet, case = foil(500), FROZEN[2]
    assert case.thickness_um == 500
    patch = Mesh(COARSE_MM * 1e-3).patch(sheet)
    points = cylinder_control_points(patch, sheet.diameter)
    variant = VARIANTS[DEFAULT]
    own = stress_free_stiffness(Shape(sheet, patch, points, points, variant.element))
    frozen = {"points": points, "referees": [list(own), list(3 * own)]}
    assert frozen_errors(variant, case, frozen) == pytest.approx((-0.5, -0.5), rel=1e-9)


@pytest.fixture
def study(tmp_path):
    """Made-up records of all variants, one of which found no answers."""
    results = defaultdict(dict)

    def write(part, case, result):
        results[part][case] = result

    for k, name in enumerate(VARIANTS):
        error = np.nan if k == 0 else 0.01 * k
        errors = {
            "ring": {f"{s:g}": error for s in (0.01, 0.02, 0.05, 0.1, 0.2)},
            "roll_up": error,
            "frozen": {str(case.thickness_um): (error, -error) for case in FROZEN},
            "buckled": 2.0 + error,
        }
        write("variants", name, errors)
        energies = (np.nan, np.nan) if k == 0 else (4.0, np.nan)
        write("crumples", name, {"energies": energies, "steps": (3000, 7000)})
    write("buckled", DEFAULT, {"energies": [3.0, 2.0]})
    for case in plan.FINE:
        write("fine", case, {"energies": (3.2,), "steps": (9000,)})
    for case in FROZEN:
        write("frozen", case, {"points": np.zeros((3, 2, 2))})
    costs = {"relative": dict.fromkeys(VARIANTS, 1.5), "nanoseconds": {DEFAULT: 60.0}}
    write("cost", BASELINE, costs)
    return STUDY.findings(read_records(STUDY, write_results(STUDY, results, tmp_path)))


def test_numbers_of_a_variant_come_through(study):
    row = variant_row(study, "gauss_2")
    assert row["ring_0.1"] == 0.04
    assert (row["axial_500um"], row["radial_500um"]) == (0.04, -0.04)
    assert row["buckled"] == pytest.approx(0.02)
    assert row["crumple_energy"] == 4.0  # of the crumple that came to rest
    assert row["crumples_settled"] == 0.5
    assert row["crumple_error"] == pytest.approx(0.25)


def test_what_found_no_answer_is_empty_in_the_tables_and_missing_in_the_chart(study):
    rows = list(csv.DictReader(csv_text(summary.rows(study)).splitlines()))
    assert [row["variant"] for row in rows] == list(VARIANTS)
    assert rows[0]["roll_up"] == "" and rows[4]["roll_up"] == "0.04"
    lines = summary.page(study).splitlines()
    assert lines[2].startswith("| one point, χ = 0.01 | 1.50 | - | - |")
    figure = draw(study)
    assert len(figure.axes) == 6
