"""What foil costs that yields, or whose parts touch: a section of results.md.

    .venv/bin/python benchmarks/real_foil.py        ten minutes
    .venv/bin/python benchmarks/real_foil.py 170    steps at this height alone, mm

Processor time on one core: of a step of the way from the cylinder to the end of the ramp, the foils
in turns; and of whole realisations by models of config/real.yaml. What everything else on the
machine takes from the caches counts: run it on one that is idle.
"""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace

from measuring import write_section  # isort: skip

from foilstudy.base.provenance import machine
from foilstudy.base.tables import markdown_table
from foilstudy.model.contact.options import BarrierContact
from foilstudy.model.foil import Imperfection
from foilstudy.model.materials import Material
from foilstudy.pipeline.crumple import uncrumpled
from foilstudy.pipeline.method import Mesh
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation import Ramp, Scheme, StoppingRule, relax
from foilstudy.study.published import FEP, foil
from foilstudy.study.real.plan import NAME
from foilstudy.study.real.settings import Trial, ladder
from foilstudy.study.real.trial import measure

HEIGHTS_MM = (150, 170, 250)
RAMP_STEPS, TURNS = 4000, 3
MODELS = ("elastic", "plastic", "touching", "rubbing", "full")
"""Steps of config/real.yaml whose realisations are timed whole."""
ELASTIC, PLASTIC, TOUCHING = "elastic", "plastic", "elastic, contact"


@dataclass(frozen=True)
class Case:
    """A foil of 500 um on 5 mm, of one kind."""

    height_mm: float
    kind: str

    def problem(self) -> Problem:
        """Its potential energy."""
        law = "plastic" if self.kind == PLASTIC else "elastic"
        made = Material(
            FEP.youngs_modulus, FEP.poisson_ratio, FEP.density, FEP.yield_stress, law=law
        )
        shape = uncrumpled(
            replace(foil(500, self.height_mm), material=made), Mesh(5e-3), Imperfection(seed=0)
        )
        contacts = BarrierContact().terms(shape.stressed.section) if self.kind == TOUCHING else ()
        return Problem(shape.stressed, *shape.terms(), *contacts)

    def step(self) -> float:
        """Processor time of a step of the ramp, s.

        Raises
        ------
        RuntimeError
            If the ramp is not followed to its end.
        """
        problem = self.problem()
        motion = Scheme().start(problem)
        ramp = Ramp(foil(500, self.height_mm).shortening, RAMP_STEPS)
        start = time.process_time()
        result = relax(problem, motion, ramp, StoppingRule(0.0, 0))
        if result.steps != RAMP_STEPS:
            raise RuntimeError(f"{self}: {result.message}")
        return (time.process_time() - start) / RAMP_STEPS


def measured(height_mm: float) -> Mapping[str, float]:
    """Median time of a step of every kind, s; the first turn loads kernels and is not counted."""
    cases = [Case(height_mm, kind) for kind in (ELASTIC, PLASTIC, TOUCHING)]
    turns = [[case.step() for case in cases] for _ in range(TURNS + 1)][1:]
    return {
        case.kind: statistics.median(times)
        for case, times in zip(cases, zip(*turns, strict=True), strict=True)
    }


def realisations() -> list[list[str]]:
    """Medians of whole realisations of 500 um, 170 mm, with statics: a row for each model."""
    cases = [
        Trial(model, "", 500, 170, seed) for model in MODELS for seed in range(TURNS)
    ]  # fmt: skip
    seconds: dict[str, list[float]] = {model: [] for model in MODELS}
    measure(cases[-1], NAME)  # loads all kernels, and is not counted
    for case in cases:
        start = time.process_time()
        result = measure(case, NAME)
        if result["status"] != "converged":
            raise RuntimeError(f"{case}: {result['message']}")
        seconds[case.step].append(time.process_time() - start)
    words = {step.name: step.words for step in ladder(NAME).steps}
    return [
        [words[model], f"{statistics.median(times):.1f}", f"{min(times):.1f} to {max(times):.1f}"]
        for model, times in seconds.items()
    ]


def main(heights_mm: tuple[float, ...]) -> None:
    """Measure and write the section."""
    rows = []
    for height in heights_mm:
        times = measured(height)
        rows.append(
            [f"{100 * (height / 130 - 1):.0f} %"]
            + [f"{1e3 * times[kind]:.3f}" for kind in times]
            + [f"{times[kind] / times[ELASTIC]:.2f}" for kind in (PLASTIC, TOUCHING)]
        )
    head = ["overlength", ELASTIC, PLASTIC, TOUCHING, "plastic over elastic", "contact over none"]
    words = (
        f"{machine()}. 500 µm on 5 mm, a ramp of {RAMP_STEPS} steps; ms of processor time a step, "
        f"medians of {TURNS}."
    )
    whole = (
        f"Whole realisations of 500 µm, 31 %, on 5 mm, a ramp of 8 000 steps, with statics and two "
        f"frequencies (models of config/real.yaml); s of processor time, {TURNS} seeds."
    )
    table = markdown_table(["model", "median", "least to largest"], realisations())
    write_section("Real foil", f"{words}\n\n{markdown_table(head, rows)}\n\n{whole}\n\n{table}")


if __name__ == "__main__":
    main(tuple(map(float, sys.argv[1:])) or HEIGHTS_MM)
