"""The cube: complete, documented, deterministic, and refused when it is none."""

import shutil
import sys
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
import yaml

from foilstudy import load_config, open_cube
from foilstudy.base.record import read_attributes, read_record, write_record
from foilstudy.pipeline.crumple import crumple
from foilstudy.present.report.health import assess
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cube import gather
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.origins import refined_origin
from foilstudy.study.sweep.quantities import quantities
from foilstudy.study.sweep.respond import respond_job

CONFIG = load_config(
    {
        "study": {"name": "cube"},
        "sweep": {
            "thickness_um": [250, 500],
            "overlength_percent": [10],
            "realisations": 2,
        },
        "mesh": {"element_size_mm": 15},
        "relaxation": {"ramp_steps": 100, "relaxation_steps_max": 4000},
        "stiffness": {"refinements": 0},
        "dynamics": {
            "shown_max_hz": 100,
            "frequencies": 5,
            "eigenfrequencies": 3,
        },
    }
)
REFINED_ONCE = {"refinements": 0, "relaxed_refinements": 1}
CRASHED, DIVERGED = (0, 0, 1), (1, 0, 0)
"""Cells (thickness, overlength, seed) whose records are spoilt."""


def folder_of(results, cell):
    return results / "realisations" / cell.thickness_id / cell.overlength_id / str(cell.seed)


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Four realisations, of which one crashes while measured and one diverges."""
    results = tmp_path_factory.mktemp("results")
    for index, cell in zip(np.ndindex(2, 1, 2), CONFIG.cells(), strict=True):
        folder = folder_of(results, cell)
        with pytest.MonkeyPatch.context() as patch:
            if index == DIVERGED:
                patch.setattr(sys.modules["foilstudy.pipeline.retry"], "crumple", absurd)
            crumple_job(CONFIG.crumple_task(cell), folder / "crumple.nc")
            if index == CRASHED:
                patch.setattr(
                    sys.modules["foilstudy.study.sweep.respond"], "fixed_stiffness", explode
                )
            respond_job(CONFIG.response_task(cell), folder / "crumple.nc", folder / "response.nc")
    cylinder_bounds(CONFIG, results / "cylinder.nc")
    return results


def absurd(foil, mesh, imperfection, method):
    """A crumple that diverges in the place of the one that was asked for."""
    return crumple(foil, mesh, replace(imperfection, amplitude=1.0), method)


def explode(*_):
    raise RuntimeError("no factor")


@pytest.fixture(scope="module")
def cube(results):
    gather(CONFIG, results, results / "cube.nc")
    with xr.open_dataset(results / "cube.nc") as file:
        return file.load()


def test_cube_holds_what_the_records_hold(results, cube):
    cell = CONFIG.cells()[0]
    crumpled, _ = read_record(folder_of(results, cell) / "crumple.nc")
    responded, _ = read_record(folder_of(results, cell) / "response.nc")
    at = cube.isel(thickness=0, overlength=0, seed=0)
    assert at.status == "converged"
    np.testing.assert_array_equal(at.static_stiffness, responded["static_stiffness"])
    np.testing.assert_array_equal(at.dynamic_stiffness_im, responded["dynamic_stiffness_im"])
    np.testing.assert_array_equal(at.frequency, responded["frequency"])
    np.testing.assert_array_equal(at.eigenfrequency, responded["eigenfrequency"])
    assert at.bending_energy == crumpled["bending_energy"]
    assert at.radial_displacement_max == crumpled["radial_displacement_max"] * 1e3
    assert at.element_size == crumpled["element_size"] * 1e3
    np.testing.assert_array_equal(cube.reference_height, [143.0])
    np.testing.assert_array_equal(cube.overlength, [10.0])
    np.testing.assert_array_equal(cube.thickness, [250.0, 500.0])


def test_dimensions_are_those_of_the_contract(cube):
    cell = ("thickness", "overlength", "seed")
    assert cube.static_stiffness.dims == (*cell, "direction")
    assert cube.interface_stiffness.dims == (*cell, "interface_dof", "interface_dof_in")
    assert cube.dynamic_stiffness_re.dims == (*cell, "definition", "direction", "frequency")
    assert cube.first_eigenfrequency.dims == cell and cube.message.dims == cell
    assert cube.direction.values.tolist() == ["axial", "radial"]
    assert cube.definition.values.tolist() == ["transfer", "driving", "relative"]
    assert cube.interface_dof.values[[0, 11]].tolist() == ["bottom_ux", "top_rz"]


def test_spoilt_cells_are_flagged_and_empty(cube):
    for index, status, message in (
        (CRASHED, "failed", "RuntimeError: no factor"),
        (DIVERGED, "diverged", "unstable"),
    ):
        at = cube.isel(dict(zip(("thickness", "overlength", "seed"), index, strict=True)))
        assert at.status == status and message in str(at.message.values)
        for name, variable in cube.data_vars.items():
            if variable.dtype.kind == "f" and "seed" in variable.dims:
                assert np.isnan(at[name]).all(), name
    whole = cube.isel(thickness=1, seed=1)
    assert whole.status.item() == "converged"
    for name, variable in whole.data_vars.items():
        if variable.dtype.kind == "f" and "seed" in cube[name].dims:
            # without a refinement there is no refined value
            if "refined" not in name and not name.endswith(("_converged", "_mesh_error")):
                assert np.isfinite(variable).any(), name


def test_a_record_of_refining_counts_only_where_the_study_asks_for_it(results, cube, tmp_path):
    """One left by an earlier setting is not read; one that did not settle is flagged."""
    shutil.copytree(results, tmp_path, dirs_exist_ok=True)
    asked = load_config(CONFIG.model_dump(mode="json") | {"stiffness": REFINED_ONCE})
    for cell in asked.cells():
        attributes = {"status": "converged", "message": "relaxed"}
        values = {"prestressed_stiffness_converged": np.array([1.0, 2.0])}
        if cell.seed == 0:
            attributes = {"status": "not_converged", "message": "refinement 1: step limit"}
            values = {}
        folder = folder_of(tmp_path, cell)
        origin = refined_origin(asked.refine_task(cell), read_attributes(folder / "crumple.nc"))
        write_record(folder / "refined.nc", quantities(values), attributes, origin)
    ignored = gather(CONFIG, tmp_path, tmp_path / "without.nc")
    xr.testing.assert_equal(ignored, cube)
    relaxed = gather(asked, tmp_path, tmp_path / "with.nc")
    stopped = relaxed.isel(thickness=0, overlength=0, seed=0)
    assert (stopped.status, stopped.refined_status) == ("converged", "not_converged")
    assert str(stopped.message.values).endswith("; relaxed again: refinement 1: step limit")
    (flagged,) = [c for c in assess(relaxed).flagged if c.status == "converged"]
    assert (flagged.thickness_um, flagged.seed) == (250, 0)
    whole = relaxed.isel(thickness=1, overlength=0, seed=1)
    assert whole.refined_status == "converged" and whole.prestressed_stiffness_converged[1] == 2.0


def test_every_variable_has_units_and_a_name(cube):
    for name, variable in cube.variables.items():
        assert variable.attrs.get("units"), name
        assert variable.attrs.get("long_name"), name


def test_numbers_are_double_precision(cube):
    for name, variable in cube.drop_vars("verdict").items():
        assert variable.dtype.kind in "UO" or variable.dtype == np.float64, name


def test_provenance_is_carried(cube):
    assert cube.attrs["study"] == "cube"
    assert {"git_commit", "package_versions", "created"} <= cube.attrs.keys()
    assert load_config(yaml.safe_load(cube.attrs["config"])) == CONFIG


def test_gathering_is_deterministic(results, cube, tmp_path):
    gather(CONFIG, results, tmp_path / "again.nc")
    with xr.open_dataset(tmp_path / "again.nc") as file:
        again = file.load()
    xr.testing.assert_equal(cube, again)
    attributes = [dict(c.attrs) | {"created": ""} for c in (cube, again)]
    assert attributes[0] == attributes[1]


def test_cube_appears_whole_or_not_at_all(results, tmp_path, monkeypatch):
    path = tmp_path / "new" / "cube.nc"

    def half(self, target, **_):
        target.write_bytes(b"half a cube")
        raise OSError("disk full")

    monkeypatch.setattr(xr.Dataset, "to_netcdf", half)
    with pytest.raises(OSError, match="disk full"):
        gather(CONFIG, results, path)
    assert list(path.parent.iterdir()) == []


def test_open_cube_makes_the_dynamic_stiffness_complex(results, cube):
    opened = open_cube(results / "cube.nc")
    dynamic = opened.dynamic_stiffness
    assert dynamic.dtype == np.complex128
    np.testing.assert_array_equal(dynamic.real, cube.dynamic_stiffness_re)
    np.testing.assert_array_equal(dynamic.imag, cube.dynamic_stiffness_im)
    assert dynamic.attrs["units"] == "N/m" and dynamic.attrs["long_name"]
    assert "dynamic_stiffness_re" not in opened
    shutil.copy(results / "cube.nc", results / "moved.nc")
    assert open_cube(str(results / "moved.nc")).equals(opened)


def wrong_files(results, tmp_path):
    text = tmp_path / "cube.txt"
    text.write_text("not a cube")
    empty = tmp_path / "empty.nc"
    empty.touch()
    other = tmp_path / "other.nc"
    write_record(other, {}, {"title": "something else"})
    record = folder_of(results, CONFIG.cells()[0]) / "crumple.nc"
    cut = tmp_path / "cut.nc"
    cut.write_bytes((results / "cube.nc").read_bytes()[:3000])
    return {
        "missing": tmp_path / "missing.nc",
        "folder": tmp_path,
        "text": text,
        "empty": empty,
        "record": record,
        "other": other,
        "cut": cut,
    }


@pytest.mark.parametrize("kind", ["missing", "folder", "text", "empty", "record", "other", "cut"])
def test_open_cube_refuses_another_file_in_one_sentence(results, cube, tmp_path, kind):
    path = wrong_files(results, tmp_path)[kind]
    with pytest.raises(ValueError) as caught:
        open_cube(path)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert "\n" not in message and message.endswith(".") and ";" in message  # what, and what to do
