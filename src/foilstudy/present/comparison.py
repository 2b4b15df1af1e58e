"""Whether a study is of the published case, without which nothing published stands beside it."""

from __future__ import annotations

from foilstudy.base.reference import Case, Published, published
from foilstudy.present.configuration import configuration


def studied_case(cube) -> Case | None:
    """The foil and the sweep of a study; None where its configuration does not tell them."""
    config = configuration(cube)
    sheet, material = config.get("sheet") or {}, config.get("material") or {}
    thicknesses, overlengths = cube["thickness"].values, cube["overlength"].values
    try:
        return Case(
            diameter_mm=float(sheet["diameter_mm"]),
            gap_height_mm=float(sheet["gap_height_mm"]),
            youngs_modulus_mpa=float(material["youngs_modulus_mpa"]),
            poisson_ratio=float(material["poisson_ratio"]),
            density_kg_m3=float(material["density_kg_m3"]),
            thickness_um=(float(thicknesses.min()), float(thicknesses.max())),
            overlength_percent=(float(overlengths.min()), float(overlengths.max())),
        )
    except KeyError:
        return None


def comparable(cube) -> Published | None:
    """The published results where the study is of their case, and None elsewhere."""
    studied = studied_case(cube)
    if studied is None or published().case.departures(studied):
        return None
    return published()


def comparison_sentence(cube) -> str:
    """Say why there is nothing published to compare the study with; empty where there is."""
    studied = studied_case(cube)
    if studied is None:
        why = "its configuration does not tell foil and gap"
    elif departures := published().case.departures(studied):
        why = ", ".join(departures)
    else:
        return ""
    return f"There is nothing published to compare this study with: {why}."
