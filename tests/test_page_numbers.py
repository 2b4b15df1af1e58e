"""The numbers of the studies on the pages are those of their cubes and tables."""

import re
import shutil
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from synthetic import COARSE, DIRECTIONS, LAW, LIMIT_SHIFT, make_cube, ten_percent, write_cube

from foilstudy import open_cube
from foilstudy.base.errors import Refusal
from foilstudy.base.reference import published
from foilstudy.config import load_config
from foilstudy.present.statistics.tables import write_tables

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "docs"))

import page_numbers as pages  # noqa: E402
from page_numbers import Study, block  # noqa: E402

from foilstudy.study.real.settings import ladder  # noqa: E402

TRACKED = ("thesis", "resolved")
"""Studies of which the repository keeps cube and tables."""
STIFFER = 3.0
"""What the synthetic resolved study is stiffer by at each of its thicknesses."""


def make_study(results, name, cube):
    """A study below a folder of results, of the configuration of that name."""
    config = load_config(ROOT / f"config/{name}.yaml").to_yaml()
    angle = np.full((cube.sizes["thickness"], cube.sizes["overlength"], cube.sizes["seed"]), 45.0)
    cube["fold_angle"] = cube["status"].dims, angle
    for measure, value in (("shortening_spread", 0.7), ("axisymmetric_share", 0.4)):
        cube[measure] = cube["status"].dims, np.full(angle.shape, value)
    cube = cube.assign_attrs(config=config, machine="a machine")
    folder = results / name
    write_tables(open_cube(write_cube(cube, folder / "cube.nc")), folder)
    return Study(folder)


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Both studies, with known laws; on 5 mm the mesh resolves the thicker foils only."""
    folder = tmp_path_factory.mktemp("results")
    resolved = make_cube((130.0, 250.0, 500.0), cv=ten_percent)
    for name in ("static_stiffness", "static_stiffness_converged", "static_stiffness_mesh_error"):
        resolved[name] = STIFFER * resolved[name]
    make_study(folder, "resolved", resolved)
    make_study(folder, "thesis", make_cube(cv=ten_percent, case=COARSE))
    thin = make_cube((50.0,), (135.0, 150.0, 170.0), cv=ten_percent)
    for name in ("static_stiffness", "static_stiffness_converged", "static_stiffness_mesh_error"):
        thin[name] = 2 * STIFFER * thin[name]
    make_study(folder, "resolved_thin", thin)
    slow = make_cube((130.0, 250.0, 500.0), seeds=1, cv=ten_percent)
    for name in ("static_stiffness", "static_stiffness_converged", "static_stiffness_mesh_error"):
        slow[name] = 0.8 * STIFFER * slow[name]
    make_study(folder, "resolved_slow", slow)
    full = make_cube((250.0, 500.0), seeds=2, cv=ten_percent)
    plain = full["static_stiffness"]
    given = {"true_stiffness": plain / 2, "stiffness_contacts_stuck": 2 * plain}
    make_study(folder, "real_resolved", full.assign(given))
    thin = make_cube((130.0,), (135.0, 150.0, 170.0), seeds=1, cv=ten_percent)
    plain = thin["static_stiffness"]
    given = {"true_stiffness": plain / 2, "stiffness_contacts_stuck": 2 * plain}
    make_study(folder, "real_resolved_thin", thin.assign(given))
    tables = ("tradeoff/tradeoff.md", "real/laws.md", "truth/influences.md", "accuracy/accuracy.md")
    for table in tables:
        (folder / table).parent.mkdir()
        (folder / table).write_text("| a | table |\n", "utf-8")
    (folder / "specimen").mkdir()
    copied = (
        "tradeoff/tradeoff.csv",
        "real/trials.csv",
        "specimen/specimen.md",
        "accuracy/trials.csv",
    )
    for table in copied:
        shutil.copy(ROOT / "results" / table, folder / table)
    return folder


def studies(results, *names):
    return [Study(results / name) for name in names]


def cells(table):
    """Rows of a table below its head."""
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()[2:]]


# --- the pages as they are -----------------------------------------------------------------------


@pytest.mark.parametrize("name", pages.PAGES)
def test_every_page_says_what_its_studies_say(name):
    text = (ROOT / name).read_text("utf-8")
    assert pages.written(text, pages.RESULTS) == text, f"{name}: run docs/page_numbers.py"


def test_the_pages_show_the_law_of_the_resolved_study_first():
    found = {
        (match["name"], match["studies"])
        for name in pages.PAGES
        for match in pages.BLOCK.finditer((ROOT / name).read_text("utf-8"))
    }
    assert {name for name, _ in found} == set(pages.BLOCKS)
    readme = (ROOT / "README.md").read_text("utf-8")
    (law,) = (m for m in pages.BLOCK.finditer(readme) if m["name"] == "headline")
    assert law["studies"] == "resolved, thesis"
    for wanted in ("law", "beside", "summary"):
        assert (wanted, "resolved, thesis") in found
    for study in TRACKED:
        assert {("trust", study), ("simulation", study), ("experiment", study)} <= found


@pytest.mark.parametrize("name", TRACKED)
def test_the_tables_of_the_repository_are_those_of_its_cube(name, tmp_path):
    study = Study(ROOT / "results" / name)
    for path in write_tables(study.cube, tmp_path):
        ours, kept = pd.read_csv(path), study.table(path.stem)
        pd.testing.assert_frame_equal(ours, kept, rtol=1e-4, obj=path.stem)


# --- what they are made of -----------------------------------------------------------------------


@pytest.mark.parametrize("name", pages.PAGES)
def test_every_block_of_a_page_can_be_made(name, results):
    text = (ROOT / name).read_text("utf-8")
    made = pages.written(text, results)
    assert pages.written(made, results) == made
    assert not re.search(r"\bnan\b", "".join(m["text"] for m in pages.BLOCK.finditer(made)))


def test_headline_is_the_law_of_the_first_study_with_the_others_beside_it(results):
    rows = cells(block("headline", *studies(results, "resolved", "thesis")))
    for direction in DIRECTIONS:
        mine = [row[1:] for row in rows if row[0] == direction]
        assert [row[0] for row in mine] == [
            "**resolved to 10 %, mesh limit, all**",  # of which none is distrusted
            "5 mm, mesh limit, trusted",
            "5 mm, mesh limit, all",
            "5 mm, mesh limit, 130, 250, 500 µm",
            "published simulation",
            "published experiment",
        ]
        _, beta, gamma = LAW[direction]
        for row, n in zip(mine[:4], (90, 60, 120, 90), strict=True):
            assert float(row[2].split()[0]) == pytest.approx(beta, abs=0.02)
            # the smaller sample of trusted ones knows less of the exponent
            assert float(row[3].split()[0]) == pytest.approx(gamma + LIMIT_SHIFT, abs=0.1)
            assert row[5] == str(n) and all("±" in cell for cell in row[1:4])
        levels = [float(row[1].split()[0]) for row in (mine[0], mine[3])]
        assert levels[0] - levels[1] == pytest.approx(np.log(STIFFER), abs=0.02)
    assert len(rows) == 12


def test_thin_foil_stands_beside_the_law_that_leaves_it_out(results):
    laws, beside = block("thin", *studies(results, "resolved", "resolved_thin")).split("\n\n")
    rows = cells(laws)
    assert [row[1] for row in rows] == 2 * ["130, 250, 500 µm", "50, 130, 250, 500 µm"]
    assert [row[-1] for row in rows] == 2 * ["90", "108"]
    for direction in DIRECTIONS:
        alone, together = (float(row[4].split()[0]) for row in rows if row[0] == direction)
        assert alone == pytest.approx(LAW[direction][2], abs=0.1)
        assert together < alone - 0.2  # twice as stiff at the thin end
    assert {row[1] for row in cells(beside)} == {"50"}
    ratios = [float(row[5]) for row in cells(beside)]
    assert ratios == pytest.approx(6 * [2.0], rel=0.25)


def test_a_slower_ramp_stands_beside_the_usual_one(results):
    """Of which the foil here is a fifth softer."""
    levels, laws = block("ramps", *studies(results, "resolved_slow", "resolved")).split("\n\n")
    rows = cells(levels)
    assert [row[1] for row in rows] == 2 * ["130", "250", "500", "all"]
    assert all(len(row) == 2 + 5 + 1 for row in rows)
    for row in rows:
        value, low, high = (float(word.strip("()")) for word in row[-1].split() if word != "to")
        assert low <= value <= high and value == pytest.approx(0.8, rel=0.12)
    assert [row[-1] for row in cells(laws)] == 2 * ["15", "90"]


def test_one_realisation_has_no_interval(results):
    lone = Study(results / "resolved_thin")
    lone.__dict__["cube"] = lone.cube.isel(seed=[0])
    *_, beside = block("thin", Study(results / "resolved"), lone).split("\n\n")
    assert all(float(row[3]) > 0 for row in cells(beside))


def test_where_the_shortening_is_by_model():
    real, thesis = Study(pages.RESULTS / "real"), Study(pages.RESULTS / "thesis")
    rows = cells(block("localisation", real, thesis))
    assert [row[0] for row in rows[:-1]] == [step.words for step in ladder("real").steps]
    assert rows[-1][0] == "`results/thesis`"
    assert sum(int(row[1]) for row in rows[:-1]) == len(real.table("trials"))
    shares = [float(cell.split()[0]) for row in rows for cell in row[2:]]
    assert len(shares) == 6 * len(rows) and 0.1 < min(shares) and max(shares) < 1


def test_a_setting_stands_between_its_neighbours():
    rows = cells(block("buys", Study(pages.RESULTS / "tradeoff")).split("\n\n")[0])
    (ramp,) = (row for row in rows if row[:2] == ["ensembles, 500 um", "ramp steps"])
    assert ramp[2].startswith("8000: ")
    assert ramp[3].startswith("4000: 0.68, ") and ramp[4] == "32000: 2.87, reference"


def test_the_whole_model_stands_beside_elastic_foil_and_the_measured_law(results):
    """Of this foil half the stress-free stiffness as it stands, of the elastic one three times."""
    levels, laws = block("whole", *studies(results, "real_resolved", "resolved")).split("\n\n")
    rows = cells(levels)
    assert len(rows) == 2 * 2 * 4 and all(len(row) == 3 + 5 for row in rows)
    for k in range(0, len(rows), 4):
        elastic, plain, stuck, stands = (
            np.array([float(cell.split()[0]) for cell in row[3:]]) for row in rows[k : k + 4]
        )
        assert stuck / plain == pytest.approx(2.0, rel=0.1)
        assert stands / plain == pytest.approx(0.5, rel=0.1)
        assert elastic / plain == pytest.approx(STIFFER, rel=0.3)
        assert "(" in rows[k][3]
    law = published().power_laws["axial"]["experiment"].law
    cube = Study(results / "real_resolved").cube
    at = cube["static_stiffness"].sel(direction="axial", thickness=250).isel(overlength=2)
    over = at.values / law.stiffness(float(at["overlength"]), 250)
    assert float(rows[1][5].split()[0]) == pytest.approx(np.exp(np.log(over).mean()), abs=0.01)
    exponents = cells(laws)
    assert len(exponents) == 2 * 4 and {row[4] for row in exponents} == {"60 of 60", "20 of 20"}
    assert float(exponents[3][2].split()[0]) == pytest.approx(LAW["axial"][1], abs=0.1)


def test_thinner_foil_by_the_whole_model_is_in_its_laws_where_it_was_made(results):
    names = "real_resolved", "resolved", "real_resolved_thin"
    levels, laws = block("whole", *studies(results, *names)).split("\n\n")
    axial, radial = np.split(np.array(cells(levels)), 2)
    for rows in (axial, radial):
        assert list(rows[:, 1]) == ["130"] * 4 + ["250"] * 4 + ["500"] * 4
        assert (rows[1:4, 6:] == "–").all() and "–" not in np.delete(rows, [1, 2, 3], axis=0)
        stuck, plain = rows[2, 3:6].astype(float), rows[1, 3:6].astype(float)
        assert stuck / plain == pytest.approx(2.0, rel=0.1)
    assert {row[4] for row in cells(laws)} == {"90 of 90", "23 of 23"}


def test_laws_of_a_whole_study_stand_on_the_mesh_of_the_crumple_and_with_stress(results):
    rows = cells(block("law", *studies(results, "thesis")))
    axial = [row[1] for row in rows if row[0] == "axial"]
    assert axial[0] == "**5 mm, mesh limit, trusted**"
    assert "5 mm, mesh of the crumple, all" in axial
    assert "5 mm, pre-stressed, mesh of the crumple, all" in axial
    assert len([row for row in rows if "**" in row[1]]) == 2


def test_means_stand_beside_each_other_where_both_studies_have_them(results):
    lines = block("beside", *studies(results, "resolved", "thesis"))
    assert lines.splitlines()[0] == "|  | 3.8 % | 15 % | 31 % | 54 % | 92 % |"
    rows = cells(lines)
    assert [row[0] for row in rows] == [f"{d} {t} µm" for d in DIRECTIONS for t in (130, 250, 500)]
    for cell in (cell for row in rows for cell in row[1:]):
        ratio, low, high = map(float, re.fullmatch(r"(\S+) \[(\S+), (\S+)\]", cell).groups())
        assert ratio == STIFFER
        # of two means of six that scatter by a tenth, half the width of each times sqrt(2)
        assert np.log(high / low) / 2 == pytest.approx(2.57 * 0.1 / 6**0.5 * 2**0.5, rel=0.15)


def test_no_law_is_made_of_what_is_not_trusted(tmp_path):
    study = make_study(tmp_path, "thesis", make_cube((50.0, 130.0), seeds=2, case=COARSE))
    assert "**" not in block("headline", study)
    assert block("dimensionless", study).splitlines() == [
        f"- {d}: no law, as no configuration is trusted" for d in DIRECTIONS
    ]
    assert all("not compared" in line for line in block("differences", study).splitlines())


def test_ramps_are_those_of_each_thickness(results):
    ramps = {row[0]: row[1] for row in cells(block("steps", *studies(results, "resolved")))}
    assert ramps == {"130 µm": "30769", "250 µm": "16000", "500 µm": "8000"}


def test_a_missing_study_is_named_with_the_command_that_makes_it(results, tmp_path):
    for name, command in (
        ("resolved", "make study CONFIG=config/resolved.yaml"),
        ("tradeoff", "snakemake -j1 tradeoff"),
    ):
        block = "tradeoff" if name == "tradeoff" else "trust of resolved"
        text = f"<!-- numbers: {block} -->\n<!-- end -->\n"
        with pytest.raises(Refusal, match=f"results/{name}/.* is missing; `.*{command}` makes it"):
            pages.written(text, tmp_path)
        assert pages.written(text, results) != text


def test_a_page_whose_study_is_missing_is_left_and_the_others_are_written(
    results, tmp_path, monkeypatch, capsys
):
    for name, study in (("a.md", "thesis"), ("b.md", "other")):
        (tmp_path / name).write_text(f"<!-- numbers: bound of {study} -->\n<!-- end -->\n", "utf-8")
    for name, value in (
        ("ROOT", tmp_path),
        ("PAGES", ("b.md", "a.md")),
        ("RESULTS", results),
    ):
        monkeypatch.setattr(pages, name, value)
    monkeypatch.setattr(sys, "argv", ["page_numbers.py"])
    with pytest.raises(SystemExit, match="True|1"):
        pages.main()
    said = capsys.readouterr()
    assert said.out == "wrote: a.md\n"
    assert said.err.startswith("b.md is left as it is: results/other/cube.nc is missing")
    assert "No crumple (5 mm) exceeds" in (tmp_path / "a.md").read_text("utf-8")


def test_the_figure_of_air_is_of_every_row_of_its_table():
    from air_figure import table

    rows = table((ROOT / "docs/air.md").read_text("utf-8"))
    assert len(rows) == 7 and [row.thickness_um for row in rows][-1] == 50
    for row in rows:
        assert len(row.changes) == 3
        rounding = 0.05 + 100 * 0.1 / row.vacuum
        assert 100 * (row.air / row.vacuum - 1) == pytest.approx(row.changes[0], abs=rounding)
        assert row.alone < row.isothermal < row.adiabatic


def test_a_bias_explains_what_it_is_of_the_discrepancy():
    """All of it where the rig reads the discrepancy; the table is that of its own biases."""
    from bench_biases import DISCREPANCY, TABLE, explained

    kept = pd.read_csv(TABLE)
    whole = kept[(kept.direction == "radial") & (kept.thickness_um > 0)].head(1)
    made = explained(whole.assign(bias_percent=100 * (DISCREPANCY - 1)))
    assert made.explains_percent.item() == pytest.approx(100)
    pd.testing.assert_frame_equal(explained(kept), kept)
