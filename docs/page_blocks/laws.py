"""Blocks of the power law: coefficients, differences, trust, and the summary of both works."""

from __future__ import annotations

from collections.abc import Container, Iterator
from itertools import product

import numpy as np

from foilstudy.base.confidence import MeanInterval
from foilstudy.base.reference import published
from foilstudy.present.comparison import studied_case
from foilstudy.present.report.laws import SOURCES, Law
from foilstudy.present.statistics.cells import good, relative_mesh_error
from foilstudy.present.statistics.powerlaw import (
    LIMIT,
    PLAIN,
    TRUSTED,
    fit_power_law,
    law_samples,
)
from foilstudy.present.statistics.regression import LinearFit
from foilstudy.present.statistics.trust import assess_trust
from page_blocks.study import DIRECTIONS, Study, coefficient, displacement, listed, rows, short

NAMES = {
    TRUSTED: "mesh limit, trusted",
    LIMIT: "mesh limit, all",
    PLAIN: "mesh of the crumple, all",
    "simulation pre-stressed": "pre-stressed, mesh of the crumple, all",
    "simulation pre-stressed refined": "pre-stressed, relaxed again, all",
}
"""Sources of a law of a study."""


def headline(*studies: Study) -> Iterator[str]:
    """The law of the first study, those of the others and the published ones beside it."""
    yield from _laws(studies, (TRUSTED, LIMIT))


def law(*studies: Study) -> Iterator[str]:
    """Every law of the studies and the published ones, with their 95 % intervals."""
    yield from _laws(studies, SOURCES)


def _laws(studies: tuple[Study, ...], sources: Container[str]) -> Iterator[str]:
    """Coefficients of laws of some sources; that of the first study which answers is bold."""
    first, *others = studies
    body = []
    for k, direction in enumerate(first.laws):
        found = [
            (f"{study.mesh}, {NAMES[each.source]}", each)
            for study in studies
            for each in study.laws[k].laws
            if each.source in NAMES and each.source in sources
        ]
        if direction.answer:
            found[0] = f"**{found[0][0]}**", found[0][1]
        found += _same_thicknesses(first, others, k)
        found += [
            (each.source, each) for each in direction.laws if each.source.startswith("published")
        ]
        body += [_law_row(direction.direction, *each) for each in found]
    heads = ["", "law", "α", "β, overlength", "γ, thickness", "R²", "n"]
    yield from rows(heads, body)


def _same_thicknesses(first: Study, others: list[Study], k: int) -> Iterator[tuple[str, Law]]:
    """Laws of other studies over the thicknesses that the first one has, where they have more."""
    for study in others:
        shared = [t for t in study.thicknesses if t in first.thicknesses]
        if 1 < len(shared) < len(study.thicknesses):
            limit = study.laws_from(shared)[k].law(LIMIT)
            if limit is not None:
                yield f"{study.mesh}, mesh limit, {listed(shared)} µm", limit


def _law_row(direction: str, words: str, each: Law) -> list[str]:
    coefficients = [coefficient(c) for c in (each.alpha, each.beta, each.gamma)]
    count = f"{each.n:.0f}" if np.isfinite(each.n) else ""
    return [direction, words, *coefficients, f"{each.r2:.3f}", count]


def thin(study: Study, thinner: Study) -> Iterator[str]:
    """Laws of a study, and with the foil of another one that it leaves out, on their own meshes.

    And what the former says of the latter, beside what was measured.
    """
    left_out = [t for t in thinner.thicknesses if t not in study.thicknesses]
    body, beside = [], []
    for direction in DIRECTIONS:
        of, others = (law_samples(each.cube, direction, PLAIN) for each in (study, thinner))
        alone, together = fit_power_law(of), fit_power_law(of.with_those(others))
        for law, thicknesses in (
            (alone, study.thicknesses),
            (together, sorted({*left_out, *study.thicknesses})),
        ):
            body.append([direction, f"{listed(thicknesses)} µm", *_fitted(law.fit)])
        for thickness, overlength in product(left_out, thinner.overlengths):
            here = (others.thickness_um == thickness) & (others.overlength_percent == overlength)
            mean = MeanInterval.of(others.value[here])
            said = float(alone.law.stiffness(overlength, thickness))
            value, low, high = (short(each, 3) for each in (mean.mean, mean.low, mean.high))
            measured = f"{value} ({low} to {high})" if mean.n > 1 else value
            row = [short(overlength, 3), measured, short(said, 3), f"{mean.mean / said:.2f}"]
            beside.append([direction, str(thickness), *row])
    yield from rows(["", "law over", "α", "β, overlength", "γ, thickness", "R²", "n"], body)
    yield ""
    heads = ["", "µm", "overlength, %", "measured, N/m", "the law without it", "ratio"]
    yield from rows(heads, beside)


def _fitted(fit: LinearFit) -> list[str]:
    coefficients = [
        f"{fit.value[key]:.2f} ({fit.low[key]:.2f} to {fit.high[key]:.2f})"
        for key in ("constant", "overlength", "thickness")
    ]
    return [*coefficients, f"{fit.r2:.3f}", f"{fit.n}"]


def differences(study: Study) -> Iterator[str]:
    """How each published law differs from the one that answers."""
    for direction in study.laws:
        for each in direction.laws:
            if each.source.startswith("published"):
                words = each.differences or "not compared, as no configuration is trusted"
                yield f"- {direction.direction}, {each.source}: {words}"


def dimensionless(study: Study) -> Iterator[str]:
    """The laws that answer without units."""
    case = studied_case(study.cube)
    slender = case.gap_height_mm / case.diameter_mm
    for direction in study.laws:
        one = direction.dimensionless
        if one is None:
            yield f"- {direction.direction}: no law, as no configuration is trusted"
            continue
        yield (
            f"- {direction.direction}: k/(E t) = {one.constant:.2f} · (overlength/gap)^"
            f"{one.beta:.2f} · (t/R)^{one.gamma:.2f}, at a gap of {slender:.2f} diameters"
        )


def trust(study: Study) -> Iterator[str]:
    """What is trusted, and how large the stated mesh error is at most."""
    verdict, error = assess_trust(study.cube), relative_mesh_error(study.cube)
    trusted = verdict.trusted.all("direction")
    largest = error.max(("overlength", "seed", "direction"))
    slenderness = verdict.slenderness.max("overlength")
    folds = [_ends(row) for row in verdict.fold_angle.values]
    yield from rows(
        ["", *(f"{t} µm" for t in study.thicknesses)],
        [
            [
                "element over √(R t) (folds need 1 at most)",
                *(f"{s:.2f}" for s in slenderness.values),
            ],
            ["sharpest folds, degrees an element (60 at most)", *folds],
            ["largest stated mesh error of a value", *(f"{100 * e:.2g} %" for e in largest.values)],
            [
                "overlengths of which the stiffness is trusted",
                *(f"{int(t.sum())} of {t.size}" for t in trusted.values),
            ],
        ],
    )


def _ends(values: np.ndarray) -> str:
    return f"{values.min():.0f} to {values.max():.0f}"


def summary(*studies: Study) -> Iterator[str]:
    """What was published in a number, and ours."""
    theirs = published()
    laws = [theirs.power_laws[direction]["simulation"] for direction in DIRECTIONS]
    lines = {
        f"power law of the simulation, R² {_pair([each.r2 for each in laws], '.3f')}": _fits,
        f"its exponent of the overlength {_pair([each.beta.value for each in laws])}": (
            lambda study: _answers(study, "beta")
        ),
        f"its exponent of the thickness {_pair([each.gamma.value for each in laws])}": (
            lambda study: _answers(study, "gamma")
        ),
        "axial softer than radial": _softer,
        "axial scatters more": _scatter,
        "radial displacement {:g} to {:g} mm".format(*theirs.radial_displacement_range_mm): (
            lambda study: "{:.0f} to {:.0f} mm".format(*displacement(study))
        ),
    }
    body = [[words, *map(value, studies)] for words, value in lines.items()]
    yield from rows(["published (axial, radial)", *(study.mesh for study in studies)], body)


def _pair(values: list[float], form: str = ".2f") -> str:
    return ", ".join(f"{value:{form}}" for value in values)


def _fits(study: Study) -> str:
    return _pair([direction.best.r2 for direction in study.laws], ".3f")


def _answers(study: Study, name: str) -> str:
    return ", ".join(coefficient(getattr(direction.best, name)) for direction in study.laws)


def _softer(study: Study) -> str:
    mean = good(study.cube, "static_stiffness_converged").mean("seed")
    axial, radial = (mean.sel(direction=direction) for direction in DIRECTIONS)
    return f"in {int((axial < radial).sum())} of {axial.size} configurations"


def _scatter(study: Study) -> str:
    table = study.table("variability")
    cv = table[table["quantity"] == "static_stiffness"].groupby("direction")["cv"].median()
    medians = " against ".join(f"{100 * cv[direction]:.2g} %" for direction in DIRECTIONS)
    return f"median coefficient of variation {medians}"
