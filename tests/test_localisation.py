"""Where the shortening takes place, and shapes drawn by hand."""

from dataclasses import replace

import numpy as np
import pytest

from foilstudy.measure.localisation import (
    BANDS,
    developed_height,
    gini,
    localisation,
    shortening_profile,
)
from foilstudy.model.patch import Patch, knot_points
from foilstudy.pipeline.drawn import Concertina, Pleats, drawn
from foilstudy.study.published import foil


def fine(sheet, size=1.25e-3, around=48):
    along = round(sheet.reference_height / size)
    return Patch(around, along, np.pi * sheet.diameter / around, sheet.reference_height / along)


def shape(meridian, height_mm=170, **mesh):
    sheet = foil(500, height_mm)
    return drawn(sheet, fine(sheet, **mesh), meridian)


@pytest.mark.parametrize("meridian", [Pleats(1, 9e-3), Pleats(3, 9e-3), Concertina(6)])
def test_a_drawn_shape_is_as_long_as_its_foil_and_stands_in_the_gap(meridian):
    found = shape(meridian)
    assert developed_height(found.patch, found.points) == pytest.approx(0.17, rel=0.02)
    assert shortening_profile(found.patch, found.points).sum() == pytest.approx(0.04, rel=1e-3)
    edge = knot_points(found.points)[:2, [0, -1]]
    assert np.hypot(*edge) == pytest.approx(0.1, rel=2e-3)


def test_localisation_tells_one_pleat_from_many():
    one, three, even = (
        localisation(each.patch, each.points)
        for each in (shape(Pleats(1)), shape(Pleats(3)), shape(Concertina(10)))
    )
    assert one["shortening_spread"] < three["shortening_spread"] < even["shortening_spread"]
    assert one["shortening_spread"] < 0.35 and even["shortening_spread"] > 0.98
    assert one["shortening_gini"] > three["shortening_gini"] > even["shortening_gini"]
    for each in (one, three, even):
        assert each["axisymmetric_share"] == pytest.approx(1)


def test_gini_of_even_and_of_single_values():
    assert gini(np.ones(BANDS)) == pytest.approx(0)
    assert gini(np.eye(BANDS)[3]) == pytest.approx(1 - 1 / BANDS)
    assert np.isnan(gini(np.zeros(BANDS)))


def test_one_pleat_has_the_radial_stiffness_of_its_straight_rest():
    """Two cylinders in series, each held by a ring and, at the pleat, by its flat disc."""
    found = shape(Pleats(1), size=2.5e-3).stiffness()
    double = shape(Pleats(1), 250, size=2.5e-3).stiffness()
    assert found[1] > 40 * found[0]
    assert double[0] < found[0] and double[1] < found[1]
    even = shape(Concertina(6), size=2.5e-3).stiffness()
    assert even[1] / even[0] == pytest.approx(3.4, rel=0.05)  # of any uniform concertina


def test_profile_does_not_know_the_mesh():
    found = shape(Concertina(6), size=2.5e-3)
    profiles = [shortening_profile(each.patch, each.points) for each in (found, found.refined())]
    assert profiles[0] == pytest.approx(profiles[1], abs=2e-4)
    turned = replace(found, points=found.points[:, ::-1] * [[[1]], [[1]], [[-1]]])
    assert shortening_profile(turned.patch, turned.points) == pytest.approx(
        profiles[0][::-1], abs=1e-12
    )
