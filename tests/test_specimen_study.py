"""The side study of the specimen: what it joins and how it compares."""

from dataclasses import replace

import numpy as np
import pytest

from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.study.published import foil
from foilstudy.study.specimen.crumples import shortened, whole_foil
from foilstudy.study.specimen.plan import Shared
from foilstudy.study.specimen.release import joined
from foilstudy.study.specimen.tables import change, measured_stiffness


@pytest.mark.parametrize("share, law", [("half", "elastic"), ("third", "elastic")])
def test_a_band_as_it_was_rolled_and_its_rest_are_the_whole_cylinder(share, law):
    whole = whole_foil(Shared(law, share, 30.8, 0))
    smooth = Imperfection(amplitude=0.0)
    band = uncrumpled(shortened(whole, Shared(law, share, 30.8, 0)), Mesh(14e-3), smooth)
    found = joined(band, whole)
    patch = found.patch
    expected = uncrumpled(whole, Mesh(14e-3), smooth)
    assert band.foil.shortening == pytest.approx(whole.shortening)
    assert np.hypot(*found.points[:2]) == pytest.approx(np.hypot(*expected.points[:2]).mean())
    assert np.diff(found.points[2], axis=0) == pytest.approx(patch.size_along)
    assert patch.elements_along * patch.size_along == pytest.approx(whole.reference_height)
    assert replace(found, points=found.reference).energies().total < 1e-15


def test_a_factor_has_the_interval_of_its_logarithm():
    plain = np.array([1.0, 2.0, 4.0])
    factor, low, high = change(1.5 * plain, plain)
    assert (factor, low, high) == pytest.approx((1.5, 1.5, 1.5))
    factor, low, high = change(plain * [1.0, 2.0, 4.0], plain)
    half = 4.302653 * np.log(2) / np.sqrt(3)  # Student, two degrees of freedom
    assert (factor, low, high) == pytest.approx((2, 2 * np.exp(-half), 2 * np.exp(half)), rel=1e-6)
    assert np.isnan(change([1.0], [2.0])).all()


def test_the_measured_laws_are_those_that_were_published():
    assert measured_stiffness("radial", 30.8) == pytest.approx(135e3, rel=0.02)
    assert foil(500).thickness == pytest.approx(500e-6)
