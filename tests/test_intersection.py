"""Self-crossing of surfaces whose crossing is known."""

import numpy as np
import pytest
from conftest import rotation

from foilstudy.model.shell.intersection import self_crossing_share


def extruded(curve, rows=7, height=1.0):
    """Closed curve (2, columns) swept along z."""
    z = np.linspace(0, height, rows)
    surface = np.empty((3, rows, curve.shape[1]))
    surface[:2] = curve[:, None]
    surface[2] = z[:, None]
    return surface


def limacon(columns, offset=0.31):
    """r = 1 + 2 cos(t): a loop inside a loop, which crosses itself once, at the origin."""
    t = 2 * np.pi * (np.arange(columns) + offset) / columns
    r = 1 + 2 * np.cos(t)
    return np.array([r * np.cos(t), r * np.sin(t)])


def crossing_segments(curve):
    """Segments of a closed polyline that cross a segment they do not touch, one by one."""
    start, end = curve.T, np.roll(curve, -1, axis=1).T
    count = len(start)
    crossed = np.zeros(count, bool)

    def side(a, b, p):
        return np.sign((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]))

    for i in range(count):
        for j in range(i + 2, count):
            if (j + 1) % count == i:
                continue
            apart = side(start[i], end[i], start[j]) != side(start[i], end[i], end[j])
            if apart and side(start[j], end[j], start[i]) != side(start[j], end[j], end[i]):
                crossed[[i, j]] = True
    return crossed, np.linalg.norm(end - start, axis=1)


@pytest.mark.parametrize("columns", [25, 48, 101])
def test_share_is_the_area_of_the_crossing_quadrilaterals(columns):
    curve = limacon(columns)
    crossed, lengths = crossing_segments(curve)
    assert crossed.sum() == 2
    expected = lengths[crossed].sum() / lengths.sum()
    assert self_crossing_share(extruded(curve)) == pytest.approx(expected, rel=1e-12)


def test_share_does_not_depend_on_position_orientation_or_scale():
    surface = extruded(limacon(40))
    share = self_crossing_share(surface)
    turned = np.einsum("ij,jrc->irc", rotation([1, 2, 3], 0.7), 1e-3 * surface)
    assert self_crossing_share(turned + 5e-3) == pytest.approx(share, rel=1e-9)
    assert self_crossing_share(np.roll(surface, 11, axis=2)) == pytest.approx(share, rel=1e-12)


def test_a_cylinder_does_not_cross_itself():
    t = 2 * np.pi * np.arange(50) / 50
    assert self_crossing_share(extruded(np.array([np.cos(t), np.sin(t)]))) == 0.0


@pytest.mark.parametrize("gap", [1e-2, 1e-6])
def test_layers_that_nearly_touch_do_not_cross(gap):
    t = 2 * np.pi * np.arange(50) / 50
    assert self_crossing_share(extruded(np.array([np.cos(t), gap * np.sin(t)]))) == 0.0


def finger(depth, columns=48, rows=19):
    """Cylinder of radius 1 with a dent pushed along -x, narrow enough to reach the far wall."""
    t = 2 * np.pi * np.arange(columns) / columns
    surface = extruded(np.array([np.cos(t), np.sin(t)]), rows, height=2.0)
    angle = (t + np.pi) % (2 * np.pi) - np.pi
    bump = np.exp(-((angle / 0.2) ** 2) - ((surface[2] - 1.0) / 0.3) ** 2)
    surface[0] -= depth * bump
    return surface


def test_a_dent_crosses_only_where_it_passes_the_far_wall():
    assert self_crossing_share(finger(1.9)) == 0.0
    shallow, deep = self_crossing_share(finger(2.1)), self_crossing_share(finger(2.6))
    assert 0 < shallow < deep < 0.2


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_points_that_are_not_finite_are_refused(number):
    """Their cell would lie outside the table of cells."""
    surface = extruded(limacon(40))
    surface[1, 2, 3] = number
    with pytest.raises(ValueError, match="not finite"):
        self_crossing_share(surface)
