"""Plastic foil with a seam or an uneven thickness: every element its own layers and stresses."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from test_plastic import back_stress_of, von_mises
from wild_sheets import extrapolated, flat, unflat

from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.materials import material
from foilstudy.model.patch import Patch, fitted_control_points
from foilstudy.model.shell.material.plastic import Plastic
from foilstudy.model.shell.section import Section
from foilstudy.model.shell.shell import Shell
from foilstudy.model.shell.variation import Variation
from foilstudy.model.specimen import Seam, Specimen, Unevenness
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths.relaxation import RelaxationPath

YIELD, FOIL_THICKNESS = 12e6, 500e-6
FEP = replace(material("FEP"), law="plastic", yield_stress=YIELD)
MESH = Mesh(18e-3)
IDEAL = Specimen()
BOTH = Specimen(seam=Seam(0.02, 2.0, 1.5), unevenness=Unevenness(0.1, 0.03, seed=3))
either_element = pytest.mark.parametrize("element", ["corner", "one_point"])


def start(specimen, element="corner"):
    foil = Foil(0.2, 0.17, 0.13, FOIL_THICKNESS, FEP, specimen)
    return uncrumpled(foil, replace(MESH, element=element))


def moved(shape, size=2e-3, seed=1):
    rng = np.random.default_rng(seed)
    return shape.reference + size * rng.normal(size=shape.reference.shape)


def shell_and_term(shape):
    shell = shape.stressed
    (term,) = shell.section.law.terms(shell)
    return shell, term


def test_an_even_factor_is_another_thickness():
    shape = start(IDEAL)
    section, states = shape.stressed.section, []
    even = np.ones((shape.patch.elements_along, shape.patch.elements_around))
    varied = replace(section, thickness=FOIL_THICKNESS / 1.2, variation=Variation(1.2 * even, even))
    for each in (section, varied):
        (term,) = each.law.terms(Shell(each, shape.element))
        states.append(term.evolved(moved(shape), term.start()).layers)
    assert states[0].any()
    np.testing.assert_allclose(states[1], states[0], rtol=0, atol=1e-12 * states[0].max())


@either_element
def test_derivatives_at_a_fixed_state(element):
    shape = start(BOTH, element)
    _, term = shell_and_term(shape)
    points, way = moved(shape), moved(shape, seed=2) - shape.reference
    state = term.evolved(moved(shape, seed=8), term.start())
    assert term.plastic_share(state) > 0.5
    force, other = np.empty_like(points), np.empty_like(points)
    term.force(points, force, state)
    tangent = term.tangent(points, state)

    def slope(step, part):
        if part == 0:
            ahead, behind = (term.force(points + s * step * way, other, state) for s in (1, -1))
            return (ahead[0] - behind[0]) / (2 * step)
        forces = []
        for sign in (1, -1):
            term.force(points + sign * step * way, other, state)
            forces.append(other.copy())
        return (forces[0] - forces[1]) / (2 * step)

    error = extrapolated(lambda h: slope(h, 0), 0.05) - (force * way).sum()
    assert abs(error) < 1e-8 * np.linalg.norm(force) * np.linalg.norm(way)
    product = unflat(tangent @ flat(way), shape.patch)
    error = extrapolated(lambda h: slope(h, 1), 0.05) - product
    assert np.linalg.norm(error) < 1e-7 * np.linalg.norm(product)


@either_element
def test_shell_and_term_in_one_are_the_two(element):
    shape = start(BOTH, element)
    shell, term = shell_and_term(shape)
    points = moved(shape)
    together, elastic, share = (np.empty_like(points) for _ in "123")
    first = term.evolved(moved(shape, seed=8), term.start())
    for state in (first, term.evolved(points, first), term.start()):
        energies = term.force_with_shell(points, together, state)
        apart = *shell.force(points, elastic), *term.force(points, share, state)
        np.testing.assert_allclose(energies, apart, rtol=1e-12, atol=1e-13 * sum(apart[:3]))
        assert np.abs(together - elastic - share).max() < 1e-12 * np.abs(elastic).max()


def test_an_element_yields_as_its_own_thickness_and_modulus_make_it():
    """Each has the layers, stresses and work of an even foil of its own."""
    shape = start(BOTH)
    _, term = shell_and_term(shape)
    points = moved(shape)
    state = term.evolved(points, term.start())
    varied = shape.stressed.section.variation
    volumes = shape.stressed.section.areas * FOIL_THICKNESS * varied.thickness
    used = varied.modulus * YIELD * state.accumulated.mean(axis=1) * volumes
    assert term.dissipated(state) == pytest.approx(used.sum(), rel=1e-9)
    for place in ((4, 0), (2, 7), (6, 12)):
        even = start(IDEAL)
        own = replace(even, foil=_like(shape, place))
        _, alone = shell_and_term(own)
        there = alone.evolved(points, alone.start())
        row, column = place
        np.testing.assert_allclose(
            state.layers[row, :, :, column], there.layers[row, :, :, column], rtol=1e-9, atol=1e-15
        )
        np.testing.assert_allclose(
            term.stresses(points, state)[row, :, :, column],
            alone.stresses(points, there)[row, :, :, column],
            rtol=1e-9,
            atol=1e-3,
        )


def _like(shape, place):
    """An even foil as one element of an uneven one is."""
    varied, foil = shape.stressed.section.variation, shape.foil
    factor, made = varied.modulus[place], foil.material
    return replace(
        foil,
        thickness=foil.thickness * varied.thickness[place],
        material=replace(
            made,
            youngs_modulus=factor * made.youngs_modulus,
            yield_stress=factor * made.yield_stress,
        ),
        specimen=IDEAL,
    )


def _rolled(curvature, s, z):
    angle = curvature * z
    return np.stack([s, np.sin(angle) / curvature, (1 - np.cos(angle)) / curvature])


def test_moment_of_a_strip_of_each_thickness():
    """M over that of the elastic limit is 3/2 - 1/2 (k_y / k)^2, both by an element's thickness.

    A flat foil, incompressible and perfectly plastic, bent as part of a wide plate.
    """
    thickness, limit, modulus, nu = 1e-3, 1e5, 1e9, 0.5
    patch = Patch(6, 6, 0.01, 0.01, periodic=False)
    factors = np.ones((6, 6)) * [0.5, 0.8, 1.0, 1.3, 1.7, 2.0]
    moduli = np.ones((6, 6)) * [1.0, 3.0, 1.0, 0.7, 1.0, 2.0]
    law = Plastic(
        replace(FEP, youngs_modulus=modulus, poisson_ratio=nu, yield_stress=limit), hardening=0.0
    )
    flat_sheet = fitted_control_points(patch, lambda s, z: np.stack([s, z, 0 * s]))
    section = Section(patch, flat_sheet, thickness, law, Variation(factors, moduli))
    (term,) = law.terms(Shell(section))
    own = thickness * factors
    first = 2 * (2 * limit / np.sqrt(3)) * (1 - nu**2) / modulus / own  # k_y of each
    elastic = moduli * modulus / (1 - nu**2) * own**3 / 12 * first
    state, heights = term.start(), term.heights[None, :, None] * factors[:, None]
    for curvature in np.linspace(0, 4, 81)[1:] * first[0, 2]:
        bent = fitted_control_points(patch, partial(_rolled, curvature))
        state = term.evolved(bent, state)
        across = term.stresses(bent, state)[:, :, 1]
        moment = np.abs((across * heights).mean(axis=1)) * own
        ratio = curvature / first
        exact = np.where(ratio < 1, ratio, 1.5 - 0.5 / ratio**2)
        assert np.abs(moment / elastic - exact).max() < 0.025
    assert (ratio.min(), ratio.max()) == pytest.approx((2, 8))


def test_energies_along_a_way():
    """The work done is what is left, what hardening keeps and what is dissipated."""
    shape = start(BOTH)
    shell, term = shell_and_term(shape)
    ends = [shape.reference, moved(shape, 1e-3), moved(shape, 1e-3, seed=2), shape.reference]
    state, before, work, dissipated = term.start(), shape.reference, 0.0, 0.0
    force, now = np.zeros_like(before), np.empty_like(before)
    for first, last in zip(ends, ends[1:]):
        for step in range(1, 401):
            points = first + step / 400 * (last - first)
            state = term.evolved(points, state)
            energy = term.force_with_shell(points, now, state).sum()
            assert energy >= 0
            work += 0.5 * np.sum((force + now) * (points - before))
            force, before = now.copy(), points
            assert term.dissipated(state) >= dissipated
            dissipated = term.dissipated(state)
    assert dissipated > 0.3 * work
    assert work == pytest.approx(energy + term.spent(state), rel=1e-2)


def crumpled(specimen):
    foil = Foil(0.2, 0.17, 0.13, FOIL_THICKNESS, FEP, specimen)
    return crumple(foil, MESH, Imperfection(seed=1), Method(RelaxationPath(ramp_steps=300)))


def test_a_seam_like_the_foil_changes_no_bit():
    plain, seamed = crumpled(IDEAL), crumpled(Specimen(seam=Seam(0.02)))
    assert plain.status == "converged"
    assert np.array_equal(plain.points, seamed.points)
    assert plain.problem().numbers() == seamed.problem().numbers()


def test_an_uneven_plastic_foil_crumples_and_no_layer_is_beyond_yield():
    found = crumpled(BOTH)
    assert found.status == "converged", found.message
    problem = found.problem()
    term, state = problem.terms[1], problem.state[1]
    assert 0.1 < term.plastic_share(state) < 1
    modulus = found.stressed.section.variation.modulus[:, None]
    stress = term.stresses(found.points, state).transpose(2, 0, 1, 3)
    back = np.stack(back_stress_of(state.layers[:, :, :3].transpose(2, 0, 1, 3), term.law.flow))
    assert (von_mises(stress - modulus * back) / modulus).max() <= YIELD * (1 + 1e-9)
    again = found.settled()
    assert (again.arrival.steps, again.arrival.hessians) == (0, 0)
    finer = found.refined().settled()
    assert finer.status == "converged", finer.message
