"""A crumple that fails is tried again with safer settings, on record and never silently."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from conftest import FOIL
from test_realisation import run, study

from foilstudy.linalg import SolveError
from foilstudy.measure.verdicts import Evidence
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline import retry
from foilstudy.pipeline.crumpled import Crumpled, Recipe
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.retry import attempted, safer
from foilstudy.present.report.equilibrium import Equilibrium, Settling, equilibrium_findings
from foilstudy.solve.choices import MASSES, PATHS
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.relaxation.scheme import Scheme
from foilstudy.study.sweep.cube import has
from foilstudy.study.sweep.quantities import QUANTITIES

UNSTABLE = Scheme(mass=MASSES["spectral"](safety=0.5))
"""Beyond the stable step: it diverges in every ramp."""


def recipe(**path):
    return Recipe(Mesh(12e-3), Imperfection(), Method(RelaxationPath(ramp_steps=1000, **path)))


def test_a_crumple_that_diverges_is_tried_again_and_says_so():
    attempts = attempted(FOIL, recipe(scheme=UNSTABLE), 1)
    crumpled = attempts.crumpled
    assert (attempts.number, crumpled.status) == (2, "converged")
    assert "; safer settings, after attempt 1: diverged (the stepping" in attempts.message
    # what made it stands in its recipe
    path = crumpled.method.path
    assert path.scheme.mass.safety == 3.0 and path.ramp_steps == 8000


def test_a_sound_crumple_is_made_once_and_is_that_of_no_retries():
    asked, plain = (attempted(FOIL, recipe(), retries) for retries in (2, 0))
    assert asked.number == plain.number == 1 and asked.message == plain.message
    np.testing.assert_array_equal(asked.crumpled.points, plain.crumpled.points)


def test_where_every_attempt_fails_the_first_stands_with_the_words_of_all(monkeypatch):
    monkeypatch.setattr(retry, "safer", lambda method, foil, attempt: method)
    attempts = attempted(FOIL, recipe(scheme=UNSTABLE), 2)
    assert attempts.number == 1 and attempts.crumpled.status == "diverged"
    assert "no safer attempt was sound, after attempt 2: diverged" in attempts.message
    assert "attempt 3: diverged" in attempts.message


def test_a_computation_that_fails_is_tried_again_and_raised_if_that_is_in_vain(monkeypatch):
    sound = attempted(FOIL, recipe(), 0).crumpled

    def failing(*_):
        made.append(1)
        if len(made) < works_at:
            raise SolveError("no factor")
        return sound

    monkeypatch.setattr(retry, "crumple", failing)
    made, works_at = [], 2
    attempts = attempted(FOIL, recipe(), 1)
    assert attempts.number == 2 and "attempt 1: SolveError: no factor" in attempts.message
    made, works_at = [], 9
    with pytest.raises(SolveError, match="no factor"):
        attempted(FOIL, recipe(), 1)
    assert len(made) == 2


@pytest.mark.parametrize(
    ("verdicts", "element", "size", "again"),
    [
        ({"negative_eigenvalues": 1}, "corner", 5e-3, True),
        ({"broad_wave_share": 0.95}, "corner", 18e-3, True),
        ({"alternation": 0.7}, "corner", 5e-3, True),  # in too fast a ramp
        ({"alternation": 0.7}, "corner", 18e-3, False),  # the mesh does it
        ({"alternation": 0.7}, "uncontrolled", 5e-3, False),
        ({"self_crossing_share": 0.1}, "corner", 5e-3, False),
    ],
)
def test_only_what_a_safer_setting_may_cure_is_tried_again(
    verdicts, element, size, again, monkeypatch
):
    evidence = Evidence("converged", **verdicts)
    monkeypatch.setattr(retry, "seen_in", lambda *_: evidence)
    arrival = SimpleNamespace(status="converged", message="", negative_eigenvalues=0)
    nothing = np.zeros(0)
    crumpled = Crumpled(FOIL, None, nothing, nothing, None, None, arrival)
    monkeypatch.setattr(retry, "crumple", lambda *_: crumpled)
    _, failed = retry._attempt(FOIL, Recipe(Mesh(size, element), Imperfection(), Method()))
    assert bool(failed) == again


@pytest.mark.parametrize("kind", list(PATHS))
def test_every_path_has_a_safer_one(kind):
    method = Method(PATHS[kind]())
    second, third = (safer(method, FOIL, attempt).path for attempt in (2, 3))
    assert safer(method, FOIL, 1) is method
    assert second.kind == ("installation" if kind == "installation" else "relaxation")
    assert third.ramp_steps == 4 * second.ramp_steps >= 8000
    assert third.scheme.mass.safety > second.scheme.mass.safety > Scheme().mass.safety
    assert third.settling.relaxation_steps_max > second.settling.relaxation_steps_max


def test_a_record_says_which_attempt_it_is_of(tmp_path):
    careless = {"mass": "courant", "path": "ring_alone"}
    config = study(relaxation={"ramp_steps": 30}, method=careless | {"retries": 1})
    records = run(config, tmp_path)
    assert records.crumple["attempt"] == 2
    assert '"kind": "spectral"' in records.crumple_attributes["method"]
    assert "after attempt 1: " in records.response_attributes["message"]
    assert Crumpled.recorded(tmp_path / "crumple.nc").method.path.ramp_steps == 8000


def test_the_report_counts_them_and_the_cube_has_them_only_where_asked_for():
    found = Equilibrium(1e-8, 0, (Settling(500.0, 6, 6, 1e-9, None, None),), 6, retried=2)
    assert "Of 2 crumples that failed as configured" in " ".join(equilibrium_findings(found))
    none = replace(found, retried=0)
    assert "attempt" not in " ".join(equilibrium_findings(none))
    for retries in (0, 1):
        assert has(study(method={"retries": retries}), QUANTITIES["attempt"]) == bool(retries)
