"""Power law of the static stiffness in overlength and thickness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from foilstudy.base.confidence import NORMAL_95
from foilstudy.base.reference import PowerLaw, PublishedLaw
from foilstudy.present.comparison import comparable
from foilstudy.present.statistics.cells import Samples, measured, samples
from foilstudy.present.statistics.regression import LinearFit, fit_linear
from foilstudy.present.statistics.trust import assess_trust, where_trusted

LIMIT = "simulation mesh limit"
PLAIN = "simulation"
AS_IT_STANDS = "simulation as it stands"
PRESTRESSED = "simulation pre-stressed"
SIMULATED = {
    LIMIT: "static_stiffness_converged",
    PLAIN: "static_stiffness",
    AS_IT_STANDS: "true_stiffness",
    PRESTRESSED: "prestressed_stiffness",
    "simulation pre-stressed refined": "prestressed_stiffness_converged",
}
"""Source of a simulated power law and the cube variable it is fitted to; the best one first."""

TRUSTED = "simulation mesh limit, trusted"
"""Source of the law of the mesh limit of those configurations alone that are trusted."""


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
    return FittedLaw(fit.allowing_for(data.configuration), data.configuration)


def simulated_law(cube, direction: str, source: str = PLAIN) -> FittedLaw:
    """Fit the power law to all usable realisations of the cube.

    Parameters
    ----------
    direction
        ``axial`` or ``radial``.
    source
        A key of `SIMULATED`: ``simulation`` is the stress-free stiffness on the crumpled mesh,
        ``simulation mesh limit`` that of the same shapes at element size zero, ``simulation
        as it stands`` that of a foil that yields, touches or has been waited for, ``simulation
        pre-stressed`` has the stress left in, and ``simulation pre-stressed refined`` was relaxed
        again on refined meshes. Or `TRUSTED`.
    """
    return fit_power_law(law_samples(cube, direction, source))


def law_samples(cube, direction: str, source: str) -> Samples:
    """The realisations that a law is fitted to, see `simulated_law`."""
    if source == TRUSTED:
        name = SIMULATED[LIMIT]
        cube = cube.assign({name: where_trusted(cube, name)})
    else:
        name = SIMULATED[source]
    return samples(cube, name, direction=direction)


def sources_in(cube) -> list[str]:
    """Sources of `SIMULATED` that the cube has values for, and ``simulation`` always.

    A mesh limit without a stated error is none: older cubes repeat the plain stiffness there.
    """
    needed = {source: (name,) for source, name in SIMULATED.items()}
    needed[LIMIT] += ("static_stiffness_mesh_error",)
    return [
        source
        for source, names in needed.items()
        if source == PLAIN or all(name in cube and np.isfinite(cube[name]).any() for name in names)
    ]


def answering_source(cube, direction: str) -> str | None:
    """Source of the law that answers: of the mesh limit, of the trusted configurations alone.

    None where no configuration is trusted. Where all are, it is that of the mesh limit itself.
    """
    trust = assess_trust(cube)
    if not trust.trusted.sel(direction=direction).any():
        return None
    return TRUSTED if trust.doubted.sel(direction=direction).any() else LIMIT


def shown_source(cube, direction: str) -> str:
    """Source of the law that figures show: the one that answers, or the best one that there is."""
    return answering_source(cube, direction) or sources_in(cube)[0]


def powerlaw_table(cube):
    """Return coefficients, uncertainty and residual checks per direction and source.

    ``*_low`` to ``*_high`` is the 95 % interval. ``interval`` says of which kind:
    ``independent`` residuals, or ``clustered`` by configuration where ``lack_of_fit_p`` is below
    0.05. The standard errors ``*_se`` assume independent residuals, ``*_se_clustered`` do not. Only
    positive values have a logarithm: ``note`` says how many others were left out.

    The law that answers stands first: `TRUSTED` where some configurations are not trusted, else
    that of the mesh limit. Published rows are there for the published case alone, and carry the
    published standard deviation, with a normal 95 % interval.
    """
    import pandas as pd

    reference = comparable(cube)
    rows = []
    for direction in map(str, cube["direction"].values):
        if answering_source(cube, direction) == TRUSTED:
            row = _simulated_row(simulated_law(cube, direction, TRUSTED))
            rows.append({"direction": direction, "source": TRUSTED} | row)
        for source in sources_in(cube):
            row = _simulated_row(simulated_law(cube, direction, source))
            left_out = _left_out(measured(cube, SIMULATED[source], direction=direction))
            row["note"] = "; ".join(filter(None, [row["note"], left_out]))
            rows.append({"direction": direction, "source": source} | row)
        for source, law in reference.power_laws[direction].items() if reference else ():
            row = _published_row(law, reference.citation)
            rows.append({"direction": direction, "source": f"published {source}"} | row)
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
        "interval": fit.interval,
        "note": fit.note,
    }


def _published_row(law: PublishedLaw, citation: str) -> dict:
    row = {}
    for name in ("alpha", "beta", "gamma"):
        value, std = getattr(law, name)
        row |= {
            name: value,
            f"{name}_se": std,
            f"{name}_low": value - NORMAL_95 * std,
            f"{name}_high": value + NORMAL_95 * std,
        }
    return row | {"r2": law.r2, "interval": "normal", "note": f"{citation}; n not stated"}
