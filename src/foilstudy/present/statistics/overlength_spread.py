"""Do the dynamic stiffnesses of all overlengths become one curve at high frequency?

A one-way analysis of variance of ln |D| at every frequency splits the spread into that between
overlengths and that of the seeds within an overlength. Both variances are averaged over an octave
about each frequency, so that no single resonance decides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.present.statistics.cells import sound

OCTAVES = 1.0
"""Width of the moving average over the frequencies."""

RATIO_MAX = 1.0
"""Spread of the overlengths over that of the seeds, up to which the curves count as one."""


@dataclass(frozen=True)
class OverlengthSpread:
    """How far apart the curves of the overlengths are, as standard deviations of ln |D|.

    Attributes
    ----------
    frequency : ndarray, shape (f,)
        Hz.
    deviation : ndarray, shape (overlengths, f)
        Mean of ln |D| over the seeds of an overlength, minus the mean of these over overlengths;
        not averaged over frequency, NaN for an overlength without data.
    within : ndarray, shape (f,)
        Standard deviation over the seeds of one overlength, pooled.
    between : ndarray, shape (f,)
        Standard deviation over overlengths of the curve that an overlength would have with very
        many seeds: what few seeds add to their means is taken away.
    """

    frequency: np.ndarray
    deviation: np.ndarray
    within: np.ndarray
    between: np.ndarray

    @property
    def ratio(self) -> np.ndarray:
        """`between` over `within`, shape (f,); one needs no table of F, as seeds cancel out."""
        return self.between / self.within

    @property
    def one_curve_from_hz(self) -> float:
        """Lowest frequency from which `ratio` stays at most `RATIO_MAX` up to the end.

        NaN if there is none, or if it has less than half the averaging width above it.
        """
        apart = np.flatnonzero(~(self.ratio <= RATIO_MAX))
        first = apart[-1] + 1 if apart.size else 0
        if first == self.frequency.size:
            return np.nan
        start = self.frequency[first]
        return float(start) if start * 2 ** (OCTAVES / 2) <= self.frequency[-1] else np.nan

    def average_above(self, lowest_hz: float) -> tuple[float, float]:
        """`between` and `within` above a frequency, means in the sense of squares."""
        keep = self.frequency >= lowest_hz
        return tuple(
            float(np.sqrt(np.mean(values[keep] ** 2))) for values in (self.between, self.within)
        )


def overlength_spread(frequency: np.ndarray, magnitude: np.ndarray) -> OverlengthSpread:
    """Split the spread of ln |D| into overlengths and seeds.

    With the mean square MSW within, ``between**2`` is the variance of the overlengths' means less
    ``MSW / n``, the variance that the mean of n seeds has by itself (with unequal numbers, of 1/n
    the mean over overlengths); both are averaged over the octave first. This is the analysis of
    unweighted means of F. Yates, J. American Statistical Association 29 (1934) 51-66.

    Parameters
    ----------
    frequency : ndarray, shape (f,)
        Hz.
    magnitude : ndarray, shape (overlengths, seeds, f)
        |D| in N/m; NaN or not positive where there is no realisation.

    Raises
    ------
    ValueError
        If fewer than two overlengths have data, or no overlength has two seeds.
    """
    magnitude = np.asarray(magnitude, float)
    known = np.all(np.isfinite(magnitude) & (magnitude > 0), axis=2)
    seeds = known.sum(axis=1)
    groups, total = (seeds > 0).sum(), seeds.sum()
    if groups < 2 or total == groups:
        raise ValueError(
            "the spread needs usable realisations of two overlengths, and two of one of them"
        )
    log = np.log(np.where(known[..., None], magnitude, 1.0))
    with np.errstate(invalid="ignore"):
        mean = log.sum(axis=1) / seeds[:, None]
    centred = np.where(known[..., None], log - mean[:, None], 0.0)
    of_means = octave_average(frequency, np.nanvar(mean, axis=0, ddof=1))
    msw = octave_average(frequency, (centred**2).sum(axis=(0, 1)) / (total - groups))
    by_chance = msw * np.mean(1 / seeds[seeds > 0])
    return OverlengthSpread(
        frequency=np.asarray(frequency, float),
        deviation=mean - np.nanmean(mean, axis=0),
        within=np.sqrt(msw),
        between=np.sqrt(np.maximum(of_means - by_chance, 0)),
    )


def octave_average(frequency: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Moving average over the samples within half of `OCTAVES` to either side, where there are."""
    position = np.log2(frequency)
    # the tolerance lets samples at exactly half an octave in, whatever the rounding
    weight = np.abs(position[:, None] - position) <= OCTAVES / 2 + 1e-9
    return weight @ values / weight.sum(axis=1)


def leave_one_out(frequency: np.ndarray, magnitude: np.ndarray) -> tuple[float, float]:
    """Smallest and largest `one_curve_from_hz` when each seed in turn is left out.

    NaN if one of them is, or cannot be found from the seeds that are left.

    Parameters
    ----------
    frequency, magnitude
        As for `overlength_spread`.
    """
    starts = []
    for seed in range(magnitude.shape[1]):
        try:
            spread = overlength_spread(frequency, np.delete(magnitude, seed, axis=1))
        except ValueError:
            return np.nan, np.nan
        starts.append(spread.one_curve_from_hz)
    return float(np.min(starts)), float(np.max(starts))


def relative_magnitude(cube, thickness: float, direction: str) -> np.ndarray:
    """|D| of the relative definition, N/m, shape (overlengths, seeds, frequencies).

    Parameters
    ----------
    thickness : float
        um, a value of the coordinate.
    direction
        ``axial`` or ``radial``.

    Returns
    -------
    ndarray
        NaN where the realisation diverged or failed.
    """
    at = {"thickness": thickness}
    part = at | {"direction": direction, "definition": "relative"}
    magnitude = np.abs(cube["dynamic_stiffness"].sel(part))
    magnitude = magnitude.where(sound(cube).sel(at))
    return magnitude.transpose("overlength", "seed", "frequency").to_numpy()
