"""The tables of a study as CSV files."""

from __future__ import annotations

from pathlib import Path

from foilstudy.base.files import written_whole
from foilstudy.present.statistics.eigenfrequency import eigenfrequency_table
from foilstudy.present.statistics.isolation import isolation_table
from foilstudy.present.statistics.powerlaw import powerlaw_table
from foilstudy.present.statistics.summary import stiffness_summary
from foilstudy.present.statistics.variability import variability_law_table, variability_table

TABLES = {
    "powerlaw": powerlaw_table,
    "stiffness_summary": stiffness_summary,
    "variability": variability_table,
    "variability_law": variability_law_table,
    "eigenfrequency_law": eigenfrequency_table,
    "isolation": isolation_table,
}
"""File stem of each table and the function of the cube that makes it."""


def write_tables(cube, out_dir) -> list[Path]:
    """Write every table of the study as ``<name>.csv``.

    Parameters
    ----------
    cube : xarray.Dataset
    out_dir : folder for the tables, made if missing

    Returns
    -------
    list of Path
        The files written, in the order of `TABLES`.
    """
    paths = []
    for name, table in TABLES.items():
        path = Path(out_dir) / f"{name}.csv"
        with written_whole(path) as partial:
            table(cube).to_csv(partial, index=False, float_format="%.6g", lineterminator="\n")
        paths.append(path)
    return paths
