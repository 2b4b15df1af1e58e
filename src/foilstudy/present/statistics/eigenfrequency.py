"""Power law of the first eigenfrequency in the reference height."""

from __future__ import annotations

import numpy as np

from foilstudy.base.reference import published
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
        Its only regressor is called ``reference_height``.
    """
    return fit_linear(np.log(data.value), {"reference_height": np.log(data.reference_height_mm)})


def eigenfrequency_table(cube):
    """Return the exponent of the first eigenfrequency (rings clamped) per thickness.

    Returns
    -------
    pandas.DataFrame
        ``ln(f1/Hz) = constant + exponent ln(h_ref/mm)``; ``published_exponent`` is NaN at a
        thickness without a published value. With a small ``lack_of_fit_p`` the heights depart from
        the law by more than seeds explain, and the interval of the exponent is too narrow.
    """
    import pandas as pd

    data = samples(cube, "first_eigenfrequency")
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
                "published_exponent": published().first_eigenfrequency_exponents.get(
                    thickness, np.nan
                ),
                "note": fit.note,
            }
        )
    return pd.DataFrame(rows)
