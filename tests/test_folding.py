"""The angle between neighbouring elements, on surfaces whose folds are known."""

import numpy as np
import pytest
from conftest import rotation

from foilstudy.model.shell.folding import fold_angle


def prism(radius, rows=9, height=1.0):
    """Surface over a closed polygon, the corners of which lie at the given radii."""
    columns = radius.size
    t = 2 * np.pi * np.arange(columns) / columns
    surface = np.empty((3, rows, columns))
    surface[0], surface[1] = radius * np.cos(t), radius * np.sin(t)
    surface[2] = np.linspace(0, height, rows)[:, None]
    return surface


def test_a_cylinder_turns_by_the_same_angle_from_column_to_column():
    assert fold_angle(prism(np.ones(40))) == pytest.approx(2 * np.pi / 40, rel=1e-12)


def test_a_pleated_prism_turns_by_the_angle_of_its_pleats():
    radius = np.where(np.arange(40) % 2, 1.0, 0.9)
    points = prism(radius)[:2, 0]
    sides = np.roll(points, -1, axis=1) - points
    sides /= np.linalg.norm(sides, axis=0)
    turns = np.arccos((sides * np.roll(sides, -1, axis=1)).sum(axis=0))
    assert fold_angle(prism(radius)) == pytest.approx(turns.max(), rel=1e-9)


def test_a_finer_mesh_turns_by_less_from_element_to_element():
    """A smooth fold is resolved; what one step of the coarse mesh turns, two of the fine one do."""

    def wavy(columns):
        return prism(1 + 0.05 * np.cos(8 * 2 * np.pi * np.arange(columns) / columns))

    assert fold_angle(wavy(160)) == pytest.approx(fold_angle(wavy(80)) / 2, rel=0.1)


def test_neither_place_nor_size_matters():
    surface = prism(np.where(np.arange(40) % 2, 1.0, 0.9))
    angle = fold_angle(surface)
    turned = np.einsum("ij,jrc->irc", rotation((1, 2, 3), 0.7), 1e-3 * surface) + 5.0
    assert fold_angle(turned) == pytest.approx(angle, rel=1e-6)
    assert fold_angle(np.roll(surface, 7, axis=2)) == pytest.approx(angle, rel=1e-12)


def test_a_few_sharp_folds_do_not_decide():
    surface = prism(np.ones(40), rows=41)
    surface[0, 20, 3] += 0.5
    assert fold_angle(surface) < 2 * 2 * np.pi / 40


def test_an_element_without_area_has_no_angle():
    surface = prism(np.ones(40))
    surface[:, 0, :2] = surface[:, 1, :2] = 0.0
    assert np.isnan(fold_angle(surface))
