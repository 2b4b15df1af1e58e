"""The comparison of elements: what it measures, and that its table and chart come of it."""

import csv

import numpy as np
import pytest

from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.study.elements import VARIANT_NAMES, records
from foilstudy.study.elements.bending import ring_error
from foilstudy.study.elements.chart import draw
from foilstudy.study.elements.crumpling import FINE_SIZES, Crumples
from foilstudy.study.elements.frozen import FrozenShape, frozen_errors, stiffness_of
from foilstudy.study.elements.scene import COARSE, DIAMETER, REFERENCE_HEIGHT
from foilstudy.study.elements.summary import FROZEN_UM, Study, write_csv, write_markdown
from foilstudy.study.elements.variants import BASELINE, DEFAULT, VARIANTS


def test_the_workflow_lists_every_variant():
    assert VARIANT_NAMES == tuple(VARIANTS)
    assert {DEFAULT, BASELINE} <= set(VARIANT_NAMES)
    assert VARIANTS[DEFAULT].element == Corner()


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
    patch = Patch.for_cylinder(DIAMETER, REFERENCE_HEIGHT, COARSE)
    points = cylinder_control_points(patch, DIAMETER)
    variant = VARIANTS[DEFAULT]
    own = stiffness_of(variant, patch, points, 500e-6)
    shape = FrozenShape(500e-6, points, np.array([own, 3 * own]))
    assert frozen_errors(variant, shape) == pytest.approx((-0.5, -0.5), rel=1e-9)


@pytest.fixture
def study(tmp_path):
    """Made-up records of all variants, one of which found no answers."""
    for k, name in enumerate(VARIANT_NAMES):
        error = np.nan if k == 0 else 0.01 * k
        errors = records.VariantErrors(
            {f"{s:g}": error for s in (0.01, 0.02, 0.05, 0.1, 0.2)},
            error,
            {t: (error, -error) for t in FROZEN_UM},
            2.0 + error,
        )
        records.write(errors, tmp_path / f"variants/{name}.json")
        energies = (np.nan, np.nan) if k == 0 else (4.0, np.nan)
        crumples = Crumples(5e-3, energies, (3000, 7000), ("converged", "not_converged"))
        records.write(crumples, tmp_path / f"crumples/{name}.json")
    (tmp_path / "buckled.json").write_text('{"energies": [3.0, 2.0]}')
    for size in FINE_SIZES:
        fine = Crumples(size, (3.2,), (9000,), ("converged",))
        records.write(fine, tmp_path / f"fine_{1e3 * size:g}mm.json")
    costs = {"relative": dict.fromkeys(VARIANT_NAMES, 1.5), "nanoseconds": {DEFAULT: 60.0}}
    (tmp_path / "cost.json").write_text(str(costs).replace("'", '"'))
    return Study.read(tmp_path)


def test_numbers_of_a_variant_come_through(study):
    row = study.row("gauss_2")
    assert row["ring_0.1"] == 0.04
    assert (row["axial_500um"], row["radial_500um"]) == (0.04, -0.04)
    assert row["buckled"] == pytest.approx(0.02)
    assert row["crumple_energy"] == 4.0  # of the crumple that came to rest
    assert row["crumples_settled"] == 0.5
    assert row["crumple_error"] == pytest.approx(0.25)


def test_what_found_no_answer_is_empty_in_the_tables_and_missing_in_the_chart(study, tmp_path):
    write_csv(study, tmp_path / "elements.csv")
    with open(tmp_path / "elements.csv") as file:
        rows = list(csv.DictReader(file))
    assert [row["variant"] for row in rows] == list(VARIANT_NAMES)
    assert rows[0]["roll_up"] == "" and rows[4]["roll_up"] == "0.04"
    write_markdown(study, tmp_path / "elements.md")
    lines = (tmp_path / "elements.md").read_text().splitlines()
    assert lines[2].startswith("| one point, χ = 0.01 | 1.50 | - | - |")
    figure = draw(study)
    assert len(figure.axes) == 6
