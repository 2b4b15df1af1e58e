"""The report page: complete, self-contained, true to its tables, and safe with odd studies."""

import base64
import hashlib
import html
import json
import math
import re
from html.parser import HTMLParser
from pathlib import Path

import netCDF4
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy.interpolate import RegularGridInterpolator
from synthetic import (
    CONFIG,
    make_cube,
    ten_percent,
    write_crumple,
    write_cube,
    write_response,
)

from foilstudy.base.numerals import fixed, number, percent_range
from foilstudy.base.record import read_record
from foilstudy.config import load_config
from foilstudy.present.configuration import configuration
from foilstudy.present.files import StudyFiles
from foilstudy.present.report import write_report
from foilstudy.present.report.equilibrium import assess_equilibrium, equilibrium_findings
from foilstudy.present.report.exponents import exponent_findings
from foilstudy.present.report.health import assess
from foilstudy.present.report.laws import Exponent, read_laws
from foilstudy.present.report.mesh import (
    assess_mesh,
    element_kind,
    mesh_sentence,
    share_sentence,
    stated_error_sentence,
)
from foilstudy.present.report.prestress import prestress_findings, relaxed_findings, relaxed_rows
from foilstudy.present.report.viewer import (
    MODE_NODES_MAX,
    NODES_MAX,
    choose_shapes,
    pack_mode,
    pack_shape,
    viewer_data,
)
from foilstudy.present.statistics.powerlaw import powerlaw_table
from foilstudy.present.statistics.summary import stiffness_summary
from foilstudy.present.statistics.tables import write_tables
from foilstudy.present.statistics.variability import variability_table

CONFIGS = Path(__file__).parents[1] / "config"
PIXEL = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mNk+A8AAQUBAScY42YAAAAASUVORK5CYII="
)


def noisy_cube(
    thickness_um=(50.0, 250.0, 500.0), reference_height_mm=(135.0, 170.0, 250.0), seeds=3, **more
):
    """Cube whose stiffness scatters by a tenth."""
    return make_cube(thickness_um, reference_height_mm, seeds, cv=ten_percent, **more)


def make_study(folder, cube, figures=True, crumples=()):
    """Write cube, tables and figures of a study into ``folder``."""
    files = StudyFiles(write_cube(cube, folder / "cube.nc"), tuple(crumples))
    write_tables(files.cube, folder)
    (folder / "figures").mkdir()
    if figures:
        for stem in ("stiffness_axial", "morphology", "not_in_the_registry"):
            (folder / "figures" / f"{stem}.png").write_bytes(PIXEL)
        (folder / "figures" / "stiffness_axial.svg").write_text(
            '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"></svg>'
        )
    return files


def words(page):
    """Text of the page as it is read, without tags, scripts and styles."""
    body = re.sub(r"<(script|style)\b.*?</\1>", " ", page, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body)))


def unpack(packed, name):
    """Coordinates of a packed shape in m, shape (3, rows, columns)."""
    quanta = np.frombuffer(base64.b64decode(packed[name], validate=True), dtype="<i2")
    return (
        np.moveaxis(quanta.reshape(packed["rows"], packed["columns"], 3), -1, 0) * packed["scale"]
    )


def decode_mode(packed, rows, columns):
    """A packed mode at the nodes of its shape, the largest displacement being 1."""
    quanta = np.frombuffer(base64.b64decode(packed["displacement"], validate=True), np.int8)
    grid = quanta.reshape(packed["rows"], packed["columns"], 3) / 127
    closed = np.concatenate([grid, grid[:, :1]], axis=1)
    axes = [np.linspace(0, 1, size) for size in closed.shape[:2]]
    at = np.meshgrid(np.linspace(0, 1, rows), np.arange(columns) / columns, indexing="ij")
    return np.moveaxis(RegularGridInterpolator(axes, closed)(np.stack(at, axis=-1)), -1, 0)


def section(page, name):
    """One section of the page."""
    return page.split(f'<section id="{name}">')[1].split("</section>")[0]


def first_screen(page):
    """What is read before anything else, and the laws below it."""
    return section(page, "first") + section(page, "law")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """A sound study with one cell that stopped at the step limit; files and page."""
    folder = tmp_path_factory.mktemp("study")
    crumples = [
        write_crumple(folder / f"{t:g}_{h:g}" / "crumple.nc", t, h)
        for t in (50.0, 250.0, 500.0)
        for h in (135.0, 170.0, 250.0)
    ]
    cube = noisy_cube(verdicts={(0, 2, 1): ("not_converged", "stopped at the step limit")})
    files = make_study(folder, cube, crumples=crumples)
    benchmarks = folder / "benchmarks"
    # two that count, of a cell that was taken out, of a rule that was switched off, half-written
    line = "s\th:m:s\tmax_rss\tcpu_time\n2.5\t0:00:02\t300\t2.25\n"
    kept = "t50um_h135mm_0", "t500um_h250mm_1"
    for place in (*(f"crumple/{cell}" for cell in kept), "crumple/t60um_h135mm_0",
                  f"refine/{kept[0]}", f"export/{kept[0]}"):  # fmt: skip
        (benchmarks / f"{place}.tsv").parent.mkdir(parents=True, exist_ok=True)
        (benchmarks / f"{place}.tsv").write_text(line)
    (benchmarks / "response").mkdir()
    (benchmarks / "response" / f"{kept[0]}.tsv").write_text("")
    (benchmarks / "cube.tsv").write_text("s\th:m:s\tmax_rss\tcpu_time\n0.1\t0:00:00\t-\t-\n")
    out = write_report(files, folder / "report.html")
    return files, out.read_text("utf-8")


@pytest.mark.parametrize("name", ["thesis", "resolved"])
def test_published_results_stand_beside_the_published_case_on_any_mesh(tmp_path, name):
    study = load_config(CONFIGS / f"{name}.yaml")
    cube = make_cube(
        tuple(study.sweep.thickness_um), tuple(study.sweep.reference_height_mm), 2, cv=ten_percent
    )
    files = make_study(tmp_path, cube.assign_attrs(config=study.to_yaml()))
    page = words(write_report(files, tmp_path / "report.html").read_text("utf-8"))
    for source in ("simulation", "experiment"):
        assert page.count(f"Published {source}") >= 2  # a row of the table for each direction
    assert "Structural Dynamics of Crumpled Thin Sheets" in page
    assert "nothing published" not in page
    assert f"at {study.sweep.thickness_um[-1]:g} µm (published −2.42" in page


class Resources(HTMLParser):
    """Collects what a browser would load, what the reader may follow, and open tags."""

    VOID = {"meta", "img", "input", "br", "link"}

    def __init__(self):
        super().__init__()
        self.loaded, self.followed, self.open, self.ids = [], [], [], []

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.loaded += [attrs[k] for k in ("src", "srcset", "poster", "data") if k in attrs]
        if "href" in attrs:
            (self.followed if tag == "a" else self.loaded).append(attrs["href"])
        if "id" in attrs:
            self.ids.append(attrs["id"])
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def parse(page):
    parser = Resources()
    parser.feed(page)
    assert parser.open == []
    assert len(set(parser.ids)) == len(parser.ids)
    return parser


def test_page_loads_nothing_from_elsewhere(study):
    _, page = study
    parser = parse(page)
    assert parser.loaded and all(source.startswith("data:") for source in parser.loaded)
    assert not [target for target in parser.followed if re.match(r"\w+:|//", target)]
    assert "url(" not in page and "@import" not in page and "fetch(" not in page
    anchors = {target[1:] for target in parser.followed if target.startswith("#")}
    assert anchors <= set(parser.ids)


def test_policy_admits_the_one_script(study):
    _, page = study
    script = re.search(r"<script>(.*?)</script>", page, flags=re.S)[1]
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = re.search(r'Content-Security-Policy" content="([^"]+)"', page)[1].split("; ")
    assert set(policy) == {
        "default-src 'none'",
        "img-src data:",
        "style-src 'unsafe-inline'",
        f"script-src 'sha256-{digest}'",
    }
    assert len(re.findall(r"<script>", page)) == 1


def test_images_decode_and_vector_drawings_win(study):
    _, page = study
    sources = dict(re.findall(r'<figure id="figure-(\w+)".*?<img src="([^"]+)"', page, flags=re.S))
    assert set(sources) == {"stiffness_axial", "morphology"}  # and no stray picture
    for source in sources.values():
        assert base64.b64decode(source.split(",")[1], validate=True)
    assert sources["stiffness_axial"].startswith("data:image/svg+xml")
    assert base64.b64decode(sources["morphology"].split(",")[1]) == PIXEL


def test_every_figure_enlarges_and_tells_what_it_shows(study):
    _, page = study
    figures = re.findall(r'<figure id="figure-(\w+)">(.*?)</figure>', page, flags=re.S)
    alts = {}
    for name, content in figures:
        assert 'class="enlarge"' in content
        alts[name] = html.unescape(re.search(r'alt="([^"]+)"', content)[1])
    assert (
        "The axial stiffness in the mesh limit, mean of the realisations, runs from"
        in (alts["stiffness_axial"])
    )
    assert "radial displacement runs from −20 mm" in alts["morphology"]
    assert "button.enlarge" in page and "showModal" in page


def test_shapes_decode_to_the_crumples(study):
    files, page = study
    data = json.loads(re.search(r'id="viewer-data">(.*?)</script>', page, flags=re.S)[1])
    chosen = choose_shapes(files.crumple_paths)
    assert len(data["shapes"]) == len(chosen) == 9
    assert len(base64.b64decode(data["colours"])) == 2 * 3 * 256  # of the shape and of the modes
    for packed, crumple in zip(data["shapes"], chosen, strict=True):
        values, _ = read_record(crumple.path)
        for name, variable in (("surface", "surface"), ("reference", "reference_surface")):
            points = unpack(packed, name)
            assert np.abs(points - values[variable]).max() <= 0.5001 * packed["scale"]
        assert packed["scale"] < 1e-5
        assert packed["radius"] == pytest.approx(0.1, rel=1e-3)
    assert page.count("<option>") == 9


def test_fine_mesh_is_thinned_and_keeps_its_edges(tmp_path):
    (crumple,) = choose_shapes([write_crumple(tmp_path / "crumple.nc", element_mm=1.25)])
    packed = pack_shape(crumple)
    assert packed["rows"] * packed["columns"] <= NODES_MAX < read_surface(crumple)[0].size
    points, surface = unpack(packed, "surface"), read_surface(crumple)
    np.testing.assert_allclose(points[:, [0, -1], 0], surface[:, [0, -1], 0], atol=1e-5)


def read_surface(crumple):
    values, _ = read_record(crumple.path)
    return values["surface"]


def smooth_modes(rows=9, columns=24):
    """Two smooth modes with rings at rest, shape (2, 3, rows, columns)."""
    angle = 2 * np.pi * np.arange(columns) / columns
    height = np.sin(np.pi * np.linspace(0, 1, rows))[:, None]
    waves = (2, 3)
    return np.array(
        [
            [height * np.cos(n * angle), height * np.sin(n * angle), 0.2 * height + 0 * angle]
            for n in waves
        ]
    )


def test_modes_of_the_view_decode_to_the_recorded_ones(tmp_path):
    crumple = write_crumple(tmp_path / "0" / "crumple.nc")
    other = write_crumple(tmp_path / "1" / "crumple.nc", reference_height_mm=250.0)
    shapes = 40 * smooth_modes(35, 126)  # the nodes of the shape
    write_response(crumple, shapes, [55.5, 61.0, 70.0])
    files = make_study(tmp_path / "study", noisy_cube(), figures=False, crumples=[crumple, other])
    page = write_report(files, tmp_path / "study" / "report.html").read_text("utf-8")
    parse(page)
    data = json.loads(re.search(r'id="viewer-data">(.*?)</script>', page, flags=re.S)[1])
    with_modes, without = data["shapes"]
    assert without["modes"] == []
    assert [mode["frequency"] for mode in with_modes["modes"]] == [55.5, 61.0]
    for packed, shape in zip(with_modes["modes"], shapes, strict=True):
        decoded = decode_mode(packed, with_modes["rows"], with_modes["columns"])
        expected = shape / np.linalg.norm(shape, axis=0).max()
        np.testing.assert_allclose(decoded, expected, atol=0.51 / 127)


def test_modes_on_a_fine_mesh_are_kept_on_a_coarser_grid():
    shape = smooth_modes(121, 192)[0]
    packed = pack_mode(50.0, shape)
    assert packed["rows"] * packed["columns"] <= MODE_NODES_MAX < shape[0].size
    decoded = decode_mode(packed, 121, 192)
    expected = shape / np.linalg.norm(shape, axis=0).max()
    assert np.abs(decoded - expected).max() < 0.03
    np.testing.assert_allclose(decoded[:, [0, -1]], 0, atol=1e-12)


def test_view_goes_without_modes_that_are_not_known(tmp_path):
    crumple = write_crumple(tmp_path / "crumple.nc")
    shapes = smooth_modes()
    shapes[1, 0, 0, 0] = np.nan
    response = write_response(crumple, shapes, [50.0, 60.0])
    (packed,) = viewer_data(choose_shapes([crumple]), [response])["shapes"]
    assert [mode["frequency"] for mode in packed["modes"]] == [50.0]
    response = write_response(crumple, shapes, [np.nan, np.nan])
    (packed,) = viewer_data(choose_shapes([crumple]), [response])["shapes"]
    assert packed["modes"] == []
    failed = write_crumple(tmp_path / "failed" / "crumple.nc", status="failed")
    assert viewer_data(choose_shapes([failed]), [response])["shapes"] == []


def test_script_finds_its_controls_and_asks_for_reduced_motion(study):
    _, page = study
    script = re.search(r"<script>(.*?)</script>", page, flags=re.S)[1]
    wanted = set(re.findall(r'querySelector\("\[data-act=(\w+)\]"\)', script))
    assert {"vibration", "mode", "play", "amplitude"} <= wanted
    assert wanted <= set(re.findall(r'data-act="(\w+)"', page))
    assert "prefers-reduced-motion" in script
    assert re.search(r'<p class="controls" data-act="vibration" hidden>', page)


def test_findings_on_modes_stand_by_their_figures(tmp_path):
    cube = noisy_cube()
    law = 2e6 * cube["reference_height"] ** -2.2  # without scatter
    cube["first_eigenfrequency"][:] = law.values[:, None]
    files = make_study(tmp_path, cube, figures=False)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    dynamic, modes = (
        words(page.split(f'<section id="{name}">')[1].split("</section>")[0])
        for name in ("dynamic", "eigenfrequency")
    )
    assert "Nowhere does it stay within the scatter of the seeds up to 800 Hz" in dynamic
    assert "has 0.30 modes per Hz" in modes
    assert "to the power of −2.20 ± 0.00 at 50 µm (published −2.06, outside it)" in modes


def test_damaged_shape_is_named(tmp_path):
    path = write_crumple(tmp_path / "crumple.nc")
    with netCDF4.Dataset(path, "a") as data:
        data["surface"][0, 0, 0] = 1.0
    with pytest.raises(ValueError, match="crumple.nc: holds other values than were written"):
        pack_shape(*choose_shapes([path]))


def test_first_converged_seed_is_shown(tmp_path):
    paths = [
        write_crumple(tmp_path / "0.nc", seed=0, status="diverged"),
        write_crumple(tmp_path / "1.nc", seed=1, status="not_converged"),
        write_crumple(tmp_path / "2.nc", seed=2),
    ]
    assert [shape.seed for shape in choose_shapes(paths)] == [2]


def test_first_screen_says_what_the_table_says(study):
    files, page = study
    table = pd.read_csv(files.table("powerlaw"))
    screen = first_screen(page)
    text = words(screen)
    for row in table.itertuples():
        for value, low, high in (
            (row.beta, row.beta_low, row.beta_high),
            (row.gamma, row.gamma_low, row.gamma_high),
        ):
            assert f"{fixed(value)} [{fixed(low)}, {fixed(high)}]" in text
        if row.source == "simulation mesh limit":
            margin = (row.beta_high - row.beta_low) / 2
            assert f"falls as overlength {fixed(row.beta)} ± {fixed(margin)}" in text
            margin = (row.gamma_high - row.gamma_low) / 2
            assert f"grows as thickness {fixed(row.gamma)} ± {fixed(margin)}" in text
            assert f"mesh limit; R² = {fixed(row.r2, 3)}, {row.n:.0f} realisations" in text
    assert "26 of 27 realisations converged; 1 not converged." in text
    order = (
        'class="grid"',
        'class="state"',
        'class="answer"',
        "<table id",
        "figure-stiffness_axial",
    )
    assert sorted(order, key=screen.index) == list(order)


def test_page_states_the_mesh_error(study):
    files, page = study
    cube = files.cube
    assert (
        "axial mesh error of the given shapes at most 5.0 %, scatter 10 % in the median"
        in words(section(page, "first"))
    )
    lower = 1 - (cube.static_stiffness_converged / cube.static_stiffness).sel(direction="axial")
    extent = percent_range(float(lower.min()), float(lower.max()))
    text = words(section(page, "health"))
    assert "In the mesh limit (twice refined, extrapolated to element size zero" in text
    assert f"the axial stiffness is {extent} lower" in text


def test_unmeasured_mesh_error_is_not_called_zero(study):
    files, _ = study
    cube = files.cube.assign(
        static_stiffness_converged=files.cube.static_stiffness,
        static_stiffness_mesh_error=files.cube.static_stiffness_mesh_error * np.nan,
    )
    mesh = assess_mesh(cube)
    assert mesh_sentence(mesh, {}) == "The mesh error of the stiffness was not measured."
    assert stated_error_sentence(mesh) == ""


def test_stated_mesh_error_has_median_and_largest_of_each_thickness():
    cube = noisy_cube((50.0, 500.0), (170.0,), 3)
    limit = cube["static_stiffness_converged"]
    share = np.array([0.01, 0.02, 0.06])[:, None]
    cube["static_stiffness_mesh_error"][:] = share * limit
    mesh = assess_mesh(cube)
    assert mesh.stated["axial"][50.0].median == pytest.approx(0.02)
    assert mesh.stated["radial"][500.0].highest == pytest.approx(0.06)
    text = "2.0 % (largest 6.0 %) at 50 µm, 2.0 % (largest 6.0 %) at 500 µm"
    assert f"axial {text}; radial {text}." in stated_error_sentence(mesh)


def test_finest_mesh_is_not_called_extrapolated():
    mesh = assess_mesh(noisy_cube())
    once = {"mesh": {"element": "corner"}, "stiffness": {"refinements": 1}}
    assert "(once refined, not extrapolated)" in mesh_sentence(mesh, once)
    # Cubes from before the element could be chosen hold the finest mesh's own value.
    old = {"mesh": {}, "stiffness": {"refinements": 2}}
    assert "(twice refined, not extrapolated)" in mesh_sentence(mesh, old)


def test_refinements_by_need_are_told_of_each_thickness():
    cube = noisy_cube((50.0, 500.0), (170.0,), 3)
    made = np.array([[2.0, 2.0, 2.0], [1.0, 2.0, 1.0]])[:, None]
    cube["static_refinements"] = (("thickness", "overlength", "seed"), made)
    by_need = {"mesh": {"element": "corner"}, "stiffness": {"error_percent": 5, "refinements": 2}}
    text = (
        "(refined until the stated error is at most 5 %, twice at 50 µm, once to twice at 500 µm)"
    )
    assert text in mesh_sentence(assess_mesh(cube), by_need)


def test_stabilisation_share_measures_the_mesh_of_the_one_point_element_only():
    assert "resolve the ridges" in share_sentence({"mesh": {"element": "one_point"}})
    assert share_sentence({}) == share_sentence({"mesh": {"element": "one_point"}})
    corner = share_sentence({"mesh": {"element": "corner"}})
    assert "checkerboard alone" in corner and "does not tell" in corner
    assert element_kind({}) == "one-point"


def laws_with_exponents(limit, stressed):
    """Laws of a cube whose thickness exponents move by ``limit`` and ``stressed``."""
    cube = noisy_cube()
    factor = cube["thickness"] / 250
    cube["static_stiffness_converged"] = cube["static_stiffness"] * factor**limit
    cube["prestressed_stiffness"] = cube["static_stiffness"] * factor**stressed
    return read_laws(powerlaw_table(cube), stiffness_summary(cube))


def test_thickness_exponents_are_held_against_both_published_ones():
    # Published: 1.40 and 1.60 axial; this study about 1.4.
    up, _ = exponent_findings(laws_with_exponents(0.5, -0.4))
    assert "raises it by 0.50: farther from the published simulation and the published" in up
    assert "stress in lowers it by 0.40: farther from" in up
    assert "1.40 ± 0.08 (published simulation), 1.60 ± 0.20 (published experiment)" in up
    some, _ = exponent_findings(laws_with_exponents(0.15, 0.0))
    assert "nearer to the published experiment, farther from the published simulation" in some
    assert "Leaving the stress in leaves it as it is." in some


def test_prestress_is_named(study):
    _, page = study
    text = words(page.split('<section id="prestress">')[1].split("</section>")[0])
    assert "the stiffness is 0.32 to 0.50 times in the axial direction" in text
    assert "Every pre-stressed value is positive." in text
    assert (
        "Power law with the stress left in, of all configurations on the crumpled mesh: axial β"
        in text
    )
    assert "Relaxed again" not in text


def test_negative_prestressed_values_are_counted_on_the_page(tmp_path):
    cube = noisy_cube()
    cube["prestressed_stiffness"][2, 1, :2, 1] = -30.0
    files = make_study(tmp_path, cube, figures=False)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    parse(page)
    assert "Not positive are 2 of 27 radial values" in words(page)
    assert "2 of 27 values are not positive and do not enter" in words(first_screen(page))
    assert "<td>2 of 9</td>" in page


def test_scatter_of_the_experiment_follows_from_its_r2():
    cube = noisy_cube((50.0, 500.0), (135.0, 250.0))
    laws = read_laws(powerlaw_table(cube), stiffness_summary(cube))
    text = " ".join(prestress_findings(cube, variability_table(cube), laws))
    # ln k = -1.8 ln o + 1.6 ln t over two by two points: half the differences, squared, add up.
    log = 1.8 * math.log(120 / 5) / 2, 1.6 * math.log(10) / 2
    residual = math.sqrt((log[0] ** 2 + log[1] ** 2) * (1 - 0.856) / 0.856)
    assert f"the published experiment by about {fixed(math.exp(residual))}" in text


def relaxed_cube():
    """Cube whose shapes were relaxed again on 2.5 mm, all but one of 50 um."""
    cube = noisy_cube((50.0, 500.0), (135.0, 170.0), 2)
    energy = cube["membrane_energy"] + cube["bending_energy"] + cube["stabilisation_energy"]
    settled = xr.ones_like(energy)
    settled[0, 0, 0] = np.nan
    return cube.assign(
        refined_strain_energy=0.8 * settled * energy,
        refined_static_stiffness=1.25 * settled * cube["static_stiffness_converged"],
        prestressed_stiffness_converged=0.5 * settled * cube["prestressed_stiffness"],
        prestressed_stiffness_mesh_error=0.5 * settled * cube["prestressed_stiffness"],
        refined_residual=4e-9 * settled,
        refined_negative_eigenvalues=0 * settled,
        refined_element_size=2.5 * settled,
    )


def test_relaxing_again_is_told_as_ratios():
    cube = relaxed_cube()
    thin, thick = relaxed_rows(cube)
    assert (thin.n, thick.n) == (3, 4)
    assert thin.energy.median == pytest.approx(0.8)
    assert thick.stress_free["radial"].highest == pytest.approx(1.25)
    assert thick.prestressed["axial"].lowest == pytest.approx(0.5)
    text = " ".join(relaxed_findings(cube))
    assert "on a mesh of 2.5 mm, 7 of 8 realisations settled (largest residual 4.0e−9, 0" in text
    assert "the axial stiffness by 1.2 stress-free and 0.50 pre-stressed" in text
    assert "is 100 % of the axial value" in text


def test_page_of_a_study_that_was_relaxed_again(tmp_path):
    files = make_study(tmp_path, relaxed_cube(), figures=False)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    parse(page)
    assert "Relaxed again on refined meshes" in page
    assert "This study, pre-stressed, relaxed again" in words(first_screen(page))


def test_study_that_relaxed_nothing_again_has_no_row():
    cube = relaxed_cube()
    empty = {name: cube[name] * np.nan for name in cube if name.startswith("refined_")}
    assert relaxed_rows(cube.assign(empty)) == []
    assert relaxed_findings(cube.assign(empty)) == []


def test_equilibria_need_the_residual_and_no_negative_eigenvalue():
    cube = noisy_cube()
    cube["equilibrium_residual"][0, 0, 0] = 3e-5
    found = assess_equilibrium(cube, configuration(cube))
    # 27 cells, of which 9 (500 um) have negative eigenvalues and one a large residual.
    assert (found.settled, found.cells, found.unstable) == (17, 27, 9)
    assert found.worst_residual == pytest.approx(3e-5)
    assert [row.settled for row in found.thicknesses] == [8, 9, 0]
    assert found.thicknesses[0].steps.median == pytest.approx(20_000)
    assert found.thicknesses[2].newton_steps.highest == pytest.approx(12)
    text = " ".join(equilibrium_findings(found))
    assert "17 of 27 realisations reached the relative residual of 1e−6" in text
    assert "9 realisations ended where the tangent has negative eigenvalues" in text


def test_cube_without_step_counts_claims_none():
    cube = noisy_cube().drop_vars(["steps", "newton_steps", "negative_eigenvalues"])
    found = assess_equilibrium(cube, {})
    assert found.unstable is None
    assert found.thicknesses[0].steps is None and found.thicknesses[0].newton_steps is None
    assert "stable equilibrium" not in " ".join(equilibrium_findings(found))


def test_flagged_cells_are_listed(study):
    _, page = study
    flagged = page.split('<table id="flagged">')[1].split("</table>")[0]
    assert "stopped at the step limit" in flagged and "not converged" in flagged
    assert flagged.count("<tr>") == 2


def test_costs_add_up(study):
    files, page = study
    health = assess(files.cube, files.benchmarks)
    assert sum(cost.share for cost in health.costs) == pytest.approx(1)
    assert {cost.stage: cost.total_s for cost in health.costs}["crumple"] == pytest.approx(81)
    jobs = {job["rule"]: job for job in health.jobs}
    assert jobs["crumple"]["jobs"] == 2 and jobs["crumple"]["wall_s"] == pytest.approx(5)
    assert jobs["cube"]["wall_s"] == pytest.approx(0.1)
    assert jobs.keys() == {"crumple", "cube"}
    assert "nan" not in words(page).lower().split()


def test_health_shares_and_limits(study):
    files, _ = study
    health, mesh = assess(files.cube), assess_mesh(files.cube)
    assert mesh.stabilisation_share[50.0].median == pytest.approx(0.1)
    assert len(health.model_limits) == 3
    assert all(limit.overlength_percent > 90 for limit in health.model_limits)


def test_same_inputs_give_the_same_page(study, tmp_path):
    files, page = study
    out = files.cube_path.parent / "again.html"
    assert write_report(files, out).read_text("utf-8") == page


def test_hostile_strings_stay_text(tmp_path):
    attack = '</script><img src=x onerror="alert(1)"><script>alert(2)</script>{{ 7 * 191 }}'
    cube = noisy_cube(verdicts={(0, 0, 0): ("failed", attack)})
    cube.attrs |= {"study": attack, "git_commit": attack}
    cube.attrs["config"] = CONFIG.replace("Synthetic study", json.dumps(attack)).replace(
        "FEP", json.dumps(attack)
    )
    crumple = write_crumple(tmp_path / "crumple.nc")
    files = make_study(tmp_path / "study", cube, crumples=[crumple])
    page = write_report(files, tmp_path / "study" / "report.html").read_text("utf-8")
    parser = parse(page)
    assert "x" not in parser.loaded
    assert page.count("<script") == 2
    assert page.count("onerror=&#34;alert(1)&#34;") >= 4
    assert "1337" not in page


def test_one_configuration_lacks_both_exponents(tmp_path):
    files = make_study(tmp_path, noisy_cube((250.0,), (170.0,), 2), figures=False)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    parse(page)
    text = words(first_screen(page))
    assert "is known at one configuration only" in text
    assert pd.read_csv(files.table("powerlaw"))["note"][0] in text


def test_one_thickness_lacks_its_exponent(tmp_path):
    files = make_study(tmp_path, noisy_cube((250.0,)), figures=False)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    answers = words(section(page, "law").split("<table")[0])
    assert "falls as overlength" in answers
    assert "as thickness" not in answers
    assert "thickness takes one value only" in answers


def test_single_realisation(tmp_path):
    files = make_study(tmp_path, noisy_cube((250.0,), (170.0,), 1), figures=False)
    page = write_report(files, tmp_path / "report.html").read_text("utf-8")
    assert "Scatter needs at least two" in words(page)


def test_study_without_a_single_result_says_so(tmp_path):
    cells = {(i, j, s): ("failed", "out of memory") for i, j, s in np.ndindex(2, 2, 1)}
    cube = noisy_cube((50.0, 500.0), (135.0, 170.0), 1, verdicts=cells)
    crumples = [write_crumple(tmp_path / "crumple.nc", status="failed")]
    files = make_study(tmp_path / "study", cube, figures=False, crumples=crumples)
    page = write_report(files, tmp_path / "study" / "report.html").read_text("utf-8")
    parse(page)
    text = words(page)
    assert "no law can be given: no usable realisation" in text
    assert "0 of 4 realisations converged; 4 failed." in text
    assert "No realisation left a shape" in text
    assert page.count("out of memory") == 4
    assert 'id="viewer"' not in page


def test_nothing_half_written_remains(tmp_path):
    files = make_study(tmp_path, noisy_cube((250.0,)))
    files.table("powerlaw").unlink()
    with pytest.raises(FileNotFoundError):
        write_report(files, tmp_path / "report.html")
    assert not list(tmp_path.glob("*report.html*"))


def test_verbs_follow_the_interval():
    assert Exponent(-0.9, -1.1, -0.7).effect == "falls as"
    assert Exponent(1.4, 1.2, 1.6).effect == "grows as"
    assert Exponent(0.1, -0.3, 0.5).effect == "shows no clear trend with"


@pytest.mark.parametrize(
    "value, text",
    [
        (0, "0"),
        (13349.2, "13\u202f300"),
        (-0.8512, "−0.851"),
        (1.3e-7, "1.30e−7"),
        (999.6, "1\u202f000"),
        (math.nan, "–"),
        (42, "42.0"),
    ],
)
def test_number(value, text):
    assert number(value) == text
