"""Reference solutions of plates and cylinders, against published values and each other."""

import numpy as np
import pytest

from foilstudy.model.materials import Material
from foilstudy.study.verification import theory_cylinder, theory_plate
from foilstudy.study.verification.theory_cylinder import Cylinder
from foilstudy.study.verification.theory_roof import Roof, edge_deflection

FEP = Material(650e6, 0.4, 2150.0, 12e6)


def foil_cylinder(thickness):
    return Cylinder(0.1, 0.17, thickness, FEP)


def test_clamped_plate_deflects_as_taylor_and_govindjee_found():
    """Commun. Numer. Meth. Engng 20 (2004) 757-765."""
    assert theory_plate.clamped_deflection() == pytest.approx(0.00126532, abs=5e-9)


def test_simply_supported_plate_deflects_as_in_timoshenko():
    """Theory of Plates and Shells, 2nd ed., table 8: 0.00406; more digits by the double series."""
    m = np.arange(1, 400, 2)
    sign = (-1.0) ** ((m - 1) // 2) / m
    series = 16 / np.pi**6 * np.sum(np.outer(sign, sign) / (m[:, None] ** 2 + m**2) ** 2)
    assert theory_plate.simply_supported_deflection() == pytest.approx(series, rel=1e-9)
    assert theory_plate.simply_supported_deflection() == pytest.approx(0.00406, abs=5e-6)


def test_simply_supported_plate_rings_at_sums_of_squares():
    found = theory_plate.frequencies(theory_plate.SIMPLY_SUPPORTED, 0.3, 6)
    np.testing.assert_allclose(found, np.pi**2 * np.array([2, 5, 5, 8, 10, 10]), rtol=1e-8)


@pytest.mark.parametrize(
    ("condition", "published"),
    [
        (theory_plate.FREE, (13.489, 19.789, 24.432, 35.024, 35.024)),
        (theory_plate.CLAMPED, (35.992, 73.413, 73.413, 108.27, 131.64, 132.24)),
    ],
)
def test_plate_frequencies_lie_just_below_the_upper_bounds_of_leissa(condition, published):
    """A. W. Leissa, J. Sound Vib. 31 (1973) 257-293: Ritz with 36 products of beam functions."""
    found = theory_plate.frequencies(condition, 0.3, len(published))
    assert (found < published).all()
    np.testing.assert_allclose(found, published, rtol=0.011)


def diaphragm_frequency(cylinder, m, n):
    """Lowest of the three frequencies of the exact mode sin(m pi z / L) cos(n theta), Hz."""
    wave = cylinder.strains(n) @ (1j * m * np.pi / cylinder.length) ** np.arange(3)
    stiffness = wave.conj().T @ cylinder.law() @ wave
    return np.sqrt(np.linalg.eigvalsh(stiffness)[0] / cylinder.mass) / (2 * np.pi)


@pytest.mark.parametrize("n", [2, 7, 12])
@pytest.mark.parametrize("thickness", [500e-6, 50e-6])
def test_polynomials_find_the_exact_frequencies_between_diaphragms(n, thickness):
    cylinder = foil_cylinder(thickness)
    found = theory_cylinder.frequencies(cylinder, theory_cylinder.DIAPHRAGM, n, 2)
    exact = [diaphragm_frequency(cylinder, m, n) for m in (1, 2)]
    np.testing.assert_allclose(found, exact, rtol=1e-7)


@pytest.mark.parametrize(
    ("edges", "n", "kinds"),
    [(theory_cylinder.CLAMPED, 14, 2), (theory_cylinder.FREE, 2, 3)],
)
def test_frequencies_of_the_thinnest_foil_are_converged(edges, n, kinds):
    few, many = (
        theory_cylinder.frequencies(foil_cylinder(50e-6), edges, n, kinds, functions)
        for functions in (40, 52)
    )
    assert (many <= few * (1 + 1e-9)).all()
    np.testing.assert_allclose(few, many, rtol=1e-6)


@pytest.mark.parametrize("n", [0, 1])
def test_strains_of_rigid_motions_are_zero(n):
    """Axial shift and turn about the axis (n = 0), shift across and tilt (n = 1)."""
    found = theory_cylinder.frequencies(foil_cylinder(500e-6), theory_cylinder.FREE, n, 3)
    assert found[1] < 1e-9 * found[2]


@pytest.mark.parametrize("n", [2, 3, 5])
def test_free_cylinder_swings_without_stretching_as_rayleigh_found(n):
    """Free edges give in to Poisson's effect, which lowers the frequency by a little."""
    cylinder = foil_cylinder(500e-6)
    found = theory_cylinder.frequencies(cylinder, theory_cylinder.FREE, n)[0]
    # Theory of Sound, 2nd ed., 1894, section 235c
    shape = (n * (n**2 - 1)) ** 2 / (cylinder.radius**4 * (n**2 + 1))
    rayleigh = np.sqrt(cylinder.law()[3, 3] / cylinder.mass * shape) / (2 * np.pi)
    assert 0.99 * rayleigh < found < rayleigh


def test_holding_more_of_the_edges_raises_the_frequency():
    cylinder = foil_cylinder(500e-6)
    kinds = theory_cylinder.FREE, theory_cylinder.DIAPHRAGM, theory_cylinder.CLAMPED
    free, diaphragm, clamped = (theory_cylinder.frequencies(cylinder, e, 6)[0] for e in kinds)
    assert free < diaphragm < clamped


def test_ring_buckling_tends_to_the_classical_stress_as_the_wall_gets_thin():
    """Axisymmetric waves of the critical length, R t / sqrt(12 (1 - nu^2)) = 1 / p^2."""
    ratios = []
    for thickness in (1e-3, 1e-4, 1e-5):
        p = (12 * (1 - 0.4**2)) ** 0.25 / np.sqrt(0.1 * thickness)
        cylinder = Cylinder(0.1, np.pi / p, thickness, FEP)
        stress = FEP.youngs_modulus * theory_cylinder.buckling_strain(cylinder, 1, 0)
        ratios.append(stress / theory_cylinder.classical_buckling_stress(cylinder))
    assert np.diff(np.abs(np.array(ratios) - 1)).max() < 0
    assert ratios[-1] == pytest.approx(1, abs=2e-4)


def test_long_waves_buckle_at_the_classical_stress_of_donnell():
    """sigma / sigma_cl = (s + 1/s) / 2 on shallow waves [Timoshenko Gere], see `imperfection`."""
    cylinder = foil_cylinder(50e-6)
    m, n = 12, 24
    p, q = m * np.pi / cylinder.length, n / cylinder.radius
    s = (p**2 + q**2) ** 2 * cylinder.radius * cylinder.thickness / p**2
    s /= np.sqrt(12 * (1 - 0.4**2))
    stress = FEP.youngs_modulus * theory_cylinder.buckling_strain(cylinder, m, n)
    ratio = stress / theory_cylinder.classical_buckling_stress(cylinder)
    assert ratio == pytest.approx(0.5 * (s + 1 / s), rel=0.02)


def test_series_of_the_pinched_cylinder_does_not_depend_on_where_it_is_cut():
    cylinder = Cylinder(300.0, 600.0, 3.0, Material(3e6, 0.3, 1.0, 1.0))
    coarse, fine = (theory_cylinder.pinched_deflection(cylinder, terms) for terms in (200, 400))
    assert coarse == pytest.approx(fine, rel=2e-5)
    # 164.24 P / (E t) of Lindberg, Olson and Cowper 1969, a series cut off sooner
    assert fine == pytest.approx(164.24 / 9e6, rel=3e-3)


def test_scordelis_lo_roof_sinks_by_what_kirchhoff_love_elements_converge_to():
    """0.3006 in isogeometric literature."""
    roof = Roof(Cylinder(25.0, 50.0, 0.25, Material(4.32e8, 0.0, 1.0, 1.0)), np.radians(40), 90.0)
    few, many = edge_deflection(roof, 40, 18), edge_deflection(roof, 100, 26)
    assert few == pytest.approx(many, rel=1e-6)
    assert many == pytest.approx(0.3006, abs=5e-5)


def test_long_narrow_roof_bends_like_a_beam():
    """5 q L^4 / (384 E I) for a thin arc between diaphragms, far longer than wide."""
    radius, angle, thickness, length, modulus = 1.0, np.radians(20), 0.02, 60.0, 1e9
    roof = Roof(Cylinder(radius, length, thickness, Material(modulus, 0.0, 1.0, 1.0)), angle, 1.0)
    area = 2 * angle * radius * thickness
    mean_square = 0.5 * (1 + np.sin(2 * angle) / (2 * angle))  # of the cosine
    inertia = area * radius**2 * (mean_square - (np.sin(angle) / angle) ** 2)
    inertia += area * thickness**2 / 12 * mean_square
    beam = 5 * (2 * angle * radius) * length**4 / (384 * modulus * inertia)
    assert edge_deflection(roof) == pytest.approx(beam, rel=0.01)
