"""Power laws of the stiffness of every model, beside the measured ones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import statsmodels.api as sm

from foilstudy.base.confidence import CONFIDENCE, NORMAL_95
from foilstudy.base.reference import published
from foilstudy.measure.stiffness.bounds import bound_of_any_shape
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.study.kernel.plan import Records
from foilstudy.study.published import GAP_HEIGHT, foil
from foilstudy.study.real.plan import NAME
from foilstudy.study.real.settings import Trial, ladder

STATES = {
    "stress-free": ("static_stiffness",),
    "stress-free, contacts stuck": ("stiffness_contacts_stuck",),
    "with its stresses": ("true_stiffness", "prestressed_stiffness"),
}
"""By what they are called here, quantities: the first one that there is."""
CENTRE = 31.0, 250.0
"""Overlength (%) and thickness (um) at which levels are compared: the middle of the sweep."""
TERMS = ("level", "overlength", "thickness")


@dataclass(frozen=True)
class Known:
    """A number with its 95 % interval."""

    value: float
    low: float
    high: float

    @property
    def words(self) -> str:
        """For people."""
        return f"{self.value:.2f} ({self.low:.2f} to {self.high:.2f})"


@dataclass(frozen=True)
class Law:
    """Power law of one direction by one model.

    Attributes
    ----------
    step, words : str
        Name of the model and what it is called; ``experiment`` and ``simulation`` are published.
    state, direction : str
    level : Known
        Stiffness at `CENTRE` over that of the measured law.
    overlength, thickness : Known
        Exponents.
    count, of : int
        Realisations with a positive stiffness, and all.
    """

    step: str
    words: str
    state: str
    direction: str
    level: Known
    overlength: Known
    thickness: Known
    count: int
    of: int


@dataclass(frozen=True)
class Bounded:
    """A measured stiffness, by its law, and what no foil can exceed (N/m)."""

    thickness_um: int
    height_mm: int
    direction: str
    measured: float
    bound: float


@dataclass(frozen=True, eq=False)
class Found:
    """What came out: the records, laws of all models, the published ones first, and bounds."""

    records: dict[Trial, dict]
    laws: tuple[Law, ...]
    bounds: tuple[Bounded, ...]


def found(records: Records) -> Found:
    """Laws of the models with at least two thicknesses and overlengths."""
    results = {trial: record.result for trial, record in records["trials"].items()}
    return Found(results, (*_published(), *_laws(results)), tuple(_bounds()))


def _bounds() -> Iterator[Bounded]:
    models = ladder(NAME)
    for thickness in models.thickness_um:
        for height in models.reference_height_mm:
            case = foil(thickness, height)
            for direction, bound in zip(DIRECTIONS, bound_of_any_shape(case)):
                law = published().power_laws[direction]["experiment"].law
                measured = float(law.stiffness(100 * case.overlength, thickness))
                yield Bounded(thickness, height, direction, measured, float(bound))


def _published() -> Iterator[Law]:
    words = {"experiment": "measured", "simulation": "published simulation"}
    for source, name in words.items():
        for direction, laws in published().power_laws.items():
            law = laws[source]
            # that of the fit in its middle is not published; the exponents' deviations are
            level = law.law.stiffness(*CENTRE) / _measured(direction)
            yield Law(
                source,
                name,
                "stress-free" if source == "simulation" else "real",
                direction,
                Known(level, np.nan, np.nan),
                *(
                    Known(e.value, e.value - NORMAL_95 * e.std, e.value + NORMAL_95 * e.std)
                    for e in (law.beta, law.gamma)
                ),
                0,
                0,
            )


def _measured(direction: str) -> float:
    return float(published().power_laws[direction]["experiment"].law.stiffness(*CENTRE))


def _laws(results: dict[Trial, dict]) -> Iterator[Law]:
    for step in ladder(NAME).steps:
        trials = {t: r for t, r in results.items() if t.step == step.name}
        for state, quantities in STATES.items():
            for k, direction in enumerate(DIRECTIONS):
                values = {trial: number(result, quantities, k) for trial, result in trials.items()}
                fitted = fit(values)
                if fitted is not None:
                    level, *exponents = fitted
                    scale = 1 / _measured(direction)
                    yield Law(
                        step.name,
                        step.words,
                        state,
                        direction,
                        Known(*(scale * np.exp([level.value, level.low, level.high]))),
                        *exponents,
                        sum(value > 0 for value in values.values()),
                        len(values),
                    )


def number(result: dict, quantities: tuple[str, ...], k: int) -> float:
    """The first of some quantities that a result has, in one direction; NaN if it has none."""
    values = next((result[name] for name in quantities if name in result), None)
    return np.nan if values is None else float(np.asarray(values, float).ravel()[k])


def fit(values: dict[Trial, float]) -> tuple[Known, Known, Known] | None:
    """Logarithm of the stiffness (N/m) at `CENTRE`, and exponents of overlength and thickness.

    Least squares of logarithms, a realisation each; Student's intervals. What is not positive
    has no logarithm and is left out. None where the rest determines no law.
    """
    known = [(trial, value) for trial, value in values.items() if value > 0]
    if not known:
        return None
    overlength = np.array([100 * (t.height_mm * 1e-3 / GAP_HEIGHT - 1) for t, _ in known])
    thickness = np.array([t.thickness_um for t, _ in known], float)
    x, y = np.log(overlength / CENTRE[0]), np.log(thickness / CENTRE[1])
    design = np.stack([np.ones(x.size), x, y], axis=1)
    if x.size <= design.shape[1] or np.linalg.matrix_rank(design) < design.shape[1]:
        return None
    target = np.log([value for _, value in known])
    found = sm.OLS(target, design).fit()
    intervals = found.conf_int(alpha=1 - CONFIDENCE)
    return tuple(Known(*map(float, (v, *ends))) for v, ends in zip(found.params, intervals))
