"""Verdicts against shapes and histories whose verdict is known."""

import json
from pathlib import Path

import handmade
import numpy as np
import pytest
from handmade import COLUMNS, FOLDED, HOURGLASSED, RADIUS, RIDGED

from foilstudy.measure.verdicts import (
    FAULTS,
    VERDICTS,
    Evidence,
    flags,
    is_fault,
    names_of,
    verdicts,
)
from foilstudy.measure.verdicts.evidence import least_stiffness
from foilstudy.measure.verdicts.shape import alternation, broad_wave_share, calmer_half

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
}


@pytest.mark.parametrize("name", CHANGES)
def test_each_number_has_its_verdict(name):
    assert names(Evidence(**SOUND)) == {"converged"}
    assert names(Evidence(**SOUND | CHANGES[name])) == {"converged", name}


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

LABELLED = json.loads((Path(__file__).parent / "reference/labelled.json").read_text())
JUDGED = {"diverged", "folded_globally", "hourglassed", "locked"}
MILD = "element uncontrolled"
"""Whose checkerboard of half a millimetre in elements of 5 mm hides among the folds of 500 um."""


def judged(trial):
    return names(Evidence.of(trial["status"], trial["evidence"])) & JUDGED


def test_labelled_trials_are_judged_as_they_were_labelled():
    assert len(LABELLED) >= 60
    kinds = {label for trial in LABELLED for label in trial["label"]}
    assert kinds == JUDGED
    missed = [t for t in LABELLED if set(t["label"]) - judged(t)]
    assert all(trial["method"] == MILD for trial in missed)
    wrong = [t for t in LABELLED if judged(t) - set(t["label"])]
    assert len(wrong) < 0.05 * len(LABELLED), wrong
