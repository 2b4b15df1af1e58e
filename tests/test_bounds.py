"""No foil is stiffer than its bounds."""

import numpy as np
import pytest
from conftest import DIAMETER, FEP, FOIL, GAP_HEIGHT, THICKNESS, cylinder

from foilstudy.measure.stiffness import InterfaceSystem, Rings, condense, fixed_stiffness
from foilstudy.measure.stiffness.bounds import bound_of_any_shape, bound_of_shape
from foilstudy.model.foil import Foil

STRAIGHT = Foil(DIAMETER, GAP_HEIGHT, GAP_HEIGHT, THICKNESS, FEP)
SHEAR_MODULUS = FEP.youngs_modulus / 2 / (1 + FEP.poisson_ratio)


def stiffness_of(sheet):
    system = InterfaceSystem.split(sheet.tangent(), Rings.of(sheet.patch, sheet.reference))
    return fixed_stiffness(condense(system).stiffness)


def test_a_crumple_is_softer_than_its_bound_and_that_than_the_bound_of_any_shape(coarse_crumple):
    sheet = coarse_crumple.stress_free
    bound = bound_of_shape(sheet.tangent(), sheet.reference)
    assert (stiffness_of(sheet) < bound).all()
    assert (bound < 1.05 * bound_of_any_shape(FOIL)).all()  # bending is not in the latter


def test_an_upright_cylinder_comes_close_to_its_bound():
    sheet = cylinder(10e-3, height=GAP_HEIGHT)
    bound = bound_of_shape(sheet.tangent(), sheet.reference)
    shear = SHEAR_MODULUS * THICKNESS * np.pi * (DIAMETER / 2) / GAP_HEIGHT
    # the rings own the rows next to them, so that less is left to be sheared
    assert 0.75 * bound[1] < stiffness_of(sheet)[1] < bound[1]
    assert bound[1] == pytest.approx(shear, rel=0.1)
    assert (bound < bound_of_any_shape(STRAIGHT) * 1.1).all()


def test_the_bound_of_shear_is_that_of_the_worst_inclination():
    """Against the membrane's energy, written out for tangent planes all around."""
    modulus = FEP.youngs_modulus / (1 - FEP.poisson_ratio**2)
    rng = np.random.default_rng(1)
    normals = rng.normal(size=(4000, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    planes = np.eye(3) - normals[:, :, None] * normals[:, None, :]
    resisted = np.zeros(len(normals))
    for direction in np.eye(3)[:2]:
        shear = (np.outer(direction, [0, 0, 1]) + np.outer([0, 0, 1], direction)) / 2
        strain = planes @ shear @ planes
        trace = np.trace(strain, axis1=1, axis2=2)
        squares = (strain**2).sum(axis=(1, 2))
        nu = FEP.poisson_ratio
        resisted += modulus * ((1 - nu) * squares + nu * trace**2)
    scale = THICKNESS * np.pi * DIAMETER * GAP_HEIGHT / GAP_HEIGHT**2
    bound = bound_of_any_shape(STRAIGHT)[1]
    assert resisted.max() * scale / 2 <= bound
    assert resisted.max() * scale / 2 == pytest.approx(bound, rel=1e-3)
