"""Stiffness of every model over the measured one, and its power laws beside the measured ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache

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
from foilstudy.study.real.studied import realisations

STATES = {
    "stress-free": ("static_stiffness",),
    "stress-free, contacts stuck": ("stiffness_contacts_stuck",),
    "with its stresses": ("true_stiffness", "prestressed_stiffness"),
}
"""By what they are called here, quantities: the first one that there is."""
EXPONENTS = ("overlength", "thickness")


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
    """Stiffness of one model in one direction.

    Attributes
    ----------
    step, words : str
        Name of the model and what it is called; ``experiment`` and ``simulation`` are published.
    state, direction : str
    terms : mapping of str to Known
        By `levels` stiffness over the measured law at one overlength, geometric mean of all
        thicknesses; by `EXPONENTS` those of a power law.
    count, of : int
        Realisations with a positive stiffness, and all.
    """

    step: str
    words: str
    state: str
    direction: str
    terms: Mapping[str, Known]
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


@cache
def levels() -> dict[str, float]:
    """Overlengths (%) at which levels are compared, by the names of their terms."""
    heights = ladder(NAME).reference_height_mm
    return {f"level_{height}mm": _overlength(height) for height in heights}


def _overlength(height_mm: float) -> float:
    return 100 * (height_mm * 1e-3 / GAP_HEIGHT - 1)


def _published() -> Iterator[Law]:
    words = {"experiment": "measured", "simulation": "published simulation"}
    thicknesses = np.array(ladder(NAME).thickness_um, float)
    for source, name in words.items():
        for direction, laws in published().power_laws.items():
            law = laws[source]
            # intervals of the fits are published for the exponents alone
            over = {
                term: np.exp(np.mean(np.log(law.law.stiffness(at, thicknesses))))
                / np.exp(np.mean(np.log(_measured(direction, at, thicknesses))))
                for term, at in levels().items()
            }
            exponents = {
                term: Known(e.value, e.value - NORMAL_95 * e.std, e.value + NORMAL_95 * e.std)
                for term, e in zip(EXPONENTS, (law.beta, law.gamma))
            }
            terms = {term: Known(float(v), np.nan, np.nan) for term, v in over.items()} | exponents
            state = "stress-free" if source == "simulation" else "real"
            yield Law(source, name, state, direction, terms, 0, 0)


def _measured(direction: str, overlength, thickness):
    return published().power_laws[direction]["experiment"].law.stiffness(overlength, thickness)


def _laws(results: dict[Trial, dict]) -> Iterator[Law]:
    models = [(step, results) for step in ladder(NAME).steps]
    models += [(entry, realisations(entry)) for entry in ladder(NAME).studied]
    for step, measured in models:
        trials = {t: r for t, r in measured.items() if t.step == step.name}
        for state, quantities in STATES.items():
            for k, direction in enumerate(DIRECTIONS):
                values = {trial: number(result, quantities, k) for trial, result in trials.items()}
                exponents = fit(values)
                if exponents is not None:
                    over = {
                        term: level(
                            {t: v for t, v in values.items() if _overlength(t.height_mm) == at},
                            direction,
                        )
                        for term, at in levels().items()
                    }
                    terms = over | dict(zip(EXPONENTS, exponents))
                    positive = sum(value > 0 for value in values.values())
                    yield Law(step.name, step.words, state, direction, terms, positive, len(values))


def level(values: Mapping[Trial, float], direction: str) -> Known:
    """Geometric mean of stiffnesses (N/m) over the measured law.

    Student's interval of the logarithms, so that what the thicknesses differ in counts as
    scatter. What is not positive is left out.
    """
    logs = [
        np.log(value / _measured(direction, _overlength(trial.height_mm), trial.thickness_um))
        for trial, value in values.items()
        if value > 0
    ]
    if len(logs) < 2:
        return Known(float(np.exp(logs[0])) if logs else np.nan, np.nan, np.nan)
    mean = sm.OLS(logs, np.ones(len(logs))).fit()
    low, high = mean.conf_int(alpha=1 - CONFIDENCE)[0]
    return Known(*map(float, np.exp([mean.params[0], low, high])))


def number(result: dict, quantities: tuple[str, ...], k: int) -> float:
    """The first of some quantities that a result has, in one direction; NaN if it has none."""
    values = next((result[name] for name in quantities if name in result), None)
    return np.nan if values is None else float(np.asarray(values, float).ravel()[k])


def fit(values: Mapping[Trial, float]) -> tuple[Known, Known] | None:
    """Exponents of overlength and thickness.

    Least squares of logarithms, a realisation each; intervals by Student, and, where it is wider,
    clustered by foil, as a power law may not hold for all of them. What is not positive has no
    logarithm and is left out. None where the rest determines no law.
    """
    known = [(trial, value) for trial, value in values.items() if value > 0]
    if not known:
        return None
    x = np.log([_overlength(trial.height_mm) for trial, _ in known])
    y = np.log([trial.thickness_um for trial, _ in known])
    foils = np.unique(np.stack([x, y]), axis=1, return_inverse=True)[1].ravel()
    design = np.stack([np.ones(x.size), x - x.mean(), y - y.mean()], axis=1)
    if x.size <= design.shape[1] or np.linalg.matrix_rank(design) < design.shape[1]:
        return None
    found = sm.OLS(np.log([value for _, value in known]), design).fit()
    intervals = [found.conf_int(alpha=1 - CONFIDENCE)]
    if foils.max() >= design.shape[1]:
        robust = found.get_robustcov_results("cluster", groups=foils)
        intervals.append(robust.conf_int(alpha=1 - CONFIDENCE))
    ends = np.array(intervals)
    low, high = ends[..., 0].min(axis=0), ends[..., 1].max(axis=0)
    return tuple(Known(*map(float, each)) for each in zip(found.params[1:], low[1:], high[1:]))
