"""Ordinary least squares with the numbers a reader needs to trust or distrust a fit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from foilstudy.base.confidence import CONFIDENCE

SIGNIFICANT = 0.05
"""Probability below which a departure is not left to chance."""


@dataclass(frozen=True)
class LinearFit:
    """Least-squares fit of a response to named regressors and a constant.

    A regressor that takes one value only cannot be identified: it is left out, its coefficient
    is NaN, and `note` says so. Standard errors are NaN where no degree of freedom is left.

    Attributes
    ----------
    value, std_error, low, high : mapping of name to float
        Coefficients (the constant is called ``constant``), standard errors of independent
        residuals, and 95 % confidence limits, see `interval`.
    interval : str
        ``independent``: the limits are those of independent residuals, from Student's t
        distribution. ``clustered``: the model lacks fit, and they allow for residuals that are
        alike within a cluster, with one degree of freedom less than there are clusters; nowhere
        are they closer than the others.
    n : int
        Number of samples.
    residuals, fitted : ndarray, shape (n,)
    note : str
        What could not be determined, empty if everything could.
    """

    value: Mapping[str, float]
    std_error: Mapping[str, float]
    low: Mapping[str, float]
    high: Mapping[str, float]
    r2: float
    residual_std: float
    n: int
    residuals: np.ndarray
    fitted: np.ndarray
    note: str
    interval: str = "independent"
    _names: tuple[str, ...] = field(repr=False, default=())
    _result: object = field(repr=False, default=None)
    _clustered: object = field(repr=False, default=None)

    def predict(self, regressors: Mapping[str, np.ndarray]):
        """Return the fitted mean and its 95 % confidence limits.

        Parameters
        ----------
        regressors : mapping of name to array of shape (m,)

        Returns
        -------
        mean, low, high : ndarray, shape (m,)
            NaN where the fit does not exist or has no degree of freedom for limits.
        """
        columns = [np.atleast_1d(np.asarray(regressors[name], float)) for name in regressors]
        nan = np.full(columns[0].shape, np.nan)
        if self._result is None:
            return nan, nan.copy(), nan.copy()
        design = _design({name: regressors[name] for name in self._names}, columns[0].size)
        mean = design @ np.asarray(self._result.params)
        if self._result.df_resid < 1:
            return mean, nan, nan.copy()
        covariances = [self._result.cov_params()]
        if self._clustered is not None:
            covariances.append(self._clustered.cov_params())
        half = np.max(
            [
                factor * np.sqrt(np.einsum("ij,jk,ik->i", design, covariance, design))
                for factor, covariance in zip(self._t_factors(), covariances)
            ],
            axis=0,
        )
        return mean, mean - half, mean + half

    def _t_factors(self) -> list[float]:
        """Half width of a 95 % interval over its standard error, independent and clustered."""
        from scipy.stats import t

        freedom = [self._result.df_resid]
        if self._clustered is not None:
            freedom.append(self._clustered.df_resid_inference)
        return [float(t.ppf(0.5 + CONFIDENCE / 2, degrees)) for degrees in freedom]

    def allowing_for(self, cluster: np.ndarray) -> LinearFit:
        """The same fit, with clustered intervals where the model does not hold for the clusters.

        Parameters
        ----------
        cluster : ndarray of int, shape (n,)
            Label of the samples that share the same regressors.
        """
        if not self.lack_of_fit_p(cluster) < SIGNIFICANT:
            return self
        robust = self._result.get_robustcov_results("cluster", groups=cluster)
        wider = replace(self, interval="clustered", _clustered=robust)
        plain, clustered = wider._t_factors()
        keys = ("constant", *self._names)
        half = dict(
            zip(keys, np.maximum(plain * self._result.bse, clustered * robust.bse).tolist())
        )
        return replace(
            wider,
            low={k: v - half[k] if k in half else np.nan for k, v in self.value.items()},
            high={k: v + half[k] if k in half else np.nan for k, v in self.value.items()},
        )

    def clustered_std_error(self, cluster: np.ndarray) -> dict[str, float]:
        """Standard errors that allow for correlated residuals within each cluster.

        Parameters
        ----------
        cluster : ndarray of int, shape (n,)

        Returns
        -------
        dict of name to float
            Sandwich estimate with the small-sample factor; NaN with too few clusters.
        """
        nan = dict.fromkeys(self.value, np.nan)
        identified = 1 + len(self._names)
        if self._result is None or np.unique(cluster).size <= identified or not self._dof:
            return nan
        robust = self._result.get_robustcov_results("cluster", groups=cluster)
        return nan | dict(zip(("constant", *self._names), map(float, robust.bse)))

    @property
    def _dof(self) -> int:
        return 0 if self._result is None else int(self._result.df_resid)

    def normality_p(self) -> float:
        """p-value of the Shapiro-Wilk test that the residuals are normal; NaN below 4 of them."""
        if not self._dof or self.n < 4 or np.ptp(self.residuals) == 0:
            return np.nan
        from scipy.stats import shapiro

        return float(shapiro(self.residuals).pvalue)

    def heteroscedasticity_p(self) -> float:
        """p-value of the Breusch-Pagan test (Koenker's form) of constant residual variance."""
        if not self._dof or not self._names:
            return np.nan
        from statsmodels.stats.diagnostic import het_breuschpagan

        return float(het_breuschpagan(self.residuals, self._result.model.exog)[1])

    def lack_of_fit_p(self, cluster: np.ndarray) -> float:
        """p-value of the F test that the model holds for the mean of every cluster.

        Compares the scatter of cluster means about the fit with the scatter within clusters.
        A small value says that the departure from the law is systematic, not random.

        Parameters
        ----------
        cluster : ndarray of int, shape (n,)
            Label of the samples that share the same regressors.
        """
        groups = np.unique(cluster)
        dof_lack = groups.size - 1 - len(self._names)
        dof_pure = self.n - groups.size
        if self._result is None or dof_lack < 1 or dof_pure < 1:
            return np.nan
        from scipy.stats import f

        observed = self.fitted + self.residuals
        pure = sum(
            np.sum((observed[cluster == g] - observed[cluster == g].mean()) ** 2) for g in groups
        )
        lack = np.sum(self.residuals**2) - pure
        if pure <= 0:
            return np.nan
        return float(f.sf((lack / dof_lack) / (pure / dof_pure), dof_lack, dof_pure))

    def residual_rank_correlation(self) -> float:
        """Spearman rank correlation of the absolute residuals with the fitted values."""
        if not self._dof or np.ptp(self.residuals) == 0 or np.ptp(self.fitted) == 0:
            return np.nan
        from scipy.stats import spearmanr

        return float(spearmanr(np.abs(self.residuals), self.fitted).statistic)


def fit_linear(response: np.ndarray, regressors: Mapping[str, np.ndarray]) -> LinearFit:
    """Fit ``response = constant + sum coefficient * regressor`` by ordinary least squares.

    Parameters
    ----------
    response : ndarray, shape (n,)
    regressors : mapping of name to ndarray of shape (n,)

    Returns
    -------
    LinearFit
        Also for degenerate samples, where it says in `note` what is missing.
    """
    response = np.asarray(response, float)
    constant = [name for name, x in regressors.items() if np.unique(x).size < 2]
    names = tuple(name for name in regressors if name not in constant)
    nan = dict.fromkeys(("constant", *regressors), np.nan)
    if response.size <= len(names):
        note = "no usable realisation"
        if response.size:
            needed = f"{len(names) + 1} coefficients"
            note = f"{response.size} usable realisations are fewer than the {needed}"
        empty = np.full(response.size, np.nan)
        return LinearFit(nan, nan, nan, nan, np.nan, np.nan, response.size, empty, empty, note)

    from statsmodels.regression.linear_model import OLS

    design = _design({name: regressors[name] for name in names}, response.size)
    result = OLS(response, design).fit()
    if result.df_model < len(names):
        note = f"{' and '.join(names)} vary together and cannot be told apart"
        empty = np.full(response.size, np.nan)
        return LinearFit(nan, nan, nan, nan, np.nan, np.nan, response.size, empty, empty, note)

    keys = ("constant", *names)
    notes = [f"{name} takes one value only: its coefficient is not identified" for name in constant]
    std_error, low, high, residual_std = nan, nan, nan, np.nan
    if result.df_resid >= 1:
        interval = result.conf_int(1 - CONFIDENCE)
        std_error = nan | dict(zip(keys, map(float, result.bse)))
        low = nan | dict(zip(keys, map(float, interval[:, 0])))
        high = nan | dict(zip(keys, map(float, interval[:, 1])))
        residual_std = float(np.sqrt(result.scale))
    else:
        notes.append("no degree of freedom left for standard errors")
    has_spread = np.ptp(response) > 0 and bool(names)
    return LinearFit(
        value=nan | dict(zip(keys, map(float, result.params))),
        std_error=std_error,
        low=low,
        high=high,
        r2=float(result.rsquared) if has_spread else np.nan,
        residual_std=residual_std,
        n=response.size,
        residuals=np.asarray(result.resid),
        fitted=np.asarray(result.fittedvalues),
        note="; ".join(notes),
        _names=names,
        _result=result,
    )


def _design(regressors: Mapping[str, np.ndarray], n: int) -> np.ndarray:
    columns = [np.broadcast_to(np.asarray(x, float), (n,)) for x in regressors.values()]
    return np.column_stack([np.ones(n), *columns])
