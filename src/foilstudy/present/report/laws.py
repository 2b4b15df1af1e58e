"""The power laws as the page shows them: exponents, verbs, differences and their limits."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from foilstudy.base.numerals import fixed, number, signed
from foilstudy.base.reference import DimensionlessLaw, PowerLaw
from foilstudy.present.statistics.powerlaw import AS_IT_STANDS, LIMIT, PLAIN, PRESTRESSED, TRUSTED
from foilstudy.present.statistics.regression import SIGNIFICANT

SOURCES = {
    TRUSTED: "This study, mesh limit, trusted",
    LIMIT: "This study, mesh limit",
    PLAIN: "This study, crumpled mesh",
    AS_IT_STANDS: "This study, as it stands",
    PRESTRESSED: "This study, pre-stressed",
    "simulation pre-stressed refined": "This study, pre-stressed, relaxed again",
    "published simulation": "Published simulation",
    "published experiment": "Published experiment",
}
"""Sources of a power law, in the order of the table, with their names."""


@dataclass(frozen=True)
class Exponent:
    """One coefficient of a power law and its 95 % interval."""

    value: float
    low: float
    high: float

    @property
    def known(self) -> bool:
        """Whether the sweep determines the coefficient."""
        return math.isfinite(self.value)

    @property
    def half_width(self) -> float:
        """Half width of the 95 % interval; NaN when the sample leaves none."""
        return (self.high - self.low) / 2

    @property
    def margin(self) -> str:
        """Half width of the 95 % interval in words; empty when the sample leaves none."""
        return f" ± {fixed(self.half_width)}" if math.isfinite(self.half_width) else ""

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
    """A power law of `PowerLaw`'s form, with what the page says about it.

    Attributes
    ----------
    lack_of_fit_p : float
        Probability that the configurations follow the law; NaN where it is not known.
    differences : str
        How it differs from the one that the others are held against.
    """

    source: str
    name: str
    alpha: Exponent
    beta: Exponent
    gamma: Exponent
    r2: float
    n: float
    residual_std: float
    lack_of_fit_p: float
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
    """The laws of one direction, the one that answers first.

    Attributes
    ----------
    trusted, known : int
        Configurations whose stiffness is trusted, and all that have one.
    scale : tuple of float or None
        Radius (mm) and Young's modulus (MPa) of the foil, where the configuration tells them.
    """

    direction: str
    laws: tuple[Law, ...]
    trusted: int
    known: int
    scale: tuple[float, float] | None = None

    @property
    def answer(self) -> Law | None:
        """The law that answers; None where no configuration is trusted."""
        return self.laws[0] if self.trusted else None

    @property
    def best(self) -> Law:
        """The law that answers, or the best one to show, untrusted as it is."""
        return self.laws[0]

    @property
    def listed(self) -> tuple[Law, ...]:
        """Those of the table; the pre-stressed one is left out where it is that as it stands."""
        if self.law(AS_IT_STANDS) is None:
            return self.laws
        return tuple(law for law in self.laws if law.source != PRESTRESSED)

    @property
    def plain(self) -> Law:
        """This study's law on the crumpled mesh."""
        return next(law for law in self.laws if law.source == PLAIN)

    @property
    def dimensionless(self) -> DimensionlessLaw | None:
        """The answer without units; None where it lacks an exponent, or the foil is not told."""
        law = self.answer
        if law is None or self.scale is None or not (law.beta.known and law.gamma.known):
            return None
        return law.law.dimensionless(*self.scale)

    def law(self, source: str) -> Law | None:
        """The law of one of `SOURCES`; None where the study has none."""
        return next((law for law in self.laws if law.source == source), None)


def read_laws(
    powerlaw: pd.DataFrame,
    summary: pd.DataFrame,
    scale: tuple[float, float] | None = None,
) -> tuple[DirectionLaws, ...]:
    """Read the laws of each direction and put their differences into words.

    Parameters
    ----------
    powerlaw, summary
        Tables ``powerlaw.csv`` and ``stiffness_summary.csv``.
    scale
        Radius (mm) and Young's modulus (MPa) of the foil.
    """
    directions = []
    for direction in powerlaw["direction"].unique():
        rows = powerlaw[powerlaw["direction"] == direction].set_index("source")
        cells = summary[summary["direction"] == direction]
        present = [source for source in SOURCES if source in rows.index]
        laws = {source: _law(source, rows.loc[source]) for source in present}
        trusted, known = int(cells["trusted"].sum()), int((cells["n"] > 0).sum())
        ours = next(iter(laws.values()))
        middle = _middle(summary)
        # Beside a law that is not trusted nothing is steeper or flatter.
        named = [
            law if law is ours or not trusted else _with_differences(ours, law, middle)
            for law in laws.values()
        ]
        directions.append(DirectionLaws(str(direction), tuple(named), trusted, known, scale))
    return tuple(directions)


def _law(source: str, row: pd.Series) -> Law:
    coefficients = {
        name: Exponent(*(float(row[f"{name}{part}"]) for part in ("", "_low", "_high")))
        for name in ("alpha", "beta", "gamma")
    }
    note = row["note"] if isinstance(row["note"], str) else ""
    numbers = {name: float(row[name]) for name in ("r2", "n", "residual_std", "lack_of_fit_p")}
    return Law(source, SOURCES[source], **coefficients, **numbers, note=note)


def _with_differences(ours: Law, other: Law, middle: tuple[float, float]) -> Law:
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
    ratio = other.law.stiffness(*middle) / ours.law.stiffness(*middle)
    level = "equally" if fixed(ratio, 1) == "1.0" else f"{number(ratio, 2)} times as"
    words.append(f"{level} stiff mid-sweep")
    return replace(other, differences="; ".join(words + notes))


def middle_of_sweep(summary: pd.DataFrame) -> str:
    """Name the point of the sweep at which the levels of two laws are compared."""
    overlength, thickness = _middle(summary)
    return f"{number(thickness)} µm and {number(overlength)} %"


def _middle(summary: pd.DataFrame) -> tuple[float, float]:
    """Geometric middle of the overlengths (%) and thicknesses (um) that are trusted, if any are."""
    trusted = summary[summary["trusted"].astype(bool)]
    rows = trusted if len(trusted) else summary
    return _geometric_mean(rows["overlength_percent"]), _geometric_mean(rows["thickness_um"])


def _difference(name: str, ours: Exponent, other: Exponent) -> str:
    symbol = {"beta": "β", "gamma": "γ"}[name]
    if not (ours.known and other.known):
        return ""
    change = other.value - ours.value
    margin = math.hypot(ours.half_width, other.half_width)
    if not math.isfinite(margin):
        return f"{symbol} differs by {signed(change)}"
    if abs(change) <= margin:
        return f"{symbol} agrees ({signed(change)} ± {fixed(margin)})"
    word = "steeper" if abs(other.value) > abs(ours.value) else "flatter"
    return f"{symbol} {word} by {fixed(abs(change))} ± {fixed(margin)}"


def _geometric_mean(values: pd.Series) -> float:
    return float(np.exp(np.log(values.unique()).mean()))


def scope_of(item: DirectionLaws) -> str:
    """Say of which stiffness the law that answers is."""
    if item.answer is None or item.answer.source != TRUSTED:
        return "mesh limit"
    return f"mesh limit, the {item.trusted} of {item.known} configurations that are trusted"


def bend_sentence(directions: Sequence[DirectionLaws]) -> str:
    """Warn when configurations depart from the law that answers; empty when none is known to."""
    bent = [
        f"{item.direction} p {_probability(item.answer.lack_of_fit_p)}"
        for item in directions
        if item.answer and item.answer.lack_of_fit_p < SIGNIFICANT
    ]
    if not bent:
        return ""
    return (
        "A single power law is an approximation: the configurations depart from it by more than "
        f"their own scatter explains (lack of fit, {', '.join(bent)}), which its intervals allow "
        "for."
    )


def fit_findings(directions: Sequence[DirectionLaws]) -> list[str]:
    """Say how well the laws that answer describe the realisations."""
    sentences = []
    for item in directions:
        law = item.answer
        if law is None or not math.isfinite(law.residual_std):
            continue
        text = (
            f"Realisations scatter about the {item.direction} law ({_named(law)}) by a factor "
            f"{fixed(math.exp(law.residual_std))} (one standard deviation)"
        )
        if math.isfinite(law.lack_of_fit_p):
            text += f"; lack of fit p {_probability(law.lack_of_fit_p)}"
        sentences.append(f"{text}.")
    return sentences


def _named(law: Law) -> str:
    return law.name.removeprefix("This study, ")


def _probability(p: float) -> str:
    return "below 0.001" if p < 1e-3 else f"= {number(p, 2)}"
