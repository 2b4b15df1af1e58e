"""An imperfection that is taken out of the foil once it has buckled."""

from dataclasses import replace

import numpy as np
import pytest
from conftest import FOIL

from foilstudy.base.errors import Refusal
from foilstudy.config import load_config
from foilstudy.config.scene import recipe_of
from foilstudy.model.contact.options import BarrierContact
from foilstudy.model.foil import Imperfection
from foilstudy.model.patch import cylinder_control_points
from foilstudy.pipeline.crumple import crumple, uncrumpled, without_imperfection
from foilstudy.pipeline.lesser import crumple_lesser
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.choices import PATHS
from foilstudy.solve.paths.relaxation import RelaxationPath

COARSE = Mesh(12e-3)
REMOVED = Imperfection(removed=True)
RELAXED = Method(RelaxationPath(1000))


def radial(shape):
    return np.hypot(*shape.points[:2]) - np.hypot(*shape.reference[:2])


def test_what_is_left_is_a_perfect_cylinder_in_the_buckles_that_the_imperfection_chose():
    start = uncrumpled(FOIL, COARSE, REMOVED, RELAXED)
    assert np.abs(radial(replace(start, reference=start.points))).max() == 0
    buckled = without_imperfection(start)
    perfect = cylinder_control_points(start.patch, FOIL.diameter)
    np.testing.assert_array_equal(buckled.reference, perfect)
    # the ring has come down by twice the strain at which the cylinder buckles
    strain = 5e-3 / np.sqrt(3 * (1 - 0.4**2))
    lowered = FOIL.reference_height - buckled.points[2, -2:].mean()
    assert lowered == pytest.approx(2 * strain * FOIL.reference_height, rel=1e-6)
    assert radial(buckled).std() > 10 * REMOVED.amplitude


def test_a_crumple_of_a_perfect_cylinder_depends_on_the_seed_of_what_was_removed():
    first, same, other = (
        crumple(FOIL, COARSE, replace(REMOVED, seed=seed), RELAXED) for seed in (0, 0, 1)
    )
    assert first.status == other.status == "converged"
    np.testing.assert_array_equal(first.points, same.points)
    np.testing.assert_array_equal(first.reference, other.reference)
    assert np.abs(first.points - other.points).max() > 1e-3
    assert first.points[2, -2:].mean() == pytest.approx(FOIL.gap_height, rel=1e-12)
    assert first.problem().value(first.reference) == pytest.approx(0.0, abs=1e-20)


def test_what_does_not_move_or_remembers_is_refused():
    with pytest.raises(Refusal, match="after_buckling needs a foil that is elastic and relaxed"):
        crumple(FOIL, COARSE, REMOVED, Method(PATHS["newton"]()))
    plastic = replace(FOIL, material=replace(FOIL.material, law="plastic"))
    with pytest.raises(Refusal, match="elastic and relaxed"):
        crumple(plastic, COARSE, REMOVED, RELAXED)


def test_models_that_would_not_remove_it_refuse_it():
    for make in (
        lambda: crumple(FOIL, COARSE, REMOVED, replace(RELAXED, contact=BarrierContact())),
        lambda: crumple_lesser("mass_spring", FOIL, COARSE, REMOVED, RELAXED),
    ):
        with pytest.raises(Refusal, match="after_buckling is not for a"):
            make()


def test_the_configuration_asks_for_it():
    content = {"sweep": {"thickness_um": [500], "reference_height_mm": [170]}}
    for removal, removed in (("never", False), ("after_buckling", True)):
        study = load_config(content | {"imperfection": {"removal": removal}})
        assert recipe_of(study.crumple_task(study.cells()[0])).imperfection.removed == removed
