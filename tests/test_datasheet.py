"""The data sheet of a link: its numbers by hand, and the page that says them."""

import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from foilstudy.base.cube import open_cube
from foilstudy.base.errors import Refusal
from foilstudy.bench.transfer_level import band_levels, level, nominal_hz, third_octaves
from foilstudy.command import main
from foilstudy.present.datasheet.facts import LINEAR_AMPLITUDE, Bands, link_facts
from foilstudy.present.datasheet.page import write_datasheet

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def cube():
    """The published study."""
    return open_cube(ROOT / "results/thesis/cube.nc")


@pytest.fixture(scope="module")
def facts(cube):
    return link_facts(cube, 500, 170)


# --- one-third octaves on any grid ---------------------------------------------------------------


def test_a_power_that_grows_straight_has_the_mean_of_the_middle_of_its_band():
    f = np.geomspace(80, 130, 40)
    centres, levels = band_levels(f, np.sqrt(f))
    assert centres == pytest.approx([100])
    assert levels == pytest.approx([10 * np.log10(50 * (10**0.05 + 10**-0.05))])


def test_both_ways_to_average_agree_where_both_can():
    f = np.arange(1.0, 2000.0, 0.5)
    k = 1e4 / (1 - (f / 150) ** 2 + 0.1j * f / 150)
    by_count = {round(b.centre_hz, 6): b.level_db for b in third_octaves(f, k)}
    centres, levels = band_levels(f, k)
    wide = centres > 40  # where a line more or less at an end does not count
    expected = [by_count[round(c, 6)] for c in centres[wide]]
    assert levels[wide] == pytest.approx(expected, abs=0.1)


def test_bands_that_are_cut_off_or_hold_too_few_or_unknown_values_have_no_level():
    f = np.geomspace(1, 800, 200)
    centres, _ = band_levels(f, np.ones(200))
    assert centres[0] == pytest.approx(10**0.1) and centres[-1] == pytest.approx(10**2.8)
    assert band_levels(f[::3], np.ones(67))[0].size == 0
    curve = np.where(f < 300, 10.0, np.nan)
    levels = dict(zip(centres.round(), band_levels(f, curve)[1]))
    assert levels[251] == pytest.approx(20) and np.isnan(levels[316])


def test_bands_go_by_their_preferred_names():
    exact = 10 ** (np.arange(31) / 10)
    names = [nominal_hz(f) for f in exact]
    assert names[:10] == [1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8]
    assert names[20:22] == [100, 125] and names[-1] == 1000


def test_levels_of_several_realisations_by_hand():
    f = np.geomspace(80, 130, 40)
    bands = Bands.of(f, np.array([np.full(40, 10.0), np.full(40, 1000.0), np.full(40, np.nan)]))
    assert (bands.mean, bands.least, bands.most) == (
        pytest.approx([40]), pytest.approx([20]), pytest.approx([60])
    )  # fmt: skip


# --- what is read from the cube ------------------------------------------------------------------


def test_the_numbers_are_those_of_the_cube(cube, facts):
    cell = cube.sel(thickness=500).isel(overlength=2)
    for k, direction in enumerate(facts.directions):
        values = cell["static_stiffness"].isel(direction=k).values
        assert direction.static.interval.mean == pytest.approx(values.mean())
        assert (direction.static.least, direction.static.most) == (values.min(), values.max())
        limit = cell["static_stiffness_converged"].isel(direction=k).values
        assert direction.limit.interval.mean == pytest.approx(limit.mean())
    assert (facts.realisations, facts.counted, facts.not_converged) == (6, 6, 0)
    assert facts.first_hz.interval.mean == pytest.approx(float(cell.first_eigenfrequency.mean()))
    assert facts.band_hz == (1, min(800, float(cell.valid_to_frequency.min())))


def test_six_motions_and_two_directions_are_the_same_link(cube, facts):
    """A translation of both rings costs nothing: driving and transfer stiffness are one."""
    along = [facts.motions[f"bottom_u{axis}"].interval.mean for axis in "xyz"]
    axial, radial = (each.static.interval.mean for each in facts.directions)
    assert [along[2], np.mean(along[:2])] == pytest.approx([axial, radial], rel=1e-6)
    matrix = cube["interface_stiffness"].sel(thickness=500, seed=0).isel(overlength=2).values
    assert -np.diag(matrix[6:9, :3]) == pytest.approx(np.diag(matrix)[:3], rel=1e-6)


def test_the_level_begins_at_that_of_the_static_stiffness(facts):
    for each in facts.directions:
        lowest = level(np.abs(each.curves[:, 0])).mean()
        assert each.bands.mean[0] == pytest.approx(lowest, abs=0.01)
        assert lowest == pytest.approx(20 * np.log10(each.static.interval.mean), abs=0.5)


def test_what_is_not_trusted_says_why(cube, facts):
    assert all(each.doubts == () for each in facts.directions)
    thin = link_facts(cube, 50, 135)
    assert all("not resolved" in each.doubts[0] for each in thin.directions)


def test_realisations_that_failed_do_not_count(cube):
    broken = cube.copy(deep=True)
    broken["status"][dict(thickness=3, overlength=2, seed=1)] = "failed"
    facts = link_facts(broken, 500, 170)
    assert (facts.realisations, facts.counted) == (6, 5)
    assert facts.directions[0].static.interval.n == 5 and len(facts.directions[0].curves) == 5
    broken["status"][dict(thickness=3, overlength=2)] = "failed"
    with pytest.raises(Refusal, match="no realisation of 500 um, 170 mm counts"):
        link_facts(broken, 500, 170)


def test_a_cube_of_old_lacks_what_it_lacks(cube):
    names = ["interface_stiffness", "valid_to_frequency", "static_stiffness_converged"]
    facts = link_facts(cube.drop_vars(names), 500, 170)
    assert facts.motions == {} and facts.band_hz == (1, 800)
    assert not facts.directions[0].limit.known and "not stated" in facts.directions[0].doubts[0]


# --- the page ------------------------------------------------------------------------------------


def text_of(page):
    body = re.sub(r"<(style|svg).*?</\1>", "", page, flags=re.DOTALL)
    return " ".join(re.sub(r"<[^>]+>", " ", body).replace("\u202f", " ").split())


def test_the_page_needs_nothing_else_and_says_what_it_knows(cube, tmp_path):
    write_datasheet(cube, tmp_path / "sheet.html", 500, 170)
    page = (tmp_path / "sheet.html").read_text("utf-8")
    assert not re.search(r'(src|href)="(?!#)', page)
    ElementTree.fromstring(re.search(r"<svg.*</svg>", page, re.DOTALL)[0])
    text = text_of(page)
    assert "FEP, 500 µm, 170 mm" in text and "Of 6 realisations (seeds), 6 in the numbers" in text
    assert "axial, N/m 8 700 6 320 to 12 000 30 %" in text
    assert text.count("not computed") >= 2 and "was not computed" in text
    assert "First eigenfrequency with both rings held: 129 Hz" in text
    assert "Do not trust" not in text


def test_doubts_stand_first_and_the_amplitude_once_the_cube_has_it(cube, tmp_path):
    known = cube.copy()
    known[LINEAR_AMPLITUDE] = 1e-3 * known["static_stiffness"] / known["static_stiffness"]
    known[LINEAR_AMPLITUDE].attrs["units"] = "mm"
    write_datasheet(known, tmp_path / "sheet.html", 50, 135)
    text = text_of((tmp_path / "sheet.html").read_text("utf-8"))
    assert text.index("Do not trust the axial stiffness: its elements") < text.index("Static")
    assert "0.0010 mm" in text and "not computed" not in text


@pytest.mark.parametrize("steps", [2000, 80_000])
def test_a_hurried_ramp_is_among_the_doubts(cube, tmp_path, steps):
    config = cube.attrs["config"].replace("ramp_steps: 2000", f"ramp_steps: {steps}")
    write_datasheet(cube.assign_attrs(config=config), tmp_path / "sheet.html", 500, 170)
    text = text_of((tmp_path / "sheet.html").read_text("utf-8"))
    # of the other thicknesses it says nothing
    assert ("The ramp hurries foil of 500 µm: 10 steps" in text) == (steps == 2000)


def test_the_command_writes_one_and_refuses_what_the_cube_lacks(tmp_path, capsys):
    words = ["datasheet", str(ROOT / "results/thesis"), "--thickness", "500"]
    main([*words, "--height", "170", "--output", str(tmp_path / "link.html")])
    assert f"wrote {tmp_path / 'link.html'}" in capsys.readouterr().out
    with pytest.raises(SystemExit, match="say which by --height"):
        main(words)
