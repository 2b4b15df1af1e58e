"""Scatter of the stiffness over random imperfections."""

from __future__ import annotations

import numpy as np

from foilstudy.base.confidence import CONFIDENCE
from foilstudy.present.statistics.cells import measured
from foilstudy.present.statistics.powerlaw import SIMULATED, sources_in
from foilstudy.present.statistics.regression import LinearFit, fit_linear

PLAIN = SIMULATED["simulation"]
"""The stiffness whose scatter the figure and the regression show."""


def coefficient_of_variation(values) -> float:
    """Standard deviation (n - 1 in the denominator) over mean.

    NaN for fewer than two values, and for a mean that is not positive, which measures nothing.
    """
    values = np.asarray(values, float)
    values = values[np.isfinite(values)]
    if values.size < 2 or not values.mean() > 0:
        return np.nan
    return float(values.std(ddof=1) / values.mean())


def coefficient_of_variation_interval(cv: float, n: int) -> tuple[float, float]:
    """Return the 95 % confidence interval of a coefficient of variation.

    Modified McKay interval for a normal population (M. G. Vangel, "Confidence intervals for a
    normal coefficient of variation", The American Statistician 50, 1996), made for small
    samples: with u the chi-squared quantile for ``n - 1`` degrees of freedom,
    ``limit = cv / sqrt(((u + 2) / n - 1) cv**2 + u / (n - 1))``.

    Parameters
    ----------
    cv
        Sample coefficient of variation.
    n
        Sample size.

    Returns
    -------
    low, high
        NaN for ``n < 2``; `high` is infinite where the sample is too small to bound it.
    """
    if n < 2 or not np.isfinite(cv):
        return np.nan, np.nan
    from scipy.stats import chi2

    def limit(probability):
        u = chi2.ppf(probability, n - 1)
        square = ((u + 2) / n - 1) * cv**2 + u / (n - 1)
        return float(cv / np.sqrt(square)) if square > 0 else np.inf

    return limit(0.5 + CONFIDENCE / 2), limit(0.5 - CONFIDENCE / 2)


def variability_table(cube):
    """Return the coefficient of variation of every quantity, configuration and direction.

    Returns
    -------
    pandas.DataFrame
        Columns quantity (the stiffness in the cube), thickness_um, overlength_percent, direction,
        n, n_not_positive, mean, std (N/m, of all values, also those not positive), cv, cv_low,
        cv_high (95 %, see `coefficient_of_variation_interval`). Quantities as in `sources_in`.
    """
    import pandas as pd

    rows = []
    for quantity in (SIMULATED[source] for source in sources_in(cube)):
        for direction in map(str, cube["direction"].values):
            stiffness = measured(cube, quantity, direction=direction)
            stiffness = stiffness.transpose("thickness", "overlength", "seed").to_numpy()
            for i, j in np.ndindex(stiffness.shape[:2]):
                cell = {
                    "quantity": quantity,
                    "thickness_um": float(cube["thickness"][i]),
                    "overlength_percent": float(cube["overlength"][j]),
                    "direction": direction,
                }
                rows.append(cell | _scatter(stiffness[i, j][np.isfinite(stiffness[i, j])]))
    return pd.DataFrame(rows)


def _scatter(values: np.ndarray) -> dict[str, float]:
    cv = coefficient_of_variation(values)
    low, high = coefficient_of_variation_interval(cv, values.size)
    return {
        "n": values.size,
        "n_not_positive": int((values <= 0).sum()),
        "mean": values.mean() if values.size else np.nan,
        "std": values.std(ddof=1) if values.size > 1 else np.nan,
        "cv": cv,
        "cv_low": low,
        "cv_high": high,
    }


def fit_variability(table, direction: str) -> LinearFit:
    """Fit ``cv = constant + slope * overlength/%`` over the configurations of one direction.

    Of the quantities in the table it takes the stress-free stiffness on the crumpled mesh.

    Parameters
    ----------
    table : pandas.DataFrame
        From `variability_table`.
    direction
        ``axial`` or ``radial``.

    Returns
    -------
    LinearFit
        Its only regressor is called ``overlength``.
    """
    table = plain_scatter(table)
    rows = table[(table["direction"] == direction) & table["cv"].notna()]
    return fit_linear(rows["cv"].to_numpy(), {"overlength": rows["overlength_percent"].to_numpy()})


def plain_scatter(table):
    """Return the rows of the stress-free stiffness on the crumpled mesh."""
    return table[table["quantity"] == PLAIN]


def variability_law_table(cube):
    """Return the regression of the coefficient of variation on the overlength per direction.

    It is that of the stress-free stiffness on the crumpled mesh.

    Returns
    -------
    pandas.DataFrame
        ``slope`` is per per cent of overlength; ``thickness_rank_correlation`` is Spearman's,
        of the coefficient of variation with the thickness, with its p-value.
    """
    import pandas as pd

    table = plain_scatter(variability_table(cube))
    rows = []
    for direction in map(str, cube["direction"].values):
        fit = fit_variability(table, direction)
        correlation, p = _thickness_trend(table[table["direction"] == direction])
        rows.append(
            {
                "direction": direction,
                "constant": fit.value["constant"],
                "constant_se": fit.std_error["constant"],
                "slope": fit.value["overlength"],
                "slope_se": fit.std_error["overlength"],
                "slope_low": fit.low["overlength"],
                "slope_high": fit.high["overlength"],
                "r2": fit.r2,
                "n": fit.n,
                "thickness_rank_correlation": correlation,
                "thickness_rank_correlation_p": p,
                "note": fit.note.replace("usable realisation", "configuration with a cv"),
            }
        )
    return pd.DataFrame(rows)


def _thickness_trend(table) -> tuple[float, float]:
    rows = table[table["cv"].notna()]
    if rows["thickness_um"].nunique() < 2 or len(rows) < 4 or rows["cv"].nunique() < 2:
        return np.nan, np.nan
    from scipy.stats import spearmanr

    trend = spearmanr(rows["thickness_um"], rows["cv"])
    return float(trend.statistic), float(trend.pvalue)
