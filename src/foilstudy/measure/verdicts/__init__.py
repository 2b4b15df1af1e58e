"""Verdicts on a realisation: computed from its numbers, with documented limits.

`VERDICTS` has one line for each. A fault makes the realisation worthless for statistics; the
others say where the model ends, or how the search did.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from foilstudy.measure.verdicts.evidence import Evidence

__all__ = [
    "DOUBTS",
    "FAULTS",
    "VERDICTS",
    "Evidence",
    "Verdict",
    "flags",
    "is_fault",
    "names_of",
    "verdicts",
]

BROAD_MAX = 0.9
"""Share of broad waves (`broad_wave_share`) from which a cylinder has folded as a whole: 0.29 to
0.75 in the crumples of the published case, 1 of a concertina, a pleat or a kink."""

BROAD_BESIDE_CALM, CALM = 0.6, 0.5
"""The same where the calmer half of the height is displaced less than this share of the other one
(`calmer_half`): a fold beside a ring. Crumples of the published case have 0.54 and more."""

ALTERNATION_MAX = 0.5
"""Alternation above which elements hourglass: that of white noise. Resolved crumples have -0.87 to
-0.43, those of 50 um on elements of 5 mm, which do not resolve them, up to 0.41."""

HIDDEN_MAX = 0.25
"""Energy that elements do not see (`hidden_energy`) above which they hourglass: 0.01 to 0.075 in
every crumple of the map by a sound element, resolved or not, 0.8 to 2.9 without hourglass control
on elements of 5 and 10 mm, where a mild checkerboard hides among folds (docs/limits.md)."""

BENDING_MIN = 2.0
"""Bending over membrane energy below which a sheet locks: ridges have 5 (T. Witten, Rev. Mod. Phys.
79, 2007), crumples of the published case 4 to 10, elements of 18 mm 0.2 to 2."""

WORK_MAX = 10.0
"""Work of the top ring over the energy stored at rest beyond which the crumple belongs to the rate
of its ramp: 1.3 to 2.5 in the default ramp. Beyond it foil of 100 um stores up to two fifths more,
and one of 92 % overlength is twice as stiff axially; up to 9 no difference is seen."""

STIFFNESS_MIN = -1e-6
"""Of the scaled interface stiffness, whose rigid motions are zero but for rounding."""


@dataclass(frozen=True)
class Verdict:
    """One thing that may be said of a realisation.

    Attributes
    ----------
    name : str
    words : str
        What it means, for a sentence after a colon.
    holds : callable
        Of an `Evidence`; False where that does not know.
    fault : bool
        Whether the realisation must not enter any mean.
    doubt : bool
        Whether no configuration is trusted, most of whose realisations have it.
    cure : str
        What to do instead.
    """

    name: str
    words: str
    holds: Callable[[Evidence], bool]
    fault: bool = False
    doubt: bool = False
    cure: str = ""


def _spurious(e: Evidence) -> bool:
    negative = any(k < 0 for k in e.static_stiffness)
    return negative or e.least_stiffness < STIFFNESS_MIN


def _locked(e: Evidence) -> bool:
    return e.bending_energy < BENDING_MIN * e.membrane_energy


def _folded(e: Evidence) -> bool:
    beside_ring = e.broad_wave_share > BROAD_BESIDE_CALM and e.calmer_half < CALM
    return e.broad_wave_share > BROAD_MAX or beside_ring


def _hourglassed(e: Evidence) -> bool:
    return e.alternation > ALTERNATION_MAX or e.hidden_energy > HIDDEN_MAX


def _rate_dependent(e: Evidence) -> bool:
    # a ring that is pulled back by what still swings has done no work
    return e.work_over_energy > WORK_MAX or e.work_over_energy < 0


def _singular(e: Evidence) -> bool:
    return not np.isfinite([*e.static_stiffness, *e.prestressed_stiffness]).all()


VERDICTS = (
    Verdict(
        "converged",
        "the forces on the free foil vanish beside those on the rings",
        lambda e: e.status == "converged",
    ),
    Verdict(
        "not_converged",
        "forces on the free foil are left",
        lambda e: e.status == "not_converged",
        cure="raise relaxation.relaxation_steps_max",
    ),
    Verdict(
        "diverged",
        "the motion grew without bound, or the path or the computation ended before the gap",
        lambda e: e.status in ("diverged", "failed"),
        fault=True,
        cure="use the spectral mass with a safety of 1.5, or more steps of ramp",
    ),
    Verdict(
        "budget_spent",
        "the search ended for want of steps or factorisations",
        lambda e: e.budget_spent,
        cure="raise relaxation.relaxation_steps_max, or relax instead of following the path",
    ),
    Verdict(
        "saddle",
        "the equilibrium is not stable: a small push moves the foil elsewhere",
        lambda e: e.negative_eigenvalues > 0,
        fault=True,
        cure="let the relaxation go on; it leaves a saddle by itself",
    ),
    Verdict(
        "singular",
        "a tangent has no inverse, so that a stiffness is not defined",
        _singular,
        cure="settle to a smaller residual, on a finer mesh",
    ),
    Verdict(
        "folded_globally",
        "the cylinder has folded as a whole, instead of crumpling into ridges",
        _folded,
        fault=True,
        cure="use the spectral mass and a slower ramp, and give the foil an imperfection",
    ),
    Verdict(
        "hourglassed",
        "neighbouring elements twist against each other",
        _hourglassed,
        doubt=True,
        cure="use mesh.element: corner",
    ),
    Verdict(
        "locked",
        "ridges stretch instead of bending, so that the elements are too stiff or too wide",
        _locked,
        doubt=True,
        cure="use mesh.element: corner, on a finer mesh",
    ),
    Verdict(
        "spurious",
        "a stress-free stiffness is negative",
        _spurious,
        fault=True,
        cure="measure the tangent of the shape that is stress-free (method.stress_removal: reset)",
    ),
    Verdict(
        "self_crossing",
        "parts of the surface cross each other, as the model has no contact",
        lambda e: e.self_crossing_share > 0,
        cure="let parts of the foil touch (contact.kind: barrier)",
    ),
    Verdict(
        "beyond_yield",
        "parts of the surface are beyond the yield stress: yielded, where the foil may yield",
        lambda e: e.beyond_yield_share > 0,
    ),
    Verdict(
        "rate_dependent",
        "the ring did many times the work that is stored, so that the way belongs to its rate",
        _rate_dependent,
        doubt=True,
        cure="leave relaxation.ramp_steps out, or give more",
    ),
)
"""In the order of their bits in `flags`; new ones come last."""

FAULTS = tuple(verdict.name for verdict in VERDICTS if verdict.fault)
DOUBTS = tuple(verdict.name for verdict in VERDICTS if verdict.doubt)


def verdicts(evidence: Evidence) -> tuple[Verdict, ...]:
    """All that hold of a realisation."""
    return tuple(verdict for verdict in VERDICTS if verdict.holds(evidence))


def flags(found: Iterable[Verdict]) -> int:
    """As one number, a bit for each of `VERDICTS`."""
    names = {verdict.name for verdict in found}
    return sum(1 << bit for bit, each in enumerate(VERDICTS) if each.name in names)


def is_fault(number: float) -> bool:
    """Whether there is a fault behind `flags`."""
    return any(name in FAULTS for name in names_of(number))


def names_of(number: float) -> tuple[str, ...]:
    """The verdicts behind `flags`, which a record holds as a float."""
    return tuple(each.name for bit, each in enumerate(VERDICTS) if int(number) >> bit & 1)
