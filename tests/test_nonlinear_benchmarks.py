"""Large displacements on coarse meshes against closed forms and Sze, Liu and Lo (2004).

``snakemake verify`` runs the same cases on finer meshes and at every published load.
"""

from dataclasses import replace

import numpy as np
import pytest

from foilstudy.study.verification.candidates import CANDIDATES
from foilstudy.study.verification.nonlinear import (
    END_SHEAR,
    OPEN_CYLINDER,
    PINCHED_CYLINDER,
    ROLL_UP,
    SLIT_ANNULUS,
)

CORNER, ONE_POINT = CANDIDATES["corner"], CANDIDATES["one_point"]

both_elements = pytest.mark.parametrize("candidate", CANDIDATES.values(), ids=CANDIDATES)


def quick(case, candidate, factors, meshes):
    """Quantities of a case at fewer loads and on coarser meshes."""
    places = [case.factors.index(factor) for factor in factors]
    probes = tuple(
        replace(probe, published=tuple(probe.published[k] for k in places)) for probe in case.probes
    )
    return replace(case, factors=factors, probes=probes).run(candidate, meshes).quantities


def limit(quantity):
    """Value extrapolated to element size zero from the last two meshes, by the order of theory."""
    ratio = (quantity.meshes[-1] / quantity.meshes[-2]) ** quantity.expected_rate
    return quantity.values[-1] + (quantity.values[-1] - quantity.values[-2]) / (ratio - 1)


@both_elements
def test_a_cantilever_bends_under_end_shear_as_published(candidate):
    for quantity in quick(END_SHEAR, candidate, (0.1, 0.5, 1.0), (8, 16, 32)):
        assert quantity.values[-1] == pytest.approx(quantity.reference, rel=1e-3)
        assert quantity.rate == pytest.approx(2, abs=0.2)


def test_an_end_moment_rolls_a_cantilever_into_a_circle():
    quantities = quick(ROLL_UP, CORNER, tuple(np.arange(1, 9) / 8), (16, 32))
    for quantity in quantities:
        error = quantity.errors
        # second order: a quarter of the error on half the element size
        assert error[1] / error[0] == pytest.approx(0.25, abs=0.05)
        # what is left is the strain of the middle surface, some t^2 / (12 R^2)
        assert limit(quantity) == pytest.approx(quantity.reference, rel=2e-3)


@both_elements
def test_an_open_cylinder_is_pulled_out_as_published(candidate):
    under_load, middle, end = quick(OPEN_CYLINDER, candidate, (0.1, 0.5, 1.0), (8, 16))[1::2]
    assert under_load.values[-1] == pytest.approx(2.768, rel=0.08)
    assert middle.values[-1] == pytest.approx(4.551, rel=0.04)
    assert end.values[-1] == pytest.approx(3.269, rel=0.01)


@pytest.mark.parametrize(("candidate", "error"), [(CORNER, 0.03), (ONE_POINT, 0.005)])
def test_a_clamped_cylinder_is_pinched_as_published(candidate, error):
    half, full = quick(PINCHED_CYLINDER, candidate, (0.1, 0.3, 0.5, 0.8, 1.0), (8, 16))
    assert half.values[-1] == pytest.approx(132.653, rel=error)
    assert full.values[-1] == pytest.approx(171.505, rel=error)


def test_a_slit_annulus_is_lifted_as_published():
    """Both corners approach from above, with the order of the mesh."""
    for quantity in quick(SLIT_ANNULUS, ONE_POINT, (0.1, 0.5, 1.0), (16, 32)):
        assert 0 < quantity.errors[1] < quantity.errors[0] / 3
        assert limit(quantity) == pytest.approx(quantity.reference, rel=0.02)


def test_a_slit_annulus_of_corner_elements_approaches_from_below_with_first_order():
    """Its free edges are too stiff; half the element size takes away less than half the error."""
    for quantity in quick(SLIT_ANNULUS, CORNER, (0.1, 0.5, 1.0), (32, 64)):
        assert -0.02 < quantity.errors[1] < 0
        assert 0.4 < quantity.errors[1] / quantity.errors[0] < 0.6


def test_every_published_table_has_a_value_for_every_load():
    for case in (END_SHEAR, ROLL_UP, OPEN_CYLINDER, PINCHED_CYLINDER, SLIT_ANNULUS):
        assert all(len(probe.published) == len(case.factors) for probe in case.probes)
        assert all(set(probe.compared) <= set(case.factors) for probe in case.probes)
