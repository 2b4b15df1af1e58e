"""Verdicts against shapes and histories whose verdict is known."""

import json
from dataclasses import replace
from pathlib import Path

import handmade
import numpy as np
import pandas as pd
import pytest
from conftest import FOIL
from handmade import COLUMNS, FOLDED, HOURGLASSED, RADIUS, RIDGED
from test_realisation import run, study

from foilstudy.base.record import read_record
from foilstudy.measure.verdicts import (
    FAULTS,
    VERDICTS,
    Evidence,
    flags,
    is_fault,
    names_of,
    verdicts,
)
from foilstudy.measure.verdicts.evidence import Way, least_stiffness, work_over_energy
from foilstudy.measure.verdicts.shape import (
    alternation,
    broad_wave_share,
    calmer_half,
    hidden_energy,
)
from foilstudy.model.foil import Imperfection
from foilstudy.model.supports.moves import Move
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.evidence import seen_in, sensors
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.choices import MASSES, PATHS
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.relaxation.scheme import Scheme

ELEMENT = 2 * np.pi * RADIUS / COLUMNS
FLAT = handmade.shape(0.0)


def seen(points):
    """What the sensors make of a shape."""
    return Evidence(
        "converged",
        broad_wave_share=broad_wave_share(points),
        calmer_half=calmer_half(points),
        alternation=alternation((points - FLAT) / ELEMENT),
    )


def names(evidence):
    return {each.name for each in verdicts(evidence)}


@pytest.mark.parametrize("name", FOLDED)
def test_a_fold_of_the_whole_cylinder_is_told_from_ridges(name):
    assert names(seen(FOLDED[name])) == {"converged", "folded_globally"}


@pytest.mark.parametrize("name", RIDGED)
def test_a_network_of_ridges_is_no_fault(name):
    assert names(seen(RIDGED[name])) == {"converged"}


@pytest.mark.parametrize("name", HOURGLASSED)
def test_a_checkerboard_is_an_hourglass(name):
    assert "hourglassed" in names(seen(HOURGLASSED[name]))


def test_a_perfect_cylinder_shows_nothing():
    assert np.isnan(broad_wave_share(FLAT)) and np.isnan(calmer_half(FLAT))
    assert np.isnan(alternation(np.zeros_like(FLAT)))
    assert names(seen(FLAT)) == {"converged"}


def test_sensors_do_not_depend_on_where_the_seam_is():
    points = RIDGED["ridges 0"]
    turned = np.roll(points, 17, axis=2)
    assert broad_wave_share(turned) == pytest.approx(broad_wave_share(points), rel=1e-12)
    before, after = (
        alternation((p - np.roll(FLAT, k, axis=2)) / ELEMENT)
        for p, k in ((points, 0), (turned, 17))
    )
    assert after == pytest.approx(before, rel=1e-12)


def test_alternation_is_one_of_a_checkerboard_and_a_half_of_noise():
    sign = (-1.0) ** (np.arange(40)[:, None] + np.arange(60)) * np.ones((3, 1, 1))
    assert alternation(0.1 * sign) == pytest.approx(1.0, abs=1e-12)
    noise = np.random.default_rng(0).normal(size=(3, 200, 300))
    assert alternation(noise) == pytest.approx(0.5, abs=0.02)


SOUND = {
    "status": "converged",
    "negative_eigenvalues": 0.0,
    "membrane_energy": 0.7,
    "bending_energy": 3.5,
    "broad_wave_share": 0.4,
    "calmer_half": 0.9,
    "alternation": -0.6,
    "hidden_energy": 0.05,
    "work_over_energy": 1.5,
    "self_crossing_share": 0.0,
    "beyond_yield_share": 0.0,
    "static_stiffness": (9e3, 3e4),
    "prestressed_stiffness": (2e3, 1e4),
    "least_stiffness": -1e-12,
}
CHANGES = {
    "saddle": {"negative_eigenvalues": 1.0},
    "locked": {"membrane_energy": 2.0},
    "singular": {"prestressed_stiffness": (np.nan, 1e4)},
    "spurious": {"static_stiffness": (-5.0, 3e4)},
    "hourglassed": {"alternation": 0.8},
    "folded_globally": {"broad_wave_share": 0.8, "calmer_half": 0.2},
    "self_crossing": {"self_crossing_share": 1e-3},
    "beyond_yield": {"beyond_yield_share": 0.4},
    "rate_dependent": {"work_over_energy": 30.0},
}


@pytest.mark.parametrize("name", CHANGES)
def test_each_number_has_its_verdict(name):
    assert names(Evidence(**SOUND)) == {"converged"}
    assert names(Evidence(**SOUND | CHANGES[name])) == {"converged", name}


def test_a_mild_hourglass_is_told_by_what_its_elements_do_not_see():
    assert "hourglassed" in names(Evidence(**SOUND | {"hidden_energy": 0.8}))


def test_a_ring_that_is_pulled_back_has_not_crumpled_a_foil_by_its_own_work():
    assert "rate_dependent" in names(Evidence(**SOUND | {"work_over_energy": -2.0}))


def test_an_indefinite_stiffness_is_spurious():
    assert names(Evidence(**SOUND | {"least_stiffness": -1e-3})) == {"converged", "spurious"}


@pytest.mark.parametrize(
    ("status", "expected"),
    [
        ("not_converged", {"not_converged", "budget_spent"}),
        ("diverged", {"diverged"}),
        ("failed", {"diverged"}),
    ],
)
def test_what_has_no_numbers_is_judged_by_its_end(status, expected):
    assert names(Evidence.of(status, {})) == expected


def test_what_is_not_known_convicts_nobody():
    assert names(Evidence("converged")) == {"converged"}


def test_flags_say_what_was_found():
    found = verdicts(Evidence(**SOUND | CHANGES["saddle"] | CHANGES["beyond_yield"]))
    assert names_of(flags(found)) == ("converged", "saddle", "beyond_yield")
    assert is_fault(flags(found)) and "saddle" in FAULTS
    assert not is_fault(flags(verdicts(Evidence(**SOUND | CHANGES["beyond_yield"]))))
    assert len({verdict.name for verdict in VERDICTS}) == len(VERDICTS)


def test_a_spring_between_rings_costs_nothing_as_a_whole_and_a_negative_one_shows():
    spring = np.kron(np.array([[1.0, -1.0], [-1.0, 1.0]]), np.diag([5.0, 5.0, 9.0, 1.0, 1.0, 2.0]))
    assert abs(least_stiffness(spring)) < 1e-12
    spring[[2, 2, 8, 8], [0, 6, 0, 6]] = spring[[0, 6, 0, 6], [2, 2, 8, 8]] = 8.0, -8.0, -8.0, 8.0
    assert least_stiffness(spring) < -0.01
    assert least_stiffness(-spring) == -1.0
    assert np.isnan(least_stiffness(np.nan * spring))


# --- trials of the map, labelled by method and picture ------------------------------------------

RESULTS = Path(__file__).parents[1] / "results"
LABELLED = json.loads((Path(__file__).parent / "reference/labelled.json").read_text())
HELD_BACK = [trial for trial in LABELLED if trial.get("held_back")]
"""Of 135 and 250 mm, labelled when all limits stood; one has moved since, see below."""
KNOWN = [trial for trial in LABELLED if trial not in HELD_BACK]
JUDGED = {"diverged", "folded_globally", "hourglassed", "locked"}


def judged(trial):
    return names(Evidence.of(trial["status"], trial["evidence"])) & JUDGED


def missed(trials):
    return [trial for trial in trials if set(trial["label"]) - judged(trial)]


def false(trials):
    return [trial for trial in trials if judged(trial) - set(trial["label"])]


def test_labelled_trials_are_judged_as_they_were_labelled():
    assert len(KNOWN) >= 60
    kinds = {label for trial in KNOWN for label in trial["label"]}
    assert kinds == JUDGED
    assert not missed(KNOWN)
    assert len(false(KNOWN)) < 0.05 * len(KNOWN), false(KNOWN)


def test_of_trials_that_were_held_back_none_is_convicted_and_only_known_ones_are_missed():
    """Three folds beside a ring that moves alone, at 92 %, are in doubt as hurried on the map.

    The shares of the labelled trials have four digits.
    """
    assert len(HELD_BACK) >= len(KNOWN)
    assert not false(HELD_BACK)
    assert len(missed(HELD_BACK)) <= 3
    table = pd.read_csv(RESULTS / "limits/limits.csv")
    for trial in missed(HELD_BACK):
        share = trial["evidence"]["broad_wave_share"]
        near = np.isclose(
            table["broad_wave_share"], share, rtol=0, atol=6e-5
        )  # four digits are kept
        same = table[near & (table["height_mm"] == trial["height_mm"])]
        assert same["verdicts"].str.contains("rate_dependent").all() and len(same), trial


# --- what elements do not see, and the work of the ring ------------------------------------------


@pytest.mark.parametrize("name", ["corner", "full", "uncontrolled"])
def test_a_checkerboard_in_the_sheet_is_hidden_from_elements_without_control_alone(name):
    start = uncrumpled(FOIL, Mesh(10e-3, name), Imperfection(amplitude=0.0))
    rows, columns = start.patch.shape[1:]
    sign = (-1.0) ** (np.arange(rows)[:, None] + np.arange(columns))
    points = start.points + 1e-3 * sign * np.array([0.0, 0.0, 1.0])[:, None, None]
    hidden = sensors(replace(start, points=points))["hidden_energy"]
    assert (hidden > 0.25) == (name == "uncontrolled"), hidden


def test_hidden_energy_is_one_ratio_over_another():
    assert hidden_energy(2.0, 200.0, 10e-3, 1e-3) == pytest.approx(1.0)
    assert np.isnan(hidden_energy(0.0, 0.0, 10e-3, 1e-3))


def test_a_spring_that_is_pressed_slowly_takes_all_the_work_that_is_done():
    height = np.linspace(0.2, 0.1, 50)
    force, step, still = 100 * (0.2 - height), np.arange(50.0), np.zeros(50)
    stored = 50 * 0.1**2
    slow = Way(step, height, force, still)
    assert work_over_energy(slow, stored) == pytest.approx(1.0, rel=1e-3)
    assert work_over_energy(replace(slow, force=5 * force), stored) == pytest.approx(5.0, rel=1e-3)
    assert np.isnan(work_over_energy(slow, 0.0))
    assert np.isnan(work_over_energy(Way(*(each[:1] for each in (step, height, force, still))), 1))
    # looked at five times: a static path knows its work, a motion does not, unless it was too fast
    seldom = [each[::10] for each in (step, height, force)]
    assert np.isfinite(work_over_energy(Way(*seldom, still[::10]), stored))
    assert work_over_energy(Way(*seldom, still[::10] + 1), stored) == np.inf
    assert np.isnan(work_over_energy(Way(100 * seldom[0], *seldom[1:], still[::10] + 1), stored))


# --- histories, labelled by what was done to the foil --------------------------------------------

OF_HISTORY = {
    "converged",
    "not_converged",
    "diverged",
    "budget_spent",
    "saddle",
    "rate_dependent",
}
"""Verdicts on the way; on elements as wide as these a shape says nothing."""
COARSE = Mesh(18e-3)
LUMPED = Scheme(mass=MASSES["courant"]())
SOUNDLY, HURRIED = {"converged"}, {"converged", "rate_dependent"}
HISTORIES = {
    "slow ramp": (RelaxationPath(2000), SOUNDLY),
    "lumped mass, slow ramp": (RelaxationPath(2000, LUMPED), SOUNDLY),
    "beyond the gap and back": (PATHS["installation"](2000, moves=(Move(1.1),)), SOUNDLY),
    "ramp of 60 steps": (RelaxationPath(60), HURRIED),
    "ramp of 20 steps": (RelaxationPath(20), HURRIED),
    "too small a mass": (
        RelaxationPath(1000, Scheme(mass=MASSES["spectral"](safety=0.6))),
        {"diverged"},
    ),
    "too long a step": (
        RelaxationPath(1000, Scheme(mass=MASSES["courant"](step_factor=1.5))),
        {"diverged"},
    ),
    "velocities cleared": (
        RelaxationPath(1000, Scheme.named("spectral", "kinetic_reset")),
        {"diverged"},
    ),
    "no steps left to settle": (
        RelaxationPath(1000, settling=SettleOptions(relaxation_steps_max=0, hessians_last=0)),
        {"not_converged", "budget_spent"},
    ),
    "Newton, 30 factorisations": (PATHS["newton"](budget=30), {"diverged", "budget_spent"}),
    "arc length, 40 factorisations": (
        PATHS["arc_length"](budget=40),
        {"diverged", "budget_spent"},
    ),
    "minimisation, 10 tangents": (
        PATHS["minimisation"](budget=10),
        {"diverged", "budget_spent"},
    ),
    "minimisation": (PATHS["minimisation"](steps=10), SOUNDLY),
}


@pytest.mark.parametrize("name", HISTORIES)
def test_a_history_is_judged_as_it_was_made(name):
    path, label = HISTORIES[name]
    crumpled = crumple(FOIL, COARSE, None, Method(path))
    found = names(seen_in(crumpled, crumpled.arrival)) & OF_HISTORY
    assert found == label, crumpled.message


def test_an_equilibrium_that_long_steps_have_found_is_a_saddle():
    foil = replace(FOIL, gap_height=FOIL.reference_height - 2e-4)
    path = PATHS["newton"](first_step=1.0)
    crumpled = crumple(foil, COARSE, Imperfection("smoothed", 10e-6, 36e-3), Method(path))
    found = names(seen_in(crumpled, crumpled.arrival)) & OF_HISTORY
    assert found == {"not_converged", "budget_spent", "saddle"}


def test_the_record_of_a_crumple_leads_to_the_same_verdict(tmp_path):
    config = study(relaxation={"ramp_steps": 120}, mesh={"element_size_mm": 18})
    run(config, tmp_path)
    values, attributes = read_record(tmp_path / "crumple.nc")
    crumpled = Crumpled.recorded(tmp_path / "crumple.nc")
    recorded = Evidence.of(attributes["status"], values)
    work = np.trapezoid(values["history_reaction_force"], -values["history_height"])
    stored = crumpled.problem().value(crumpled.points)
    assert recorded.work_over_energy == pytest.approx(work / stored, rel=1e-9)
    assert "rate_dependent" in names(recorded)
