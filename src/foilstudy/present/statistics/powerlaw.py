"""Power law of the static stiffness in overlength and thickness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.reference import PowerLaw, PublishedLaw, published
from foilstudy.present.statistics.cells import Samples, measured, samples
from foilstudy.present.statistics.regression import LinearFit, fit_linear

SIMULATED = {
    "simulation": "static_stiffness",
    "simulation mesh limit": "static_stiffness_converged",
    "simulation pre-stressed": "prestressed_stiffness",
    "simulation pre-stressed refined": "prestressed_stiffness_converged",
}
"""Source of a simulated power law and the cube variable it is fitted to."""

NORMAL_95 = 1.959964
"""Half width of a two-sided 95 % interval of the normal distribution in standard deviations."""


@dataclass(frozen=True)
class FittedLaw:
    """A power law fitted to realisations.

    Attributes
    ----------
    fit : LinearFit
        The least-squares fit; its regressors are called ``overlength`` and ``thickness``.
    configuration : ndarray of int, shape (n,)
        Label of the realisations that share thickness and overlength.
    """

    fit: LinearFit
    configuration: np.ndarray

    @property
    def law(self) -> PowerLaw:
        """The law with the fitted values; NaN where the realisations do not determine one."""
        value = self.fit.value
        return PowerLaw(value["constant"], value["overlength"], value["thickness"])


def fit_power_law(data: Samples) -> FittedLaw:
    """Fit the power law to realisations by ordinary least squares on the logarithms.

    Parameters
    ----------
    data : Samples
        Stiffness in N/m.
    """
    fit = fit_linear(
        np.log(data.value),
        {
            "overlength": np.log(data.overlength_percent),
            "thickness": np.log(data.thickness_um),
        },
    )
    return FittedLaw(fit, data.configuration)


def simulated_law(cube, direction: str, source: str = "simulation") -> FittedLaw:
    """Fit the power law to all usable realisations of the cube.

    Parameters
    ----------
    direction
        ``axial`` or ``radial``.
    source
        A key of `SIMULATED`: ``simulation`` is the stress-free stiffness on the crumpled mesh,
        ``mesh limit`` that of the same shapes at element size zero, ``pre-stressed`` has the
        stress left in, and ``refined`` was relaxed again on refined meshes.
    """
    return fit_power_law(samples(cube, SIMULATED[source], direction=direction))


def sources_in(cube) -> list[str]:
    """Sources of `SIMULATED` that the cube has values for, and ``simulation`` always."""
    return [
        source
        for source, name in SIMULATED.items()
        if source == "simulation" or (name in cube and np.isfinite(cube[name]).any())
    ]


def powerlaw_table(cube):
    """Return coefficients, uncertainty and residual checks per direction and source.

    The standard errors ``*_se`` assume independent residuals; ``*_se_clustered`` allow for the
    residuals of one configuration to be alike, which ``lack_of_fit_p`` tests. Only positive
    values have a logarithm: ``note`` says how many others were left out. Published rows carry the
    published standard deviation, with a normal 95 % interval.
    """
    import pandas as pd

    rows = []
    for direction in map(str, cube["direction"].values):
        for source in sources_in(cube):
            row = _simulated_row(simulated_law(cube, direction, source))
            left_out = _left_out(measured(cube, SIMULATED[source], direction=direction))
            row["note"] = "; ".join(filter(None, [row["note"], left_out]))
            rows.append({"direction": direction, "source": source} | row)
        for source, law in published().power_laws[direction].items():
            rows.append(
                {"direction": direction, "source": f"published {source}"} | _published_row(law)
            )
    return pd.DataFrame(rows)


def _left_out(values) -> str:
    n, left_out = int(np.isfinite(values).sum()), int((values <= 0).sum())
    return f"{left_out} of {n} values are not positive and do not enter" if left_out else ""


def _simulated_row(law: FittedLaw) -> dict:
    fit = law.fit
    clustered = fit.clustered_std_error(law.configuration)
    row = {}
    for name, key in (("alpha", "constant"), ("beta", "overlength"), ("gamma", "thickness")):
        row |= {
            name: fit.value[key],
            f"{name}_se": fit.std_error[key],
            f"{name}_low": fit.low[key],
            f"{name}_high": fit.high[key],
            f"{name}_se_clustered": clustered[key],
        }
    return row | {
        "r2": fit.r2,
        "n": fit.n,
        "residual_std": fit.residual_std,
        "normality_p": fit.normality_p(),
        "heteroscedasticity_p": fit.heteroscedasticity_p(),
        "residual_rank_correlation": fit.residual_rank_correlation(),
        "lack_of_fit_p": fit.lack_of_fit_p(law.configuration),
        "note": fit.note,
    }


def _published_row(law: PublishedLaw) -> dict:
    row = {}
    for name in ("alpha", "beta", "gamma"):
        value, std = getattr(law, name)
        row |= {
            name: value,
            f"{name}_se": std,
            f"{name}_low": value - NORMAL_95 * std,
            f"{name}_high": value + NORMAL_95 * std,
        }
    return row | {"r2": law.r2, "note": f"{published().citation}; n not stated"}
