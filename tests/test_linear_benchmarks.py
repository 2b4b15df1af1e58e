"""Both elements against linear shell theory, on meshes that take seconds.

The same benchmarks on finer meshes are `snakemake verify`.
"""

import numpy as np
import pytest
from conftest import FEP

from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.supports.edges import constraints, diaphragm
from foilstudy.study.verification import frequencies, linear, stability, theory_cylinder
from foilstudy.study.verification.candidates import CANDIDATES
from foilstudy.study.verification.frequencies import CylinderCase, cylinder_frequencies
from foilstudy.study.verification.linear import plate_points, square_patch
from foilstudy.study.verification.theory_cylinder import Cylinder

CORNER, ONE_POINT = CANDIDATES["corner"], CANDIDATES["one_point"]
LEAST_ORDER = 1.7
"""Theory says 2; meshes as coarse as these are a little short of it."""

both_elements = pytest.mark.parametrize("candidate", CANDIDATES.values(), ids=CANDIDATES)


def order(benchmark):
    """Order of the root mean square of all errors between the first and the last mesh."""
    errors = np.sqrt(np.mean([q.errors**2 for q in benchmark.quantities], axis=0))
    meshes = benchmark.quantities[0].meshes
    return np.log(errors[0] / errors[-1]) / np.log(meshes[-1] / meshes[0])


def finest_errors(benchmark):
    return np.array([abs(q.errors[-1]) for q in benchmark.quantities])


def test_the_element_of_the_studies_is_under_test():
    assert CORNER.element == Corner()


@both_elements
def test_a_free_curved_sheet_has_six_rigid_motions_and_no_seventh(candidate):
    assert linear.rigid_motions(candidate).problems() == ()


@both_elements
def test_plates_deflect_as_their_series_say_also_on_skewed_grids(candidate):
    assert linear.plates(candidate, (8, 16, 32)).problems() == ()


def test_straight_and_skewed_grids_cover_the_same_plate():
    patch = square_patch(32)
    sheets = [
        CORNER.sheet(patch, plate_points(patch, skewed), FEP, 1e-3) for skewed in (False, True)
    ]
    areas = [sheet.section.areas for sheet in sheets]
    assert areas[0].sum() == pytest.approx(1.0, rel=1e-12)
    assert areas[1].sum() == pytest.approx(1.0, rel=1e-3)
    assert np.ptp(areas[1]) > 0.5 * areas[0].mean()


@pytest.mark.parametrize(("candidate", "error"), [(CORNER, 0.006), (ONE_POINT, 0.003)])
def test_scordelis_lo_roof_sinks_by_its_published_value(candidate, error):
    benchmark = linear.scordelis_lo(candidate, (8, 16, 32))
    assert benchmark.problems() == ()
    assert finest_errors(benchmark).max() < error


@both_elements
def test_pinched_cylinder_gives_in_as_its_series_says(candidate):
    _, exact = linear.pinched_cylinder(candidate, (24, 48)).quantities
    assert abs(exact.errors[-1]) < 0.02
    assert (np.diff(np.abs(exact.errors)) < 0).all()


@both_elements
def test_plates_ring_at_their_frequencies(candidate):
    assert frequencies.plate_frequencies(candidate, (8, 16, 32)).problems() == ()


@pytest.mark.parametrize(
    ("edges", "orders", "kinds"),
    [("clamped", (6, 7), 1), ("diaphragm", (6, 7), 1), ("free", (2, 3), 2)],
)
@pytest.mark.parametrize(("candidate", "error"), [(CORNER, 0.045), (ONE_POINT, 0.015)])
def test_foil_cylinders_ring_at_their_frequencies(candidate, error, edges, orders, kinds):
    case = CylinderCase(edges, 500e-6, (37, 74), orders, kinds)
    benchmark = cylinder_frequencies(candidate, edges, [case])
    assert finest_errors(benchmark).max() < error
    behind = 2.0 - candidate.order(free_edge=edges == "free")
    assert order(benchmark) > LEAST_ORDER - behind


def test_corner_element_regains_its_order_as_the_layer_at_free_edges_gets_resolved():
    """The layer is about sqrt(R t) wide, 2 to 20 mm; the elements are 11 and 7 mm."""
    meshes, orders = (56, 84), []
    for thickness in (50e-6, 500e-6, 4e-3):
        case = CylinderCase("free", thickness, meshes, (2,))
        errors = cylinder_frequencies(CORNER, "free", [case]).quantities[0].errors
        orders.append(np.log(errors[0] / errors[1]) / np.log(meshes[1] / meshes[0]))
    assert 0.6 < orders[0] < 1.1
    assert orders[0] + 0.3 < orders[1] < orders[2] < 2.0


def test_free_cylinder_has_six_modes_at_zero_frequency():
    patch = frequencies.Patch(37, 10, 2 * np.pi * 0.1 / 37, 0.017)
    points = frequencies.cylinder_control_points(patch, 0.2)
    sheet = CORNER.sheet(patch, points, FEP, 500e-6)
    first = theory_cylinder.frequencies(Cylinder(0.1, 0.17, 500e-6, FEP), theory_cylinder.FREE, 2)[
        0
    ]
    modes = frequencies.natural_modes(sheet, constraints(patch, {}), 1.2 * first)
    shares = np.abs(modes.eigenvalues) / (2 * np.pi * first) ** 2
    # and two of the lowest elastic order, as cosine and as sine
    assert len(shares) == 8
    assert shares[:6].max() < 1e-6
    assert shares[6:].min() > 1


def test_a_cylinder_between_diaphragms_slides_along_its_axis_without_waves_around():
    patch = frequencies.Patch(37, 10, 2 * np.pi * 0.1 / 37, 0.017)
    points = frequencies.cylinder_control_points(patch, 0.2)
    sheet = CORNER.sheet(patch, points, FEP, 500e-6)
    held = constraints(patch, {edge: diaphragm(0, 1) for edge in ("bottom", "top")})
    modes = frequencies.natural_modes(sheet, held, 40.0)
    orders = frequencies.circumferential_orders(patch, points, modes.shapes)
    assert np.abs(modes.eigenvalues).min() < 1e-3
    assert orders[np.argmin(np.abs(modes.eigenvalues))] == 0


def test_the_compared_buckling_modes_are_the_lowest_of_theory():
    cells = [
        stability.ModeCell(stability.FOIL_CYLINDER, m, n) for m in range(1, 31) for n in range(25)
    ]
    ascending = sorted(cells, key=stability.ModeCell.critical_stress)
    rings = [cell for cell in ascending if cell.n == 0]
    assert [cell for cell, _ in stability.CASES] == [*ascending[:3], rings[0]]


@both_elements
def test_perfect_cylinder_buckles_in_its_modes_at_their_loads(candidate):
    cases = [(cell, meshes[:2]) for cell, meshes in stability.CASES[:3:2]]
    benchmark = stability.axial_buckling(candidate, cases)
    assert finest_errors(benchmark).max() < 0.01
    assert (finest_errors(benchmark) < [abs(q.errors[0]) / 3 for q in benchmark.quantities]).all()


@pytest.mark.parametrize(("candidate", "sign"), [(CORNER, -1), (ONE_POINT, 1)])
def test_short_rings_buckle_early_or_late_by_what_their_samples_miss(candidate, sign):
    """A wave w = cos(pz) has the hoop strain w/R and the slope s = 2 sin(ph/2)/h at the knots.

    At the corners its mean square is 1 - s^2 h^2/4, which takes E t h^2 / (4 R^2) off the critical
    line load D s^2 + E t / (R s)^2; at the middle, slope and curvature give as much in excess.
    """
    cell, (elements, *_) = stability.CASES[3]
    load, _ = stability.cell_load(candidate, cell, cell.patch(elements, elements))
    cylinder, size = cell.cylinder, cell.height / elements
    missing = np.sqrt(3 * (1 - FEP.poisson_ratio**2)) * size**2
    missing /= 4 * cylinder.radius * cylinder.thickness
    assert load - cell.critical_stress() == pytest.approx(sign * missing, rel=0.15)
