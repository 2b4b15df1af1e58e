"""Whether a transfer stiffness depends on how strongly the specimen is driven, as ISO 10846 asks.

Two runs, one at least 10 dB stronger at the input than the other; the levels of the one-third
octaves of both agree within 1.5 dB where the specimen is linear, and the results then hold up to
the stronger input. Test for linearity in ISO 10846-2 and -3 (section 7.6 of ISO 10846-3:2002); the
two limits are those by which it is usually cited, not checked against its text.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.best_linear import BestLinear, best_linear, excited_lines
from foilstudy.bench.estimation.channels import MOTION
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.estimation.periods import PeriodMeans
from foilstudy.bench.transfer_level import LEAST_LINES, LINEAR_DB

__all__ = ["APART_DB", "Driven", "LinearityCheck", "linearity"]

APART_DB = 10.0
"""By how much the input of the two runs has to differ."""
_ROUNDING_DB = 1e-6


@dataclass(frozen=True, eq=False)
class Driven:
    """An estimate and how strongly the specimen was driven for it.

    Attributes
    ----------
    estimate : Estimate
    power : ndarray, shape (f,)
        Mean square of the input's motion at each frequency, m^2.
    """

    estimate: Estimate
    power: np.ndarray

    @classmethod
    def of(cls, lines: PeriodMeans, excited: np.ndarray) -> Self:
        """From motion and force of one recording, as `measured_lines` gives them."""
        found: BestLinear = best_linear([lines], excited)
        kept = lines.at(excited_lines(lines, excited))
        return cls(found.estimate, 0.5 * np.abs(kept.means[:, MOTION]) ** 2)


@dataclass(frozen=True, eq=False)
class LinearityCheck:
    """Band by band of one-third octaves.

    Attributes
    ----------
    centres : ndarray, shape (bands,)
        Hz; bands with at least `LEAST_LINES` frequencies that are trusted in both runs.
    apart_db : ndarray, shape (bands,)
        Level of the stronger input over that of the weaker one.
    change_db : ndarray, shape (bands,)
        Level of the stiffness under the stronger input over that under the weaker one.
    """

    centres: np.ndarray
    apart_db: np.ndarray
    change_db: np.ndarray

    @property
    def judged(self) -> np.ndarray:
        """Bands whose inputs are far enough apart to tell."""
        return self.apart_db >= APART_DB - _ROUNDING_DB

    @property
    def linear(self) -> np.ndarray:
        """Bands that are judged, and linear."""
        return self.judged & (np.abs(self.change_db) <= LINEAR_DB)

    @property
    def holds(self) -> bool:
        """Whether all bands that can be judged are linear."""
        return bool((self.linear | ~self.judged).all())


def linearity(weak: Driven, strong: Driven) -> LinearityCheck:
    """Compare two runs that differ in their excitation alone.

    Raises
    ------
    Refusal
        If they do not share their frequencies, none is trusted in both, or no band has inputs
        10 dB apart.
    """
    frequencies = weak.estimate.frequencies
    if not np.array_equal(frequencies, strong.estimate.frequencies):
        raise Refusal("the two runs have other frequencies; process both alike.")
    good = weak.estimate.trusted & strong.estimate.trusted
    if not good.any():
        raise Refusal(
            "no frequency is coherent in both runs; excite the weaker one more strongly or average "
            "longer."
        )
    numbers = np.floor(10 * np.log10(frequencies[good]) + 0.5 + 1e-9).astype(int)
    bands, at, count = np.unique(numbers, return_inverse=True, return_counts=True)
    told = count >= LEAST_LINES
    if not told.any():
        raise Refusal(
            f"no band holds {LEAST_LINES} frequencies that are coherent in both runs; excite more "
            "lines."
        )

    def level(power: np.ndarray) -> np.ndarray:
        return 10 * np.log10(np.bincount(at, power[good]) / count)[told]

    found = LinearityCheck(
        10 ** (bands[told] / 10),
        level(strong.power) - level(weak.power),
        level(np.abs(strong.estimate.values) ** 2) - level(np.abs(weak.estimate.values) ** 2),
    )
    if not found.judged.any():
        raise Refusal(
            f"the inputs of the two runs are at most {found.apart_db.max():.1f} dB apart, and "
            f"linearity is told by {APART_DB:g} dB; repeat one of them weaker."
        )
    return found
