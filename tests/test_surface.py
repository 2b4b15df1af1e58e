"""Crumpled shapes from elsewhere: what they become, and what is refused."""

import zipfile
from dataclasses import replace

import meshio
import numpy as np
import pytest
from conftest import DIAMETER, FEP, FOIL, THICKNESS, cylinder, rotation

from foilstudy.export.contents import surface_grid
from foilstudy.measure.dynamics.reductions.hintz_herting import HintzHerting
from foilstudy.measure.stiffness import InterfaceSystem, Rings, condense, fixed_stiffness
from foilstudy.model.patch import knot_points
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import stress_free_stiffness
from foilstudy.pipeline.structures import stress_free_structure
from foilstudy.pipeline.surface import Limits, SurfaceGrid, read_grid, sheet_from_grid
from foilstudy.pipeline.surface.fit import fitted_patch
from foilstudy.pipeline.surface.rings import fitted_circle

RADIUS, HEIGHT = DIAMETER / 2, 0.13
DEPTH = 4e-3


def dented(rows, columns, depth=DEPTH):
    """Smoothly dented cylinder, upright at its rings; shape (rows, columns, 3)."""
    angle = 2 * np.pi * np.arange(columns) / columns
    share = np.linspace(0, 1, rows)[:, None]
    envelope = np.sin(np.pi * share) ** 2
    radius = RADIUS + depth * envelope * np.sin(4 * angle + 5 * share)
    height = HEIGHT * share + 0 * angle
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=2)


def static(crumple):
    return stress_free_stiffness(crumple)


def sheet(points, **options):
    return sheet_from_grid(points, THICKNESS, FEP, **options)


@pytest.fixture(scope="module")
def own(coarse_crumple):
    """The coarse crumple as a study has it."""
    model = coarse_crumple.sheet
    return Shape(FOIL, model.patch, coarse_crumple.points, model.reference, model.element)


# --- what a grid becomes -------------------------------------------------------------------------


def test_shape_of_our_own_comes_back_with_its_static_and_dynamic_stiffness(own):
    """Two points per element determine the spline; element length and mass are measured on it."""
    back = sheet(SurfaceGrid(surface_grid(own.points), 2))
    np.testing.assert_allclose(static(back), static(own), rtol=3e-4)
    ours, theirs = (
        HintzHerting(400.0).reduce(stress_free_structure(crumple)) for crumple in (back, own)
    )
    np.testing.assert_allclose(ours.clamped_modes(6)[0], theirs.clamped_modes(6)[0], rtol=1e-3)


def test_fewer_points_cost_accuracy_like_a_coarser_mesh(own):
    """Every knot of ever finer meshes of one shape: the stiffness tends to that of the shape."""
    fine, errors = own, []
    for _ in range(2):
        read = sheet(np.moveaxis(knot_points(fine.points), 0, 2))
        errors.append(np.abs(static(read) / static(fine) - 1).max())
        fine = fine.refined()
    assert errors[1] < 0.5 * errors[0]


def test_fit_is_of_third_order_in_the_spacing_of_the_points():
    errors = []
    for number in (2, 4):
        rows, columns = 13 * number + 1, 60 * number
        _, control = fitted_patch(SurfaceGrid(dented(rows, columns)))
        # knots of the fit lie half a step beside the points around
        ours = surface_grid(control)[::2, ::2]
        exact = dented(rows, 2 * columns)[:, (np.arange(columns) * 2 - 1) % (2 * columns)]
        errors.append(np.linalg.norm(ours - exact, axis=2).max())
    assert errors[1] < errors[0] / 7.5
    assert errors[0] < 2e-5


def test_points_lie_on_the_fitted_surface():
    points = dented(27, 126)
    _, control = fitted_patch(SurfaceGrid(points))
    grid = surface_grid(control)  # element middles around are odd columns, edges along rows 0, -1
    np.testing.assert_allclose(grid[[0, -1], 1::2], points[[0, -1]], atol=1e-15)


def test_cylinder_from_points_is_as_stiff_as_the_cylinder():
    ours = cylinder(5e-3, height=HEIGHT)
    rows, columns = ours.patch.elements_along + 1, ours.patch.columns
    read = sheet(dented(rows, columns, depth=0.0))
    assert read.patch.elements_around == columns and read.patch.elements_along == rows - 1
    system = InterfaceSystem.split(ours.tangent(), Rings.of(ours.patch, ours.reference))
    np.testing.assert_allclose(static(read), fixed_stiffness(condense(system).stiffness), rtol=2e-3)


def test_mass_of_a_cylinder_is_that_of_its_foil():
    read = sheet(dented(27, 126, depth=0.0))
    mass = stress_free_structure(read).mass
    moved = np.tile([1.0, 0.0, 0.0], mass.interior.shape[0] // 3)
    rings = np.zeros(12)
    rings[[0, 6]] = 1.0
    total = moved @ (mass.interior @ moved) + 2 * moved @ (mass.coupling @ rings)
    total += rings @ mass.interface @ rings
    expected = FEP.density * THICKNESS * np.pi * DIAMETER * HEIGHT
    assert total == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize(
    "moved",
    [
        lambda p: p @ rotation([1, 2, 3], 2.0).T + [0.3, -0.2, 5.0],
        lambda p: np.roll(p, 17, axis=1),
        lambda p: np.concatenate([p, p[:, :1]], axis=1),  # closed by repeating the first column
    ],
    ids=["moved and turned", "another first column", "first column repeated"],
)
def test_stiffness_depends_on_the_shape_alone(moved):
    points = dented(27, 63)
    np.testing.assert_allclose(static(sheet(moved(points))), static(sheet(points)), rtol=1e-7)


@pytest.mark.parametrize(
    "turned", [lambda p: p[:, ::-1], lambda p: p[::-1]], ids=["clockwise", "from the top"]
)
def test_direction_of_counting_changes_nothing(turned):
    """But for which points become knots: to the error of the fit."""
    points = dented(27, 63)
    np.testing.assert_allclose(static(sheet(turned(points))), static(sheet(points)), rtol=1e-6)


def test_frame_is_the_ring_axis_with_the_first_ring_at_the_origin():
    points = dented(27, 63) @ rotation([1, 0, 0], 1.0).T + 1.0
    crumple = sheet(points)
    edges = surface_grid(crumple.points)[[0, -1]]
    np.testing.assert_allclose(edges[..., 2], [[0.0], [HEIGHT]] * np.ones(2 * 63), atol=1e-12)
    np.testing.assert_allclose(np.hypot(edges[..., 0], edges[..., 1]), RADIUS, rtol=1e-4)
    assert crumple.foil.gap_height == pytest.approx(HEIGHT, rel=1e-9)


def test_circle_is_found_in_space():
    points = dented(3, 40)[0] @ rotation([3, 1, 2], 0.7).T + [1, 2, 3]
    circle = fitted_circle(points)
    assert circle.radius == pytest.approx(RADIUS, rel=1e-12)
    assert circle.deviation < 1e-12
    np.testing.assert_allclose(circle.centre, [1, 2, 3], atol=1e-12)
    axis = rotation([3, 1, 2], 0.7)[:, 2]
    assert abs(circle.normal @ axis) == pytest.approx(1.0, rel=1e-12)


# --- what is refused -----------------------------------------------------------------------------


def with_point(row, column, value):
    points = dented(27, 63)
    points[row, column] = value
    return points


def squeezed_ring():
    points = dented(27, 63)
    points[-1, :, 0] *= 1.05
    return points


def tilted_ring():
    """The upper ring turned by two degrees, the foil below it following."""
    points = dented(27, 63)
    share = (points[:, :, 2] / HEIGHT) ** 4
    points[:, :, 2] += share * np.tan(np.radians(2.0)) * points[:, :, 0]
    return points


def scrambled_columns():
    """Every second column, then the others: still circles, twice around."""
    return dented(27, 63)[:, (2 * np.arange(63)) % 63]


def folded_back():
    """Rows that go up, back down inside and up again, as if drawn with overlap in one surface."""
    points = dented(40, 63, depth=0.0)
    steps = np.where((np.arange(39) >= 15) & (np.arange(39) < 22), -1.0, 1.0)
    points[:, :, 2] = np.concatenate([[0.0], np.cumsum(steps)])[:, None] * HEIGHT / steps.sum()
    return points


def crossing():
    """Two waves whose slope turns by 150 degrees to either side, so that their flanks meet."""
    points = dented(100, 126, depth=0.0)
    step, wave = 1e-3, np.arange(99)
    slope = np.where((wave >= 30) & (wave < 70), np.radians(150) * np.sin(np.pi * wave / 10), 0.0)
    radius = RADIUS + np.concatenate([[0.0], np.cumsum(step * np.sin(slope))])
    points[..., :2] *= (radius / RADIUS)[:, None, None]
    points[..., 2] = np.concatenate([[0.0], np.cumsum(step * np.cos(slope))])[:, None]
    return points


def coinciding():
    """Two neighbours in one place, in two rows."""
    points = dented(27, 63)
    points[10:12, 5] = points[10:12, 6] = points[10:12, 5:7].mean(axis=1)
    return points


REFUSED = {
    "a number missing": (with_point(3, 5, np.nan), "not finite, the first in row 3, column 5"),
    "three rows": (dented(3, 63), "3 rows and 63 columns"),
    "few columns": (dented(27, 12), "27 rows and 12 columns"),
    "coordinates first": (np.moveaxis(dented(27, 63), 2, 0), r"shape \(rows, columns, 3\)"),
    "a flat list": (dented(27, 63).reshape(-1, 3), r"shape \(rows, columns, 3\)"),
    "text": (np.full((27, 63, 3), "1.0"), "array of numbers"),
    "open mesh": (dented(27, 63)[:, :50], "the grid is open"),
    "transposed": (dented(63, 63).transpose(1, 0, 2), "the grid is open.*transpose"),
    "read column by column": (
        dented(27, 63).transpose(1, 0, 2).reshape(27, 63, 3), "the grid is open|row by row"
    ),
    "rows in another order": (
        dented(27, 63)[np.r_[0, np.random.default_rng(0).permutation(25) + 1, 26]], "row by row"
    ),
    "columns in another order": (scrambled_columns(), "times as long as the circumference"),
    "a point far out": (with_point(10, 9, [0.3, 0, 0.05]), "neighbours .* are .* m apart"),
    "oval ring": (squeezed_ring(), "the last row is not a plane circle"),
    "tilted ring": (tilted_ring(), "no common axis"),
    "millimetres": (1e3 * dented(27, 63), "give the points in metres"),
    "folded back": (folded_back(), "cells of the grid are (turned over|folded back)"),
    "degenerate cells": (coinciding(), "cells of the grid are degenerate"),
    "crossing itself": (crossing(), "crosses itself on"),
}  # fmt: skip


@pytest.mark.parametrize(("points", "reason"), REFUSED.values(), ids=REFUSED)
def test_grid_is_refused_with_a_reason(points, reason):
    with pytest.raises(ValueError, match=reason) as refusal:
        sheet(points)
    assert str(refusal.value).endswith((".", ")."))


def test_limits_can_be_widened():
    points = squeezed_ring()
    wide = Limits(ring=0.05)
    assert sheet(points, limits=wide).patch.elements_around == 63


def test_thickness_in_another_unit_is_refused():
    with pytest.raises(ValueError, match="give it in metres"):
        sheet_from_grid(dented(27, 63), 0.5, FEP)


def test_elements_must_divide_the_grid():
    with pytest.raises(ValueError, match="2 grid cells per element do not divide 63 cells"):
        sheet(SurfaceGrid(dented(27, 63), 2))


@pytest.mark.parametrize("turns", [1, 7, 12])
def test_the_first_column_may_be_anywhere_on_an_element(own, turns):
    grid = surface_grid(own.points)
    expected = static(sheet(SurfaceGrid(grid, 2)))
    turned = sheet(SurfaceGrid(np.roll(grid, turns, axis=1), 2))
    np.testing.assert_allclose(static(turned), expected, rtol=1e-6)


def test_rows_that_begin_within_an_element_are_noticed(own):
    grid = surface_grid(own.points)
    with pytest.raises(ValueError, match="first row lies in the middle of an element"):
        sheet(SurfaceGrid(grid[1:-1], 2))
    sheet(SurfaceGrid(dented(53, 126), 2))  # points of no spline know no element


def test_masked_points_are_refused():
    points = np.ma.masked_array(dented(27, 63))
    points[4, 5] = np.ma.masked
    with pytest.raises(ValueError, match="3 numbers of the grid are masked; fill the gaps"):
        sheet(points)
    assert sheet(np.ma.masked_array(dented(27, 63))).patch.elements_around == 63


@pytest.mark.parametrize(
    ("unit", "words"),
    [(1e3, "times 0.001 if they are in millimetres"), (1e3 / 25.4, "times 0.0254 if .* in inches")],
)
def test_a_unit_that_would_do_is_suggested(unit, words):
    with pytest.raises(ValueError, match=f"give the points in metres: .*{words}"):
        sheet(10 * unit * dented(27, 63))


@pytest.mark.parametrize(
    ("points", "option"), [(folded_back(), "folded_share"), (crossing(), "crossing_share")]
)
def test_a_shape_with_faults_is_analysed_on_request_and_says_so(points, option):
    with pytest.raises(ValueError, match=rf"limits=Limits\({option}=") as refusal:
        sheet(points)
    share = float(str(refusal.value).split(f"{option}=")[1].split(")")[0])
    wide = {"folded_share": 1.0, "crossing_share": 1.0} | {option: share}
    crumple = sheet(points, limits=Limits(**wide))
    assert 0 < getattr(crumple.faults, option) <= share
    assert "% of the" in crumple.message
    assert np.isfinite(static(crumple)).all()
    assert sheet(dented(27, 63)).message == ""


# --- files ---------------------------------------------------------------------------------------


def test_numpy_archive_is_read(tmp_path):
    points = dented(27, 64)
    np.savez(tmp_path / "scan.npz", points=points)
    np.testing.assert_array_equal(read_grid(tmp_path / "scan.npz").points, points)
    assert sheet(tmp_path / "scan.npz").patch.elements_along == 26


def test_endings_may_be_upper_case(tmp_path):
    points = dented(27, 64)
    np.savez(tmp_path / "scan.npz", points=points)
    (tmp_path / "scan.npz").rename(tmp_path / "SCAN.NPZ")
    np.testing.assert_array_equal(read_grid(tmp_path / "SCAN.NPZ").points, points)
    vtk_file(tmp_path / "solver.vtu", points).rename(tmp_path / "SOLVER.VTU")
    np.testing.assert_array_equal(read_grid(tmp_path / "SOLVER.VTU", 64).points, points)


def test_a_file_that_declares_too_much_is_refused_before_room_is_made(tmp_path):
    path = tmp_path / "bomb.npz"
    with zipfile.ZipFile(path, "w") as archive, archive.open("points.npy", "w") as file:
        shape = {"descr": "<f8", "fortran_order": False, "shape": (1_000_000, 1_000_000, 3)}
        np.lib.format.write_array_header_1_0(file, shape)
    with pytest.raises(ValueError, match="bomb.npz: says that it has 1000000000000 points"):
        read_grid(path)
    path = vtk_file(tmp_path / "bomb.vtu", dented(27, 64))
    text = path.read_bytes().replace(b'NumberOfPoints="1728"', b'NumberOfPoints="99999999999"')
    path.write_bytes(text)
    with pytest.raises(ValueError, match="bomb.vtu: says that it has 99999999999 points"):
        read_grid(path)


def test_lz4_is_named(tmp_path):
    path = vtk_file(tmp_path / "lz4.vtu", dented(27, 64))
    path.write_bytes(path.read_bytes().replace(b"vtkZLibDataCompressor", b"vtkLZ4DataCompressor"))
    assert b"LZ4" in path.read_bytes()
    with pytest.raises(ValueError, match="lz4.vtu: is compressed by LZ4.*save it with ZLib"):
        read_grid(path)


def vtk_file(path, points, **point_data):
    rows, columns, _ = points.shape
    index = np.arange(rows * columns).reshape(rows, columns)
    right = np.roll(index, -1, axis=1)
    quads = np.stack([index[:-1], right[:-1], right[1:], index[1:]], axis=-1).reshape(-1, 4)
    meshio.Mesh(points.reshape(-1, 3), [("quad", quads)], point_data=point_data).write(path)
    return path


def test_vtk_file_of_another_program_needs_the_length_of_its_rows(tmp_path):
    points = dented(27, 64)
    path = vtk_file(tmp_path / "solver.vtu", points)
    with pytest.raises(ValueError, match="give columns="):
        read_grid(path)
    grid = read_grid(path, columns=64)
    np.testing.assert_array_equal(grid.points, points)
    assert grid == replace(grid, points_per_element=1)
    with pytest.raises(ValueError, match="do not make rows of 50"):
        read_grid(path, columns=50)


def test_vtk_file_says_itself_how_long_its_rows_are(tmp_path):
    points = dented(27, 64)
    path = vtk_file(tmp_path / "own.vtu", points, column=np.tile(np.arange(64), 27))
    np.testing.assert_array_equal(read_grid(path).points, points)
    mixed = vtk_file(tmp_path / "mixed.vtu", points, column=np.repeat(np.arange(64), 27))
    with pytest.raises(ValueError, match="not in the order"):
        read_grid(mixed)


@pytest.mark.parametrize(
    ("name", "content", "reason"),
    [
        ("scan.stl", b"solid", "a surface is read from .npz or .vtu"),
        ("scan.npz", b"no archive", "cannot be read as a NumPy archive"),
        ("scan.vtu", b"<VTKFile", "cannot be read as a VTK file"),
        ("missing.npz", None, "there is no such file"),
    ],
)
def test_unreadable_file_is_refused_by_name(tmp_path, name, content, reason):
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(ValueError, match=f"{name}: .*{reason}"):
        read_grid(tmp_path / name)


def test_archive_without_points_names_what_it_has(tmp_path):
    np.savez(tmp_path / "scan.npz", xyz=dented(27, 63))
    with pytest.raises(ValueError, match="no array 'points' but xyz"):
        read_grid(tmp_path / "scan.npz")
