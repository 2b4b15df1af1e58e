"""The power laws as the page shows them: exponents, verbs, differences and their limits."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from foilstudy.base.numerals import fixed, number, signed
from foilstudy.base.reference import PowerLaw
from foilstudy.present.statistics.powerlaw import NORMAL_95

SOURCES = {
    "simulation": "This study",
    "simulation mesh limit": "This study, mesh limit",
    "simulation pre-stressed": "This study, pre-stressed",
    "simulation pre-stressed refined": "This study, pre-stressed, relaxed again",
    "published simulation": "Published simulation",
    "published experiment": "Published experiment",
}
"""Sources of a power law, in the order of the table, with their names."""

SIGNIFICANT = 0.05
"""Probability below which a departure is not left to chance."""


@dataclass(frozen=True)
class Exponent:
    """One coefficient of a power law, its standard error and its 95 % interval."""

    value: float
    std_error: float
    low: float
    high: float

    @property
    def known(self) -> bool:
        """Whether the sweep determines the coefficient."""
        return math.isfinite(self.value)

    @property
    def margin(self) -> str:
        """Half width of the 95 % interval; empty when the sample leaves none."""
        half = (self.high - self.low) / 2
        return f" ± {fixed(half)}" if math.isfinite(half) else ""

    @property
    def interval(self) -> str:
        """The 95 % interval in brackets; empty when the sample leaves none."""
        if not math.isfinite(self.low):
            return ""
        return f"[{fixed(self.low)}, {fixed(self.high)}]"

    @property
    def effect(self) -> str:
        """What the stiffness does as the regressor grows, up to the power of the regressor."""
        if math.isfinite(self.low) and self.low <= 0 <= self.high:
            return "shows no clear trend with"
        return "grows as" if self.value > 0 else "falls as"


@dataclass(frozen=True)
class Law:
    """A power law of `PowerLaw`'s form, with what the page says about it."""

    source: str
    name: str
    alpha: Exponent
    beta: Exponent
    gamma: Exponent
    r2: float
    n: float
    residual_std: float
    note: str
    differences: str = ""

    @property
    def known(self) -> bool:
        """Whether there was anything to fit."""
        return self.alpha.known

    @property
    def level(self) -> float:
        """Stiffness [N/m] of a law without any exponent: the mean of one configuration."""
        return math.exp(self.alpha.value)

    @property
    def law(self) -> PowerLaw:
        """The law with the estimated values."""
        return PowerLaw(self.alpha.value, self.beta.value, self.gamma.value)


@dataclass(frozen=True)
class DirectionLaws:
    """The laws of one direction; ``simulation`` is the one that answers."""

    direction: str
    laws: tuple[Law, ...]

    @property
    def simulation(self) -> Law:
        """This study's law on the crumpled mesh."""
        return next(law for law in self.laws if law.source == "simulation")

    def law(self, source: str) -> Law | None:
        """The law of one of `SOURCES`; None where the study has none."""
        return next((law for law in self.laws if law.source == source), None)


def read_laws(powerlaw: pd.DataFrame, summary: pd.DataFrame) -> tuple[DirectionLaws, ...]:
    """Read the laws of each direction and put their differences into words.

    Parameters
    ----------
    powerlaw, summary
        Tables ``powerlaw.csv`` and ``stiffness_summary.csv``.
    """
    directions = []
    for direction in powerlaw["direction"].unique():
        rows = powerlaw[powerlaw["direction"] == direction].set_index("source")
        cells = summary[summary["direction"] == direction]
        present = [source for source in SOURCES if source in rows.index]
        laws = {source: _law(source, rows.loc[source]) for source in present}
        ours = laws["simulation"]
        named = [
            law if law is ours else _with_differences(ours, law, cells) for law in laws.values()
        ]
        directions.append(DirectionLaws(str(direction), tuple(named)))
    return tuple(directions)


def _law(source: str, row: pd.Series) -> Law:
    coefficients = {
        name: Exponent(*(float(row[f"{name}{part}"]) for part in ("", "_se", "_low", "_high")))
        for name in ("alpha", "beta", "gamma")
    }
    note = row["note"] if isinstance(row["note"], str) else ""
    numbers = {name: float(row[name]) for name in ("r2", "n", "residual_std")}
    return Law(source, SOURCES[source], **coefficients, **numbers, note=note)


def _with_differences(ours: Law, other: Law, cells: pd.DataFrame) -> Law:
    """Say how the other law differs from ours, and by how much at the middle of the sweep.

    What a law of this study leaves out stands there, too.
    """
    notes = [other.note] if other.note and not other.source.startswith("published") else []
    if not (ours.known and other.known):
        return replace(other, differences="; ".join(notes))
    words = [
        text
        for name in ("beta", "gamma")
        if (text := _difference(name, getattr(ours, name), getattr(other, name)))
    ]
    middle = _geometric_mean(cells["overlength_percent"]), _geometric_mean(cells["thickness_um"])
    ratio = other.law.stiffness(*middle) / ours.law.stiffness(*middle)
    level = "equally" if fixed(ratio, 1) == "1.0" else f"{number(ratio, 2)} times as"
    words.append(f"{level} stiff mid-sweep")
    return replace(other, differences="; ".join(words + notes))


def middle_of_sweep(summary: pd.DataFrame) -> str:
    """Name the point of the sweep at which the levels of two laws are compared."""
    overlength = _geometric_mean(summary["overlength_percent"])
    thickness = _geometric_mean(summary["thickness_um"])
    return f"{number(thickness)} µm and {number(overlength)} %"


def _difference(name: str, ours: Exponent, other: Exponent) -> str:
    symbol = {"beta": "β", "gamma": "γ"}[name]
    if not (ours.known and other.known):
        return ""
    change = other.value - ours.value
    margin = NORMAL_95 * math.hypot(ours.std_error, other.std_error)
    if not math.isfinite(margin):
        return f"{symbol} differs by {signed(change)}"
    if abs(change) <= margin:
        return f"{symbol} agrees ({signed(change)} ± {fixed(margin)})"
    word = "steeper" if abs(other.value) > abs(ours.value) else "flatter"
    return f"{symbol} {word} by {fixed(abs(change))} ± {fixed(margin)}"


def _geometric_mean(values: pd.Series) -> float:
    return float(np.exp(np.log(values.unique()).mean()))


def bend_sentence(powerlaw: pd.DataFrame) -> str:
    """Warn when the configurations depart from the law; empty when none is known to.

    Parameters
    ----------
    powerlaw
        Table ``powerlaw.csv``.
    """
    bent = [
        f"{row.direction} p {_probability(row.lack_of_fit_p)}"
        for row in _ours(powerlaw).itertuples()
        if row.lack_of_fit_p < SIGNIFICANT
    ]
    if not bent:
        return ""
    return (
        "A single power law is an approximation: the configurations depart from it by more than "
        f"their own scatter explains (lack of fit, {', '.join(bent)}), so the intervals above are "
        "too narrow."
    )


def fit_findings(powerlaw: pd.DataFrame) -> list[str]:
    """Say how well the law describes the realisations, and what it leaves.

    Parameters
    ----------
    powerlaw
        Table ``powerlaw.csv``.
    """
    sentences = []
    for row in _ours(powerlaw).itertuples():
        if not math.isfinite(row.residual_std):
            continue
        text = (
            f"Realisations scatter about the {row.direction} law by a factor "
            f"{fixed(math.exp(row.residual_std))} (one standard deviation)"
        )
        if math.isfinite(row.lack_of_fit_p):
            text += f"; lack of fit p {_probability(row.lack_of_fit_p)}"
        if row.lack_of_fit_p < SIGNIFICANT:
            errors = [
                f"{fixed(error)} for {symbol}"
                for symbol, error in (
                    ("β", row.beta_se_clustered),
                    ("γ", row.gamma_se_clustered),
                )
                if math.isfinite(error)
            ]
            text += f"; standard errors that allow for it are {' and '.join(errors)}"
        sentences.append(f"{text}.")
    return sentences


def _ours(powerlaw: pd.DataFrame) -> pd.DataFrame:
    return powerlaw[powerlaw["source"] == "simulation"]


def _probability(p: float) -> str:
    return "below 0.001" if p < 1e-3 else f"= {number(p, 2)}"
