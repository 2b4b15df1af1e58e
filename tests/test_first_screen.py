"""The first answer of a study: true by its own mesh limit, or a banner that says what is not."""

from __future__ import annotations

import html
import re

import numpy as np
import pytest
import xarray as xr
import yaml
from synthetic import (
    COARSE,
    FAILED,
    PET,
    SyntheticCase,
    make_cube,
    ten_percent,
    write_cube,
)

from foilstudy.base.numerals import duration, fixed, stiffness
from foilstudy.config import load_config
from foilstudy.model.mesh_size import ERROR_COEFFICIENT, SLENDERNESS_MAX
from foilstudy.present.configuration import configuration
from foilstudy.present.files import StudyFiles
from foilstudy.present.report import write_report
from foilstudy.present.report.alt import _FORMS, alt_text
from foilstudy.present.report.configurations import named
from foilstudy.present.report.cure import Need, cures
from foilstudy.present.report.distrust import banner
from foilstudy.present.report.page import TEMPLATES
from foilstudy.present.statistics.tables import write_tables
from foilstudy.present.statistics.trust import assess_trust
from foilstudy.study.sweep.expected import expected

PET_FOIL = {"diameter_mm": 120.0, "gap_height_mm": 80.0, "material": PET}
PET_SWEEP = {
    "thickness_um": (25.0, 50.0, 100.0),
    "reference_height_mm": (92.0, 104.0, 128.0),
    "seeds": 2,
}
VERBS = re.compile(r"(?:falls as|grows as|shows no clear trend with) (?:overlength|thickness)")


def wild(thickness, overlength):
    """Stated errors from 20 to 210 %, the larger the thinner the foil and the longer."""
    return 0.2 + 1.9 * (25 / thickness) * (overlength / 60)


def radially_wild_cube():
    cube = make_cube(cv=ten_percent, seeds=3)
    limit = cube["static_stiffness_converged"]
    cube["static_stiffness_mesh_error"][:2, :, :, 1] = 0.5 * limit[:2, :, :, 1]
    return cube


def scattered_cube():
    """A large sweep in which one configuration in three, wherever it falls, is inaccurate."""
    sweep = {
        "thickness_um": tuple(np.linspace(60, 500, 12)),
        "reference_height_mm": tuple(np.linspace(135, 250, 12)),
    }
    cube = make_cube(seeds=1, **sweep)
    wrong = np.random.default_rng(1).random((12, 12)) < 1 / 3
    cube["static_stiffness_mesh_error"][:] = (
        np.where(wrong[:, :, None, None], 0.4, 0.02) * cube["static_stiffness_converged"]
    )
    return cube


CASES = {
    "all trusted": lambda: make_cube(cv=ten_percent, seeds=3),
    "thin foil not resolved": lambda: make_cube(cv=ten_percent, seeds=3, case=COARSE),
    "PET on 5 mm": lambda: make_cube(
        cv=ten_percent,
        case=SyntheticCase(**PET_FOIL, element_size_mm=5.0, mesh_error=wild, refinements=1),
        **PET_SWEEP,
    ),
    "PET resolved": lambda: make_cube(
        cv=ten_percent, case=SyntheticCase(**PET_FOIL, element_size_mm=0.6), **PET_SWEEP
    ),
    "errors to 210 %": lambda: make_cube(
        cv=ten_percent,
        case=SyntheticCase(**PET_FOIL, element_size_mm=0.6, mesh_error=wild),
        **PET_SWEEP,
    ),
    "radial errors alone": radially_wild_cube,
    "no refinement": lambda: make_cube(cv=ten_percent, seeds=3, case=SyntheticCase(refinements=0)),
    "one overlength": lambda: make_cube((100.0, 500.0), (170.0,), 3, cv=ten_percent),
    "one thickness": lambda: make_cube((100.0,), (135.0, 170.0, 250.0), 3, cv=ten_percent),
    "one configuration": lambda: make_cube((500.0,), (170.0,), 3, cv=ten_percent),
    "one seed": lambda: make_cube(seeds=1),
    "two seeds": lambda: make_cube(seeds=2, cv=ten_percent),
    "one thickness resolved": lambda: make_cube(
        (50.0, 100.0, 500.0), seeds=3, cv=ten_percent, case=COARSE
    ),
    "failed realisations": lambda: make_cube(
        seeds=2, cv=ten_percent, verdicts={(0, 0, 0): FAILED, (0, 0, 1): FAILED, (1, 2, 0): FAILED}
    ),
    "large foil of thin film": lambda: make_cube(
        (12.0, 25.0),
        (1100.0, 1500.0),
        2,
        cv=ten_percent,
        case=SyntheticCase(1000.0, 1000.0, PET, 20.0, 1, lambda t, o: 0.9),
    ),
    "large sweep": scattered_cube,
}


def written(cube, folder):
    files = StudyFiles(write_cube(cube, folder / "cube.nc"))
    write_tables(files.cube, folder)
    return write_report(files, folder / "report.html").read_text("utf-8")


def words(page):
    """Text as it is read, without tags, scripts and styles."""
    body = re.sub(r"<(script|style)\b.*?</\1>", " ", page, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body)))


def section(page, name):
    return page.split(f'<section id="{name}">')[1].split("</section>")[0]


def answers(page):
    """What the page says of the law of each direction, before any table."""
    parts = section(page, "law").split('<div class="answer">')[1:]
    return dict(zip(("axial", "radial"), map(words, parts), strict=True))


@pytest.fixture(scope="module", params=CASES, ids=lambda name: name.replace(" ", "_"))
def case(request, tmp_path_factory):
    cube = CASES[request.param]()
    return cube, written(cube, tmp_path_factory.mktemp("case"))


def test_a_law_is_stated_only_of_trusted_stiffness_and_is_its_mesh_limit(case):
    cube, page = case
    trusted = assess_trust(cube).trusted
    for direction, text in answers(page).items():
        cells = trusted.sel(direction=direction)
        if not cells.any():
            assert not VERBS.search(text) and "k radial" not in text and "k axial" not in text
            continue
        values = cube["static_stiffness_converged"].sel(direction=direction).where(cells)
        values = values.where(cube["status"] == "converged")
        stacked = np.log(values.stack(all=("thickness", "overlength", "seed")).dropna("all"))
        o, t = np.log(stacked["overlength"].values), np.log(stacked["thickness"].values)
        columns = [c for c in (o, t) if np.ptp(c) > 0]
        design = np.column_stack([np.ones(stacked.size), *columns])
        coefficients = np.linalg.lstsq(design, stacked.values, rcond=None)[0]
        assert len(VERBS.findall(text)) == len(columns)
        for value in coefficients[1:]:
            assert fixed(value) in text
        assert f"{stacked.size} realisation" in text


def test_what_is_not_trusted_stands_in_a_banner_of_the_first_screen(case):
    cube, page = case
    trust = assess_trust(cube)
    screen = section(page, "first")
    doubted = int(trust.doubted.any("direction").sum())
    assert (doubted > 0) == ('class="banner"' in screen)
    marked = screen.count('class="doubted"')
    assert marked == int(trust.doubted.sum())
    if doubted:
        text = words(screen.split('class="banner"')[1])
        assert len(text) < 1500
        known = int(trust.known.any("direction").sum())
        assert ("any stiffness" if doubted == known else f"{doubted} of {known}") in text


def test_first_screen_tells_the_stiffness_of_every_configuration(case):
    cube, page = case
    stated = np.isfinite(cube["static_stiffness_mesh_error"]).all()
    values = cube["static_stiffness_converged" if stated else "static_stiffness"].mean("seed")
    screen = words(section(page, "first"))
    if "failed" not in set(cube["status"].values.ravel()):
        for value in values.values.ravel():
            assert stiffness(float(value)) in screen
    assert section(page, "first").count("<td") == values.size


def test_nothing_published_stands_beside_another_case(case):
    cube, page = case
    text = words(page)
    if "There is nothing published to compare this study with" in text:
        said = re.sub(r"There is nothing published[^.]*", "", text)
        assert not re.search("published|thesis|Bader", said, re.I)
        assert configuration(cube)["sheet"]["diameter_mm"] != 200
    else:
        assert configuration(cube)["sheet"]["diameter_mm"] == 200
        assert "Published experiment" in text


def test_no_sentence_excuses_an_interval(case):
    _, page = case
    text = words(page)
    assert "too narrow" not in text and "standard error" not in text
    law = text.split("How the stiffness depends")[1]
    assert law.index("± is the 95 % interval") < law.index("lack of fit")


def banner_words(cube):
    found = banner(cube, assess_trust(cube))
    return " ".join([found.verdict, *found.reasons, found.consequence])


def test_banner_of_thin_foil_names_it_and_says_why():
    cube = CASES["thin foil not resolved"]()
    text = banner_words(cube)
    assert "Do not trust the stiffness of 10 of 20 configurations" in text
    assert "not resolved at 50 and 130 µm at every overlength" in text
    assert "elements are 1.4 to 2.2 times √(R t) wide, and folds need 1 at most" in text
    assert "stated mesh error is more than" not in text
    assert "Laws are those of the trusted configurations alone." in text


def test_banner_of_large_errors_says_how_large_and_where():
    text = banner_words(CASES["errors to 210 %"]())
    assert "Do not trust any stiffness of this study yet." in text
    assert "more than 20 % of a value, up to 210 %: axial and radial at" in text
    assert "not resolved" not in text and "No law is stated." in text
    radial = banner_words(radially_wild_cube())
    assert "up to 50.0 %: radial at 50 and 130 µm at every overlength." in radial


def test_banner_without_refinement_says_that_no_error_is_stated(tmp_path):
    cube = CASES["no refinement"]()
    text = banner_words(cube)
    assert "No mesh error is stated" in text and "(stiffness.refinements: 0)" in text
    page = words(section(written(cube, tmp_path), "first"))
    assert "stiffness of n = 3 realisations on the crumpled mesh" in page
    assert "Cure: stiffness.refinements: 1 : the responses anew, the crumples stay" in page


def test_few_realisations_are_said_to_tell_little(tmp_path):
    one = words(section(written(CASES["one seed"](), tmp_path), "first"))
    assert "One realisation of each configuration: its scatter is not known." in one
    two = words(section(written(CASES["two seeds"](), tmp_path), "first"))
    assert "Two realisations of each configuration" in two


def test_single_trusted_thickness_says_nothing_of_the_thickness(tmp_path):
    text = answers(written(CASES["one thickness resolved"](), tmp_path))["axial"]
    assert "5 of 15 configurations that are trusted" in text
    assert "falls as overlength" in text and "as thickness" not in text
    assert "thickness takes one value only" in text


def test_dimensionless_law_stands_beside_the_dimensional_one(tmp_path):
    cube = CASES["PET resolved"]()
    text = answers(written(cube, tmp_path))["axial"]
    found = re.search(
        r"k axial /\(E t\) = ([\d. ]+) · \(overlength/gap\) (−?[\d.]+) · \(t/R\) (−?[\d.]+) "
        r"at h/D = 0.667",
        text.replace("\u202f", ""),
    )
    constant, beta, gamma = (float(part.replace("−", "-")) for part in found.groups())
    # at 30 % and 50 um; E t in N/m is MPa times um
    stiffness = constant * 0.3**beta * (0.05 / 60) ** gamma * 4000 * 50
    limit = cube["static_stiffness_converged"].sel(thickness=50, direction="axial")
    assert stiffness == pytest.approx(float(limit.isel(overlength=1).mean()), rel=0.1)


# --- what cures it, and what that costs ----------------------------------------------------------


def test_cure_resolves_every_foil_at_the_cost_that_check_tells():
    cube = CASES["thin foil not resolved"]()
    first, second = cures(cube, Need(mesh=True, refinements=None))
    assert first.keys == ("mesh.element_size_mm: auto", "mesh.energy_error_percent: 25")
    assert second.keys == ("mesh.element_size_mm: auto", "mesh.energy_error_percent: 48")
    content = dict(configuration(cube)) | {
        "sweep": {
            "thickness_um": [50.0, 130.0, 250.0, 500.0],
            "reference_height_mm": [135.0, 150.0, 170.0, 200.0, 250.0],
            "realisations": 3,
        },
        "mesh": {"element_size_mm": "auto", "energy_error_percent": 48},
    }
    study = load_config(content)
    for thickness in study.thicknesses_um:
        size = study.mesh_of(thickness).element_size_mm
        assert size / np.sqrt(100 * thickness * 1e-3) <= SLENDERNESS_MAX
    time = duration(expected(study).processor_seconds, 2)
    assert f"about {time} of processor time" in second.cost
    assert "elements of 2.23 to 7.07 mm" in second.remark


def test_cure_of_pet_on_5_mm_is_auto():
    first, _ = cures(CASES["PET on 5 mm"](), Need(mesh=True, refinements=None))
    assert first.keys == ("mesh.element_size_mm: auto",)
    assert "the whole study anew, about" in first.cost and "on 2 free cores" in first.cost


def test_refining_the_stiffness_keeps_the_crumples():
    cube = make_cube(seeds=3, case=SyntheticCase(refinements=1, mesh_error=lambda t, o: 0.3))
    found = banner(cube, assess_trust(cube))
    (cure,) = found.cures
    assert cure.keys == ("stiffness.refinements: 2",)
    assert "the crumples stay" in cure.cost


def folded_cube(angle_deg, **options):
    """Nothing is wrong but that the crumples of the thinnest foil fold so sharply."""
    cube = make_cube((250.0, 500.0), (135.0, 250.0), 3, **options)
    cube["fold_angle"] = 40.0 * xr.ones_like(cube["element_size"])
    cube["fold_angle"][0, 1] = angle_deg
    return cube


def test_a_mesh_that_does_not_follow_the_folds_is_named_and_made_finer():
    assert banner(folded_cube(59), assess_trust(folded_cube(59))) is None
    cube = folded_cube(80, case=SyntheticCase(element_size_mm=4.0))
    verdict = assess_trust(cube)
    assert verdict.trusted.sum() == 6 and verdict.folded.sel(thickness=250)[1].all()
    found = banner(cube, verdict)
    assert "1 of 4 configurations" in found.verdict
    (reason,) = found.reasons
    assert "turn 80° from one element to the next at 250 µm at 92.3 %" in reason
    first, *_ = found.cures
    # 4 mm is 0.8 sqrt(R t); 60/80 of that has an energy error of 17 %, more than that of auto
    assert first.keys == ("mesh.element_size_mm: auto",)
    sharper = folded_cube(150, case=SyntheticCase(element_size_mm=4.0))
    first, *_ = banner(sharper, assess_trust(sharper)).cures
    error = ERROR_COEFFICIENT * (0.8 * 60 / 150) ** 2
    assert first.keys[1] == f"mesh.energy_error_percent: {np.floor(1e3 * error) / 10:g}"


def sized_by_word(cube, word, **changes):
    """The cube with a configuration whose word has sized its elements, but for what is given."""
    sweep = {"thickness_um": [250, 500], "reference_height_mm": [135, 250], "realisations": 3}
    cube.attrs["config"] = load_config({"accuracy": word, "sweep": sweep} | changes).to_yaml()
    return cube


def test_where_a_word_sized_the_elements_a_finer_one_is_the_cure():
    # 4 mm is 0.8 sqrt(R t); 60/80 of that has an energy error of 17 %, 60/150 one of 4.9 %
    for word, angle, finer in (("quick", 80, "standard"), ("standard", 150, "fine")):
        cube = folded_cube(angle, case=SyntheticCase(element_size_mm=4.0))
        found = banner(cube, assess_trust(sized_by_word(cube, word)))
        assert found.cures[0].keys == (f"accuracy: {finer}",)
        asked = load_config(yaml.safe_load(sized_by_word(cube, finer).attrs["config"]))
        time = duration(expected(asked).processor_seconds, 2)
        assert f"about {time} of processor time" in found.cures[0].cost
    # nothing but the error itself is finer than the finest, or than what was given beside the word
    for word, changes in (("fine", {}), ("standard", {"mesh": {"energy_error_percent": 12}})):
        cube = folded_cube(300, case=SyntheticCase(element_size_mm=4.0))
        found = banner(cube, assess_trust(sized_by_word(cube, word, **changes)))
        assert found.cures[0].keys[1].startswith("mesh.energy_error_percent: ")


def test_the_page_names_the_accuracy_and_what_overrules_it(tmp_path):
    cube = sized_by_word(folded_cube(40), "quick", relaxation={"ramp_steps": 3000})
    page = words(written(cube, tmp_path))
    assert "accuracy quick, overruled by relaxation.ramp_steps: 3000" in page


def test_the_first_screen_says_of_a_ramp_that_hurries_the_foil(tmp_path):
    for steps, said in (
        (3000, "The ramp hurries foil of 250, 500 µm: 7.5 to 15 steps"),
        (40000, ""),
    ):
        cube = sized_by_word(folded_cube(40), "standard", relaxation={"ramp_steps": steps})
        page = written(cube, tmp_path)
        first = words(page[page.index('id="first"') : page.index("</section>")])
        assert ("The ramp hurries" in first) == bool(said) and said in first


def test_the_first_screen_says_of_elements_on_which_shapes_are_others(tmp_path):
    for size, said in (
        (4.0, "The elements of foil of 500 µm are 0.57 times"),
        (3.2, ""),
    ):
        cube = make_cube((500.0,), (135.0, 250.0), 3, case=SyntheticCase(element_size_mm=size))
        page = written(cube, tmp_path)
        first = words(page[page.index('id="first"') : page.index("</section>")])
        assert ("other shapes" in first) == bool(said) and said in first


def test_foil_that_no_mesh_resolves_is_left_out_of_the_cure(tmp_path):
    thin = make_cube((1.0, 500.0), (135.0, 250.0), 1, case=COARSE)
    first, *_ = cures(thin, Need(mesh=True, refinements=None))
    assert first.keys[-1] == "sweep.thickness_um: [500]"
    alone = make_cube((0.5,), (135.0, 250.0), 1, case=COARSE)
    assert cures(alone, Need(mesh=True, refinements=None)) == []
    assert 'class="banner"' in written(alone, tmp_path)


def test_cure_of_another_element_is_a_size():
    cube = make_cube((50.0, 500.0), (135.0, 170.0), 1, case=COARSE)
    cube.attrs["config"] = cube.attrs["config"].replace("element: corner", "element: one_point")
    (cure,) = cures(cube, Need(mesh=True, refinements=None))
    (key,) = cure.keys
    assert float(key.removeprefix("mesh.element_size_mm: ")) == pytest.approx(2.236, abs=0.01)


def test_configuration_that_is_no_longer_valid_has_no_cure_but_a_banner(tmp_path):
    cube = CASES["thin foil not resolved"]()
    cube.attrs["config"] += "gone: {key: 1}\n"
    assert cures(cube, Need(mesh=True, refinements=None)) == []
    assert "not resolved at 50 and 130 µm" in banner_words(cube)
    assert "No mesh that a study of this package can carry resolves it" in banner_words(cube)


# --- configurations in few words -----------------------------------------------------------------


def chosen(table, overlengths=(15.0, 30.0, 60.0, 90.0)):
    table = np.asarray(table, bool)
    return xr.DataArray(
        table,
        {"thickness": 50.0 * (1 + np.arange(table.shape[0])), "overlength": list(overlengths)},
        ("thickness", "overlength"),
    )


@pytest.mark.parametrize(
    ("table", "text"),
    [
        ([[1, 1, 1, 1], [1, 1, 1, 1]], "50 and 100 µm at every overlength"),
        ([[1, 1, 1, 1], [0, 1, 1, 1], [0, 0, 0, 0]], "50 µm at every overlength, 100 µm at 30 to"),
        ([[1, 0, 1, 0], [0, 0, 0, 0]], "50 µm at 15 and 60 %"),
        ([[0, 0, 0, 0], *[[0, 0, 1, 1]] * 3], "100 to 200 µm at 60 and 90 %"),
    ],
)
def test_configurations_are_named_in_groups(table, text):
    assert named(chosen(table)).startswith(text)


def test_many_configurations_are_named_in_bounded_words():
    rng = np.random.default_rng(2)
    table = rng.random((40, 40)) < 0.5
    text = named(chosen(table, np.linspace(5, 90, 40)))
    assert len(text) < 300
    shown = sum(map(int, re.findall(r"at (\d+) of 40 values", text)))
    assert f"{table.sum() - shown} more configurations" in text


# --- the page as it is used ----------------------------------------------------------------------


def test_alt_texts_say_what_is_seen():
    from foilstudy.present.figures import FIGURES

    assert set(_FORMS) == set(FIGURES)
    text = alt_text("variability", "Scatter", {"variability": ["It rises.", "", "So.", "Cut."]})
    assert text.startswith("Scatter. Dots with error bars") and text.endswith("It rises. So.")


def test_tables_hide_nothing_and_wide_ones_scroll_in_their_box(case):
    _, page = case
    style = (TEMPLATES / "report.css").read_text("utf-8")
    assert "max-height: 26rem" not in style and "overflow-y: auto" not in style
    assert re.search(r"\.scroll \{[^}]*overflow-x: auto", style)
    for opened in re.finditer(r"<table", page):
        before = page[: opened.start()].rstrip()
        assert before.endswith(('<div class="scroll">', 'class="scroll tall">'))


def test_a_phone_scrolls_past_the_view_and_turns_it_by_buttons():
    style, script, page = (
        (TEMPLATES / name).read_text("utf-8") for name in ("report.css", "viewer.js", "report.html")
    )
    assert re.search(r"canvas \{[^}]*touch-action: pan-y", style)
    assert 'event.pointerType === "touch" ? 0 : up' in script
    for act in ("left", "right", "up", "down"):
        assert f'data-act="{act}"' in page and f'["{act}",' in script


def test_findings_are_of_trusted_configurations_and_every_section_recalls_the_doubt(tmp_path):
    page = written(CASES["thin foil not resolved"](), tmp_path)
    text = words(section(page, "static"))
    assert "in the 10 of 20 configurations that are trusted, runs from" in text
    assert "(50 µm" not in text.split("Every configuration")[0]
    for name in ("static", "prestress", "variability", "dynamic", "eigenfrequency", "system"):
        assert "Do not trust the stiffness of 10 of 20 configurations." in words(
            section(page, name)
        )


def test_levels_are_compared_where_the_stiffness_is_trusted(tmp_path):
    text = words(section(written(CASES["thin foil not resolved"](), tmp_path), "law"))
    # the geometric middle of 250 and 500 um, not of all four thicknesses
    assert "mid-sweep is 354 µm and 24.6 %, the middle of what is trusted." in text
