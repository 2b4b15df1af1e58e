"""One realisation from its task to its files, whatever happens."""

import sys
from types import SimpleNamespace

import netCDF4
import numpy as np
import pytest

from foilstudy.base.record import Quantity, read_record, write_record
from foilstudy.config import load_config
from foilstudy.measure.stiffness import fixed_stiffness
from foilstudy.model.patch import knot_points
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.respond import respond_job


def study(**sections):
    """A configuration of seconds: far too coarse to mean anything."""
    return load_config(
        {
            "sweep": {
                "thickness_um": [500],
                "reference_height_mm": [150],
                "realisations": 1,
            },
            "mesh": {"element_size_mm": 15},
            "relaxation": {"ramp_steps": 100, "relaxation_steps_max": 4000},
            "stiffness": {"refinements": 1},
            "dynamics": {
                "shown_max_hz": 100,
                "frequencies": 5,
                "eigenfrequencies": 3,
            },
        }
        | sections
    )


def run(config, folder):
    """Both records of the first cell."""
    cell = config.cells()[0]
    crumpled, responded = folder / "crumple.nc", folder / "response.nc"
    crumple_job(config.crumple_task(cell), crumpled)
    respond_job(config.response_task(cell), crumpled, responded)
    return SimpleNamespace(
        crumple=read_record(crumpled)[0],
        crumple_attributes=read_record(crumpled)[1],
        response=read_record(responded)[0],
        response_attributes=read_record(responded)[1],
    )


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    return run(study(), tmp_path_factory.mktemp("records"))


def assert_documented(path):
    with netCDF4.Dataset(path) as file:
        assert file.variables
        for variable in file.variables.values():
            assert variable.units and variable.long_name


def test_records_of_a_crumple_agree_with_each_other(records):
    values, attributes = records.crumple, records.crumple_attributes
    assert attributes["status"] == "converged"
    assert attributes["thickness_um"] == 500 and attributes["seed"] == 0
    assert attributes["overlength_percent"] == pytest.approx(100 * 20 / 130, rel=1e-12)
    np.testing.assert_array_equal(values["surface"], knot_points(values["control_points"]))
    radius = np.hypot(*values["surface"][:2]) - np.hypot(*values["reference_surface"][:2])
    np.testing.assert_array_equal(values["radial_displacement"], radius)
    assert values["radial_displacement_min"] == radius.min()
    assert values["radial_displacement_max"] == radius.max()
    for energy in ("membrane", "bending", "stabilisation"):
        last = values[f"history_{energy}_energy"][-1]
        assert last == pytest.approx(values[f"{energy}_energy"], rel=1e-12)
    assert values["history_step"][-1] == values["steps"] + values["newton_steps"]
    assert values["equilibrium_residual"] <= 1e-8
    assert 0 <= values["beyond_yield_share"] <= 1 and 0 <= values["self_crossing_share"] <= 1


def test_records_of_a_response_agree_with_each_other(records):
    values = records.response
    assert records.response_attributes["status"] == "converged"
    assert values["interface_stiffness"].shape == (12, 12)
    fixed = fixed_stiffness(values["interface_stiffness"])
    np.testing.assert_array_equal(values["static_stiffness"], fixed)
    step = np.abs(values["static_stiffness_converged"] - values["static_stiffness"])
    assert (values["static_stiffness_mesh_error"] >= step / 3).all()
    assert values["dynamic_stiffness_re"].shape == (3, 2, 5)
    assert values["frequency"][[0, -1]].tolist() == [1.0, 100.0]
    assert values["eigenfrequency"][0] == values["first_eigenfrequency"]
    assert records.crumple["negative_eigenvalues"] == 0


def test_refinements_by_need_are_recorded(records, tmp_path):
    """As many as the demand takes; the same numbers as those of the ladder that ends there."""
    assert records.response["static_refinements"] == 1
    loose = run(
        study(stiffness={"error_percent": 20, "refinements": 1}), tmp_path / "loose"
    ).response
    tight = run(study(stiffness={"error_percent": 0.01}), tmp_path / "tight").response
    assert (loose["static_refinements"], tight["static_refinements"]) == (1, 2)
    name = "static_stiffness_converged"
    np.testing.assert_array_equal(loose[name], records.response[name])
    shares = [r["static_stiffness_mesh_error"] / r[name] for r in (loose, tight)]
    # elements of 15 mm: a stated error of 38 % a quarter of h2/(R t)
    assert (shares[0] <= 0.44).all() and (shares[1] > 0.0001).all()


def test_every_variable_says_what_it_is(tmp_path):
    config = study()
    run(config, tmp_path)
    cylinder_bounds(config, tmp_path / "cylinder.nc")
    for name in ("crumple.nc", "response.nc", "cylinder.nc"):
        assert_documented(tmp_path / name)


def test_a_realisation_is_the_same_every_time(records, tmp_path):
    again = run(study(), tmp_path)
    for first, second in ((records.crumple, again.crumple), (records.response, again.response)):
        assert first.keys() == second.keys()
        for name in first:
            if not name.startswith(("seconds_", "peak_memory")):
                np.testing.assert_array_equal(first[name], second[name], err_msg=name)


def test_an_equilibrium_out_of_reach_keeps_the_numbers(tmp_path):
    """Rounding alone leaves more than the residual asked for."""
    relaxation = {"ramp_steps": 100, "relaxation_steps_max": 100, "residual_tolerance": 1e-30}
    records = run(study(relaxation=relaxation), tmp_path)
    assert records.crumple_attributes["status"] == "not_converged"
    assert records.response_attributes["status"] == "not_converged"
    assert records.response_attributes["message"] == records.crumple_attributes["message"]
    assert np.isfinite(records.response["static_stiffness"]).all()


def test_an_absurd_imperfection_becomes_a_flagged_record(tmp_path):
    """A metre of noise on a cylinder of 0.2 m, and too few steps to come to rest."""
    relaxation = {"ramp_steps": 20, "relaxation_steps_max": 20}
    records = run(study(imperfection={"amplitude_um": 1e6}, relaxation=relaxation), tmp_path)
    assert records.crumple_attributes["status"] == "diverged"
    assert "unstable" in records.crumple_attributes["message"]
    assert "control_points" not in records.crumple
    assert records.response_attributes["status"] == "diverged"
    assert set(records.response) == {"peak_memory", "verdict"}
    assert_documented(tmp_path / "crumple.nc")


def test_a_fault_of_the_machine_is_no_record(tmp_path, monkeypatch):
    def explode(*_):
        raise MemoryError("no room for the history")

    monkeypatch.setattr(sys.modules["foilstudy.pipeline.retry"], "crumple", explode)
    with pytest.raises(MemoryError):
        run(study(), tmp_path)
    assert not list(tmp_path.iterdir())


def test_a_crash_while_crumpling_becomes_a_flagged_record(tmp_path, monkeypatch):
    def explode(*_):
        raise ArithmeticError("no root")

    monkeypatch.setattr(sys.modules["foilstudy.pipeline.retry"], "crumple", explode)
    records = run(study(), tmp_path)
    assert records.crumple_attributes["status"] == "failed"
    assert records.crumple_attributes["message"] == "ArithmeticError: no root"
    assert records.response_attributes["status"] == "failed"
    assert records.response_attributes["message"] == "ArithmeticError: no root"


def test_a_crash_while_measuring_becomes_a_flagged_record(tmp_path, monkeypatch):
    def explode(*_):
        raise RuntimeError("no factor")

    monkeypatch.setattr(sys.modules["foilstudy.study.sweep.respond"], "vibration_of", explode)
    records = run(study(), tmp_path)
    assert records.crumple_attributes["status"] == "converged"
    assert records.response_attributes["status"] == "failed"
    assert records.response_attributes["message"] == "RuntimeError: no factor"
    assert set(records.response) == {"peak_memory", "verdict"}


def test_a_record_appears_whole_or_not_at_all(tmp_path):
    path = tmp_path / "record.nc"
    good = Quantity(np.arange(3.0), "m", "a length", ("x",))
    bad = Quantity(np.arange(4.0), "m", "another length", ("x",))  # does not fit the dimension
    with pytest.raises(Exception, match=r"."):
        write_record(path, {"good": good, "bad": bad}, {})
    assert list(tmp_path.iterdir()) == []
    write_record(path, {"good": good}, {"status": "converged"})
    with pytest.raises(Exception, match=r"."):
        write_record(path, {"good": good, "bad": bad}, {})
    values, attributes = read_record(path)  # the earlier one is untouched
    np.testing.assert_array_equal(values["good"], good.values)
    assert attributes["status"] == "converged"
    assert attributes["git_commit"]
    assert [p.name for p in tmp_path.iterdir()] == ["record.nc"]


def test_the_cylinder_bounds_its_crumples(records, tmp_path):
    cylinder_bounds(study(), tmp_path / "cylinder.nc")
    values, _ = read_record(tmp_path / "cylinder.nc")
    assert values["cylinder_stiffness"].shape == (1, 1, 2)
    assert (records.response["static_stiffness"] < values["cylinder_stiffness"][0, 0]).all()
