"""Power law of the first eigenfrequency in the reference height."""

from __future__ import annotations

import numpy as np

from foilstudy.present.comparison import comparable
from foilstudy.present.statistics.cells import Samples, samples
from foilstudy.present.statistics.regression import LinearFit, fit_linear


def fit_eigenfrequency_law(data: Samples) -> LinearFit:
    """Fit ``ln(f1/Hz) = constant + n ln(h_ref/mm)`` to the realisations of one thickness.

    Parameters
    ----------
    data : Samples
        First eigenfrequency in Hz.

    Returns
    -------
    LinearFit
        Its only regressor is called ``reference_height``. Where the heights depart from the law by
        more than seeds explain, its intervals allow for it.
    """
    heights = {"reference_height": np.log(data.reference_height_mm)}
    return fit_linear(np.log(data.value), heights).allowing_for(data.configuration)


def eigenfrequency_table(cube):
    """Return the exponent of the first eigenfrequency (rings clamped) per thickness.

    Returns
    -------
    pandas.DataFrame
        ``ln(f1/Hz) = constant + exponent ln(h_ref/mm)``, with a 95 % interval. With
        ``lack_of_fit_p`` below 0.05 the heights depart from the law by more than seeds explain;
        the interval allows for it then and is called ``clustered``. ``published_exponent`` is
        there for the published case alone, and NaN at a thickness without a published value.
    """
    import pandas as pd

    data = samples(cube, "first_eigenfrequency")
    reference = comparable(cube)
    rows = []
    for thickness in map(float, cube["thickness"].values):
        mine = data.at_thickness(thickness)
        fit = fit_eigenfrequency_law(mine)
        rows.append(
            {
                "thickness_um": thickness,
                "exponent": fit.value["reference_height"],
                "exponent_se": fit.std_error["reference_height"],
                "exponent_low": fit.low["reference_height"],
                "exponent_high": fit.high["reference_height"],
                "constant": fit.value["constant"],
                "constant_se": fit.std_error["constant"],
                "r2": fit.r2,
                "n": fit.n,
                "residual_std": fit.residual_std,
                "lack_of_fit_p": fit.lack_of_fit_p(mine.configuration),
                "interval": fit.interval,
                "note": fit.note,
            }
        )
        if reference:
            known = reference.first_eigenfrequency_exponents.get(thickness, np.nan)
            rows[-1]["published_exponent"] = known
    return pd.DataFrame(rows)
