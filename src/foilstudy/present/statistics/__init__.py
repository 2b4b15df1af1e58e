"""Laws fitted to the cube, their uncertainty, and their comparison with published values."""

from foilstudy.present.statistics.eigenfrequency import eigenfrequency_table
from foilstudy.present.statistics.powerlaw import (
    SIMULATED,
    FittedLaw,
    fit_power_law,
    powerlaw_table,
    simulated_law,
    sources_in,
)
from foilstudy.present.statistics.regression import LinearFit, fit_linear
from foilstudy.present.statistics.summary import stiffness_summary
from foilstudy.present.statistics.tables import TABLES, write_tables
from foilstudy.present.statistics.variability import (
    coefficient_of_variation,
    coefficient_of_variation_interval,
    fit_variability,
    plain_scatter,
    variability_law_table,
    variability_table,
)

__all__ = [
    "SIMULATED",
    "TABLES",
    "FittedLaw",
    "LinearFit",
    "coefficient_of_variation",
    "coefficient_of_variation_interval",
    "eigenfrequency_table",
    "fit_linear",
    "fit_power_law",
    "fit_variability",
    "plain_scatter",
    "powerlaw_table",
    "simulated_law",
    "sources_in",
    "stiffness_summary",
    "variability_law_table",
    "variability_table",
    "write_tables",
]
