"""A study is drawn anew from its cube: everything that can be, and the rest is said."""

from __future__ import annotations

import shutil
from pathlib import Path

import matplotlib.image
import numpy as np
import pandas as pd
import pytest
from synthetic import FAILED, make_cube, ten_percent, write_cube, write_study

from foilstudy import open_cube
from foilstudy.base.manifest import listed
from foilstudy.command import main
from foilstudy.plot.save import save
from foilstudy.present.figures import FIGURES, registry
from foilstudy.present.files import StudyFiles
from foilstudy.present.redraw import redraw
from foilstudy.present.shown import note_origin
from foilstudy.present.statistics.tables import TABLES

RESULTS = Path(__file__).parents[1] / "results"
OF_RECORDS = [name for name, figure in FIGURES.items() if figure.needs != ("cube",)]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A study of which the cube alone is there; one realisation failed.

    Its pictures have few dots, as nobody looks at them.
    """
    monkeypatch.setattr(registry, "save", lambda figure, stem, _: save(figure, stem, dpi=30))
    cube = make_cube(
        (50.0, 500.0), (135.0, 170.0), seeds=2, cv=ten_percent, verdicts={(0, 0, 1): FAILED}
    )
    write_cube(cube, tmp_path / "cube.nc")
    return tmp_path


def figures_in(page):
    return {name for name in FIGURES if f'<figure id="figure-{name}"' in page}


def test_cube_with_its_records_gives_everything(folder):
    write_study(open_cube(folder / "cube.nc"), folder)
    redrawn = redraw(folder)
    assert redrawn.kept == redrawn.left_out == []
    assert {path.name for path in redrawn.written} == {
        *(f"{name}.csv" for name in TABLES),
        *(f"{name}.{kind}" for name in FIGURES for kind in ("png", "svg")),
        "report.html",
    }
    page = (folder / "report.html").read_text("utf-8")
    assert figures_in(page) == set(FIGURES)
    assert 'id="viewer"' in page and "60 Hz" not in page.split("<script")[0]
    law = pd.read_csv(folder / "powerlaw.csv")
    assert f"{law['gamma'][0]:.2f}" in page


def test_cube_alone_keeps_the_pictures_that_it_cannot_draw(folder, capsys):
    picture, other = (folder / "figures" / f"{name}.png" for name in ("morphology", "seeds"))
    picture.parent.mkdir()
    for path in (picture, other):
        matplotlib.image.imsave(path, np.eye(9))
    note_origin(StudyFiles(folder / "cube.nc"), [picture])  # the other may be of any cube
    before = picture.read_bytes()
    main(["report", str(folder / "cube.nc")])
    *written, kept, left_out = capsys.readouterr().out.splitlines()
    why = "as the records of the realisations are not there, or not those of this cube: "
    assert kept == f"left as they were, {why}morphology"
    assert set(left_out.removeprefix(f"left out, {why}").split(", ")) == {
        *set(OF_RECORDS) - {"morphology"}
    }
    paths = [Path(line.removeprefix("wrote ")) for line in written]
    assert all(path.stat().st_size for path in paths)
    assert picture.read_bytes() == before and picture not in paths
    assert picture in listed(folder)  # and so kept the next time
    page = (folder / "report.html").read_text("utf-8")
    assert figures_in(page) == set(FIGURES) - set(OF_RECORDS) | {"morphology"}
    assert "records of the realisations are not in the folder" in page
    assert 'id="viewer"' not in page


def test_records_of_a_part_do_not_pass_for_the_study(folder):
    crumples = write_study(open_cube(folder / "cube.nc"), folder)
    assert StudyFiles.found(folder / "cube.nc").crumple_paths == tuple(crumples)
    crumples[0].with_name("response.nc").unlink()
    assert StudyFiles.found(folder / "cube.nc").crumple_paths == ()


def test_folder_without_a_cube_is_refused(tmp_path):
    with pytest.raises(ValueError, match="cube.nc does not exist"):
        redraw(tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["thesis", "resolved"])
def test_published_case_is_drawn_from_its_cube_as_it_is_tracked(tmp_path, name):
    tracked, study = RESULTS / name, tmp_path / name
    shutil.copytree(tracked, study)
    for table in TABLES:
        (study / f"{table}.csv").unlink()
    redrawn = redraw(study)
    assert "morphology" in redrawn.kept
    for table in TABLES:
        pd.testing.assert_frame_equal(
            pd.read_csv(study / f"{table}.csv"), pd.read_csv(tracked / f"{table}.csv"), rtol=1e-5
        )
    page = (study / "report.html").read_text("utf-8")
    status = open_cube(study / "cube.nc")["status"]
    converged = int((status == "converged").sum())
    assert f"{converged} of {status.size} realisations converged" in page
    assert "Published simulation" in page and "nothing published" not in page
    assert "data:image/png" in page.split('id="figure-morphology"')[1].split("</figure>")[0]
