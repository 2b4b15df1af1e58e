"""Every figure draws what it should from ordinary, tiny and failed studies, reproducibly."""

from __future__ import annotations

import subprocess
import sys
from xml.etree import ElementTree

import matplotlib.text
import numpy as np
import pytest
from PIL import Image
from synthetic import (
    COARSE,
    FAILED,
    MODES_PER_HZ,
    make_cube,
    write_crumple,
    write_cube,
    write_response,
)

from foilstudy.model.patch import Patch, cylinder_control_points
from foilstudy.plot.crumples import (
    Surface,
    catalogue,
    read_history,
    read_shape,
    typical_configuration,
)
from foilstudy.plot.render import View, render
from foilstudy.plot.save import inches_wide
from foilstudy.plot.style import spread
from foilstudy.present.figures import FIGURES, draw_figure, draw_figures
from foilstudy.present.files import StudyFiles

CUBE_FIGURES = [name for name, spec in FIGURES.items() if spec.needs == ("cube",)]
SHAPE_FIGURES = [name for name, spec in FIGURES.items() if spec.needs == ("crumple_paths",)]
MODE_FIGURES = [name for name, spec in FIGURES.items() if "response_paths" in spec.needs]


def scatter(overlength, direction):
    return 0.1 + 1e-3 * overlength


@pytest.fixture(scope="module")
def crumple_paths(tmp_path_factory):
    folder = tmp_path_factory.mktemp("crumples")
    return [
        write_crumple(folder / "a.nc", 500, 170, 1, element_mm=10),
        write_crumple(folder / "b.nc", 500, 170, 0, element_mm=10),
        write_crumple(folder / "c.nc", 50, 135, 0, status="failed"),
    ]


def panels(figure):
    """Axes that show data: finite points of a line, areas, bars or a picture."""

    def shows_data(ax):
        lines = any(np.isfinite(np.asarray(line.get_ydata(), float)).any() for line in ax.lines)
        return ax.axison and (lines or ax.collections or ax.patches or ax.images)

    return [ax for ax in figure.axes if shows_data(ax)]


def colour_spread(image):
    """Largest difference between the channels of a dot of a picture."""
    return np.ptp(np.asarray(image.convert("RGB"), int), axis=-1).max()


def texts(figure):
    return " ".join(t.get_text().replace("\n", " ") for t in figure.findobj(matplotlib.text.Text))


def test_every_figure_takes_the_cube_or_records():
    assert set(CUBE_FIGURES) | set(SHAPE_FIGURES) | set(MODE_FIGURES) == set(FIGURES)
    for spec in FIGURES.values():
        assert spec.title and spec.caption.endswith(".")


def test_registry_does_not_import_matplotlib():
    code = (
        "import sys, foilstudy.present.figures; "
        "assert not {'matplotlib', 'xarray'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


LABELS = {
    "stiffness_axial": (2, "overlength (%)", "axial stiffness (N/m)"),
    "stiffness_radial": (2, "overlength (%)", "radial stiffness (N/m)"),
    "prestressed": (4, "overlength (%)", "axial stiffness (N/m)"),
    "mesh_error": (2, "overlength (%)", "stated mesh error (%)"),
    "stiffness_map": (3, "overlength (%)", "thickness (µm)"),
    "fit_quality": (4, "overlength (%)", "stiffness (N/m)"),
    "variability": (2, "overlength (%)", "coefficient of variation"),
    "dynamic_stiffness": (4, "frequency (Hz)", "axial |k| (N/m)"),
    "design_chart": (5, "overlength", "thickness"),
    "transmissibility": (4, "frequency (Hz)", "payload over floor (dB)"),
    "convergence_high_frequency": (6, "frequency (Hz)", "axial |k| over\nmean of overlengths"),
    "eigenfrequency_law": (1, "reference height (mm)", "first eigenfrequency (Hz)"),
    "modal_density": (2, "frequency (Hz)", "modes per Hz"),
    "energy": (2, "overlength (%)", "share of strain energy (%)"),
}
"""Panels with data, colour bars among them, of two thicknesses; labels of their axes."""


@pytest.mark.parametrize("name", CUBE_FIGURES)
def test_cube_figure_shows_data_in_every_panel_and_says_what(name):
    sweep = {"thickness_um": (50.0, 500.0), "reference_height_mm": (135.0, 170.0, 250.0)}
    figure = FIGURES[name].draw(cube=make_cube(cv=scatter, seeds=2, **sweep))
    count, across, upwards = LABELS[name]
    shown = panels(figure)
    assert len(shown) == count
    assert across in [ax.get_xlabel() for ax in shown]
    assert shown[0].get_ylabel() == upwards
    assert "nan" not in texts(figure).split()


@pytest.mark.parametrize("name", CUBE_FIGURES)
def test_figure_of_a_single_realisation_shows_it_or_says_why_not(name):
    sweep = {"thickness_um": (500.0,), "reference_height_mm": (170.0,)}
    figure = FIGURES[name].draw(cube=make_cube(seeds=1, **sweep))
    reasons = ("two overlengths", "two usable", "two seeds", "fewer", "too few", "needs")
    assert panels(figure) or any(reason in texts(figure) for reason in reasons), texts(figure)
    assert "nan" not in texts(figure).split()


@pytest.mark.parametrize("shape", [(1, 3), (1, 4), (4, 1)], ids=str)
@pytest.mark.parametrize("name", CUBE_FIGURES)
def test_figure_of_one_row_of_cells_is_drawn(name, shape):
    thicknesses, heights = (50.0, 130.0, 250.0, 500.0), (135.0, 150.0, 170.0, 250.0)
    sweep = {"thickness_um": thicknesses[: shape[0]], "reference_height_mm": heights[: shape[1]]}
    figure = FIGURES[name].draw(cube=make_cube(seeds=1, **sweep))
    figure.canvas.draw()
    assert "nan" not in texts(figure).split()


@pytest.mark.parametrize("name", CUBE_FIGURES)
def test_figure_of_a_study_without_a_usable_cell_says_so(name):
    cube = make_cube((500.0,), (170.0,), seeds=1, verdicts={(0, 0, 0): FAILED})
    assert "usable" in texts(FIGURES[name].draw(cube=cube))


@pytest.mark.parametrize("name", SHAPE_FIGURES)
def test_figure_without_any_shape_says_so(name, tmp_path):
    path = write_crumple(tmp_path / "failed.nc", 500, 170, 0, status="diverged")
    figure = FIGURES[name].draw(crumple_paths=[path])
    assert "diverged" in texts(figure) or "no usable realisation" in texts(figure)


def test_morphology_shows_the_first_shape_of_each_configuration_and_why_one_is_missing(
    crumple_paths,
):
    figure = FIGURES["morphology"].draw(crumple_paths=crumple_paths)
    (picture,) = [image for ax in figure.axes for image in ax.images]
    shape = read_shape(catalogue(crumple_paths)[1])
    width = 2e3 * np.hypot(*shape.control_points[:2]).max()
    left, right, *_ = picture.get_extent()
    assert right - left == pytest.approx(width, rel=0.1)
    assert "failed: the ring force is not finite" in texts(figure)
    assert "overlength 31 %" in texts(figure) and "50 µm" in texts(figure)


def test_seeds_stand_side_by_side(crumple_paths):
    figure = FIGURES["seeds"].draw(crumple_paths=crumple_paths)
    assert sum(len(ax.images) for ax in figure.axes) == 2
    assert "seed 0" in texts(figure) and "seed 1" in texts(figure)


def test_history_shows_the_columns_of_the_record(crumple_paths):
    figure = FIGURES["history"].draw(crumple_paths=crumple_paths)
    crumple = typical_configuration(catalogue(crumple_paths))[0]
    history = read_history(crumple)
    height, force, energy, residual = figure.axes
    np.testing.assert_allclose(height.lines[-1].get_ydata(), 1e3 * history["height"])
    np.testing.assert_allclose(force.lines[-1].get_ydata(), history["reaction_force"])
    assert {text.get_text() for text in energy.texts} >= {"bending", "membrane", "kinetic"}
    assert residual.get_yscale() == "log" and residual.get_xlabel() == "step"


def test_same_figure_gives_the_same_bytes(tmp_path):
    cube = make_cube(thickness_um=(50.0, 500.0), seeds=2, cv=scatter)
    files = StudyFiles(write_cube(cube, tmp_path / "cube.nc"))
    first = draw_figure("variability", files, tmp_path / "new" / "a")
    again = draw_figure("variability", files, tmp_path / "new" / "b")
    assert [p.name for p in first] == ["a.png", "a.svg"]
    assert [p.read_bytes() for p in first] == [p.read_bytes() for p in again]
    assert len(list((tmp_path / "new").iterdir())) == 4


def test_unknown_figure_is_named():
    with pytest.raises(KeyError, match="no figure 'nothing': choose one of morphology"):
        draw_figure("nothing", StudyFiles("cube.nc"), "stem")


def test_draw_figures_writes_a_picture_and_a_drawing_of_each(crumple_paths, tmp_path):
    cube_path = write_cube(make_cube(cv=scatter, seeds=2), tmp_path / "cube.nc")
    files = StudyFiles(cube_path, crumple_paths)
    paths = draw_figures(["energy", "seeds"], files, tmp_path)
    assert [path.name for path in paths] == ["energy.png", "energy.svg", "seeds.png", "seeds.svg"]
    for png, svg in zip(paths[::2], paths[1::2], strict=True):
        root = ElementTree.parse(svg).getroot()
        inches = float(root.get("width").removesuffix("pt")) / 72
        with Image.open(png) as picture:
            assert picture.mode == "P"  # a palette
            assert picture.width == pytest.approx(inches * 150, abs=1)
            assert colour_spread(picture) > 100  # and yet in colour
        assert inches_wide(png) == pytest.approx(inches, rel=1e-2)


def test_stiffness_figure_shows_mean_fit_and_published_law():
    cube = make_cube(cv=scatter, seeds=3)
    figure = FIGURES["stiffness_axial"].draw(cube=cube)
    ax = figure.axes[-1]
    lines = {line.get_label(): line for line in ax.get_lines()}
    dashed = lines["published simulation (fit)"]
    # The published fit at 500 um and 30.8 %.
    at = np.interp(np.log(400 / 13), np.log(dashed.get_xdata()), np.log(dashed.get_ydata()))
    assert np.exp(at) == pytest.approx(10807, rel=1e-3)
    cube["static_stiffness_mesh_error"][:] = 0.2 * cube["static_stiffness_converged"]
    ax = FIGURES["stiffness_axial"].draw(cube=cube).axes[-1]
    bars = {c.get_label(): c for c in ax.containers}["mesh limit, bar: stated error"]
    limit = cube["static_stiffness_converged"].sel(thickness=500, direction="axial").mean("seed")
    np.testing.assert_allclose(bars.lines[0].get_ydata(), limit)
    ends = np.array([segment[:, 1] for segment in bars.lines[2][0].get_segments()])
    np.testing.assert_allclose(ends, limit.values[:, None] * [[0.8, 1.2]])


def test_prestressed_figure_shows_medians_and_marks_what_is_not_positive():
    cube = make_cube(cv=scatter, seeds=3, relaxed_again=True)
    cube["prestressed_stiffness"][3, 0, 0, 0] = -40.0
    cube["prestressed_stiffness"][3, 1, :, 0] = -40.0
    figure = FIGURES["prestressed"].draw(cube=cube)
    thickest = figure.axes[3]  # axial, 500 um
    bars = {container.get_label(): container for container in thickest.containers}
    assert set(bars) == {
        "stress-free, mesh limit",
        "pre-stressed, crumpled mesh",
        "pre-stressed, relaxed again",
    }
    median = cube["prestressed_stiffness"].sel(thickness=500, direction="axial").median("seed")
    drawn = bars["pre-stressed, crumpled mesh"].lines[0].get_ydata()
    np.testing.assert_allclose(drawn, median[[0, 2, 3, 4]])
    assert [t.get_text() for t in thickest.texts] == ["≤ 0", "1", "3"]
    assert not figure.axes[2].texts


def test_prestressed_figure_survives_a_median_below_every_positive_value():
    cube = make_cube(thickness_um=(500.0,), reference_height_mm=(170.0,), seeds=2)
    cube["prestressed_stiffness"][0, 0, :, 0] = [-5.0, 11.0]
    (axial, _) = FIGURES["prestressed"].draw(cube=cube).axes
    bottom, top = axial.get_ylim()
    assert 0 < bottom < 11 < top


def test_mesh_error_figure_shows_the_stated_relative_error():
    cube = make_cube(seeds=3)
    cube["static_stiffness_mesh_error"][:] = 0.05 * cube["static_stiffness_converged"]
    ax = FIGURES["mesh_error"].draw(cube=cube).axes[0]
    assert len(ax.containers) == 4
    for container in ax.containers:
        np.testing.assert_allclose(container.lines[0].get_ydata(), 5.0)


@pytest.mark.parametrize("name", ["prestressed", "mesh_error"])
def test_figure_of_a_cube_without_its_quantity_says_what_is_missing(name):
    cube = make_cube(seeds=2)
    cube["static_stiffness_mesh_error"][:] = np.nan
    figure = FIGURES[name].draw(cube=cube.drop_vars("prestressed_stiffness"))
    missing = {"prestressed": "pre-stressed stiffness", "mesh_error": "mesh error"}[name]
    assert missing in texts(figure)


def test_dynamic_stiffness_figure_takes_every_definition():
    from foilstudy.present.figures import dynamic_stiffness

    cube = make_cube(thickness_um=(500.0,), reference_height_mm=(170.0,), seeds=2, cv=scatter)
    for definition in cube["definition"].values:
        figure = dynamic_stiffness.draw(cube, str(definition))
        median = (
            np.abs(cube["dynamic_stiffness"])
            .sel(definition=definition, direction="axial")
            .median("seed")
            .squeeze()
        )
        np.testing.assert_allclose(figure.axes[0].get_lines()[0].get_ydata(), median)


def test_modal_density_figure_shows_the_density_and_that_of_a_plate():
    cube = make_cube(thickness_um=(50.0, 500.0), seeds=3, case=COARSE)
    thin, thick = FIGURES["modal_density"].draw(cube=cube).axes[:2]
    curve = next(line for line in thin.get_lines() if line.get_label() == "92 %")
    top = curve.get_xdata() > 300
    np.testing.assert_allclose(curve.get_ydata()[top], MODES_PER_HZ, rtol=0.03)
    assert "flat plate" in texts(thin) and "under 4 elements" in texts(thin)
    assert "under 4 elements" not in texts(thick)  # their waves are longer
    plates = sorted(line.get_ydata()[0] for line in thick.get_lines()[-2:])
    assert plates[1] / plates[0] == pytest.approx(250 / 135)


@pytest.mark.parametrize("name", ["modal_density", "convergence_high_frequency"])
def test_modal_figures_of_an_older_cube_need_no_counts_and_no_configuration(name):
    cube = make_cube(seeds=2, cv=scatter).drop_vars("mode_count").assign_attrs(config="")
    figure = FIGURES[name].draw(cube=cube)
    assert "plate" not in texts(figure)


def test_convergence_figure_marks_where_the_overlengths_become_one_curve():
    cube = make_cube(thickness_um=(500.0,), seeds=6, cv=lambda overlength, direction: 0.2)
    curves = np.abs(cube["dynamic_stiffness"])
    mean = np.exp(np.log(curves).mean(["overlength", "seed"]))
    deviation = np.log(curves / curves.mean("seed"))
    apart = np.log(cube["overlength"] / 30) * (cube["frequency"] < 100)
    cube["dynamic_stiffness"] = (mean * np.exp(deviation + apart)).transpose(*curves.dims) + 0j
    figure = FIGURES["convergence_high_frequency"].draw(cube=cube)
    (mark,) = [text.get_text() for text in figure.axes[0].texts]
    # The octave about it holds nothing from below 100 Hz.
    assert float(mark.removesuffix(" Hz ")) == pytest.approx(100 * 2**0.5, rel=0.12)


def write_modes(folder, thickness, seed, shapes):
    crumple = write_crumple(folder / f"{thickness}_{seed}" / "crumple.nc", thickness, 170, seed)
    return crumple, write_response(crumple, shapes)


def test_mac_figure_compares_two_seeds_of_the_thinnest_and_the_thickest_foil(tmp_path):
    rng = np.random.default_rng(3)
    shapes = rng.standard_normal((4, 3, 6, 12))
    pairs = [
        *(write_modes(tmp_path, 50, seed, shapes[[0, 1, 2]]) for seed in (0, 1)),
        *(write_modes(tmp_path, 250, seed, shapes[[0, 1, 2]]) for seed in (0, 1)),
        write_modes(tmp_path, 500, 0, shapes[[0, 1]]),
        write_modes(tmp_path, 500, 2, -5 * shapes[[1, 0]]),
    ]
    crumples, responses = zip(*pairs)
    figure = FIGURES["mac_seeds"].draw(crumple_paths=crumples, response_paths=responses)
    thin, thick = (np.asarray(ax.images[0].get_array()) for ax in figure.axes[:2])
    np.testing.assert_allclose(np.diag(thin), 1)
    np.testing.assert_allclose(np.fliplr(thick).diagonal(), 1)
    assert "mode of seed 2" in texts(figure) and "60 Hz" in texts(figure)
    assert "median 1.00, highest 1.00" in texts(figure)


def test_mac_figure_of_a_study_without_mode_shapes_says_so(tmp_path):
    pairs = [write_modes(tmp_path, 500, seed, None) for seed in (0, 1)]
    crumples, responses = zip(*pairs)
    for paths in (responses, ()):
        figure = FIGURES["mac_seeds"].draw(crumple_paths=crumples, response_paths=paths)
        assert "mode shapes of two seeds" in texts(figure)
    failed = write_crumple(tmp_path / "failed.nc", 500, 170, 0, status="failed")
    figure = FIGURES["mac_seeds"].draw(crumple_paths=[failed], response_paths=[])
    assert "no usable realisation" in texts(figure)


def test_catalogue_is_sorted_and_knows_failures(crumple_paths):
    crumples = catalogue(crumple_paths)
    assert [(c.thickness_um, c.seed, c.has_shape) for c in crumples] == [
        (50, 0, False),
        (500, 0, True),
        (500, 1, True),
    ]
    assert [c.seed for c in typical_configuration(crumples)] == [0, 1]


def test_picture_of_a_straight_cylinder_has_its_true_outline():
    patch = Patch.for_cylinder(0.2, 0.13, 5e-3)
    picture = render(Surface(cylinder_control_points(patch, 0.2), 0.1), View(elevation_deg=0.0))
    solid = picture.rgba[..., 3] > 0.5
    left, right, bottom, top = picture.extent_mm
    pixel = (right - left) / solid.shape[1]
    columns, rows = solid.any(axis=0).sum() * pixel, solid.any(axis=1).sum() * pixel
    assert columns == pytest.approx(200, abs=1.5)
    assert rows == pytest.approx(130, abs=1.5)
    # No holes: seen from the side the outline is a full rectangle.
    assert solid.sum() == solid.any(axis=0).sum() * solid.any(axis=1).sum()
    # No radial displacement is the even grey of the colour map everywhere.
    colour = picture.rgba[solid][:, :3]
    assert np.ptp(colour, axis=1).max() < 0.02


def test_picture_colours_outward_red_and_inward_blue(crumple_paths):
    shape = read_shape(catalogue(crumple_paths)[1])
    for factor, channel in ((1.1, 0), (0.9, 2)):
        points = shape.control_points * np.array([factor, factor, 1.0])[:, None, None]
        picture = render(Surface(points, shape.radius), View(pixel_mm=2.0))
        mean = picture.rgba[picture.rgba[..., 3] > 0.9].mean(axis=0)
        assert np.argmax(mean[:3]) == channel


def test_spread_keeps_labels_apart_and_moves_them_least():
    np.testing.assert_allclose(spread([0.1, 0.5, 0.9], 0.1), [0.1, 0.5, 0.9])
    np.testing.assert_allclose(spread([0.5, 0.5], 0.2), [0.4, 0.6])
    moved = spread([0.0, 0.01, 0.5, 0.52, 0.53], 0.1)
    assert (np.diff(moved) > 0.1 - 1e-12).all()
