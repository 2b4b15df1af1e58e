"""The tables of a study as CSV files: a list that is cheap to import, and what writes them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from foilstudy.base.files import written_whole
from foilstudy.base.registry import Choice


@dataclass(frozen=True)
class TableSpec(Choice):
    """One table of a study: a function of the cube that returns a data frame.

    Attributes
    ----------
    place, words : str
        The function, and the caption in full sentences.
    title : str
        What it holds, for a list of files.
    """

    title: str


TABLES = {
    "powerlaw": TableSpec(
        "present.statistics.powerlaw:powerlaw_table",
        "Least-squares fit of ln k = alpha + beta ln(overlength / %) + gamma ln(thickness / um) to "
        "the axial and the radial stiffness k in N/m, with standard errors, 95 % intervals "
        "(clustered by configuration where the law lacks fit) and R2: in the mesh limit (of the "
        "trusted configurations, and of all), on the crumpled mesh, and with the stress left in; "
        "beside them, for the published case alone, the published fits to simulation and to "
        "experiment.",
        "power laws and their uncertainty",
    ),
    "stiffness_summary": TableSpec(
        "present.statistics.summary:stiffness_summary",
        "Static stiffness of every configuration over its realisations, on the crumpled mesh and "
        "in the mesh limit, with the stated mesh error and whether it is trusted.",
        "static stiffness of every configuration",
    ),
    "variability": TableSpec(
        "present.statistics.variability:variability_table",
        "Coefficient of variation (standard deviation over mean) over the realisations of every "
        "configuration, of the stiffness on the crumpled mesh, in the mesh limit and with the "
        "stress left in.",
        "coefficients of variation",
    ),
    "variability_law": TableSpec(
        "present.statistics.variability:variability_law_table",
        "Linear regression of the coefficient of variation on the overlength, per direction.",
        "coefficient of variation against overlength",
    ),
    "eigenfrequency_law": TableSpec(
        "present.statistics.eigenfrequency:eigenfrequency_table",
        "First eigenfrequency with both rings clamped, as a power of the reference height, for "
        "each thickness, with 95 % intervals; beside it, for the published case alone, the "
        "published exponents.",
        "exponents of the first eigenfrequency",
    ),
    "isolation": TableSpec(
        "present.statistics.isolation:isolation_table",
        "How far up in frequency the transfer stiffness of the foil links of each configuration "
        "stays within the allowed share of the mount's, for a mount without mass and for one with "
        "a resonance of its own: median and least favourable realisation, and the static share.",
        "links of every configuration beside a mount",
    ),
}
"""By file stem."""


def write_tables(cube, out_dir) -> list[Path]:
    """Write every table of the study as ``<name>.csv``.

    Parameters
    ----------
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
            frame = table.load()(cube)
            frame.to_csv(partial, index=False, float_format="%.6g", lineterminator="\n")
        paths.append(path)
    return paths
