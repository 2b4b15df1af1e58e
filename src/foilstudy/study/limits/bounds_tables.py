"""Reductions, stressed modes and paths on a quarter as tables."""

from __future__ import annotations

import numpy as np

from foilstudy.base.tables import markdown_table
from foilstudy.study.kernel.plan import Records


def reductions(records: Records) -> list[dict]:
    """One row for each crumple, reduction and frequency."""
    return [
        {
            "thickness_um": case.thickness_um,
            "seed": case.seed,
            "cutoff_hz": case.cutoff_hz,
            "reduction": name,
            "size": found["size"],
            "estimate": found["estimate"],
            "valid_to_hz": found["valid_to_hz"],
            "over_cutoff": over,
            "error": error,
        }
        for case, record in records["vibrations"].items()
        for name, found in record.result.get("reductions", {}).items()
        for over, error in zip(record.result["over_cutoff"], found["errors"], strict=True)
    ]


def stressed_modes(records: Records) -> list[dict]:
    """One row for each crumple and mode."""
    return [
        {
            "thickness_um": case.thickness_um,
            "seed": case.seed,
            "mode": k + 1,
            "eigenfrequency_hz": free,
            "stressed_eigenfrequency_hz": held,
            "loss_factor_over_that_of_the_material": loss,
        }
        for case, record in records["vibrations"].items()
        if "loss" in record.result
        for k, (free, held, loss) in enumerate(
            zip(
                record.result["eigenfrequencies"],
                record.result["stressed_eigenfrequencies"],
                record.result["loss"],
                strict=True,
            )
        )
    ]


def quarters(records: Records) -> list[dict]:
    """One row for each path."""
    return [
        {
            "path": case.path,
            "surface": case.surface,
            "size_mm": case.size_mm,
            "amplitude_um": case.amplitude_um,
            "budget": case.budget,
            **record.result,
        }
        for case, record in records["quarters"].items()
    ]


def page(records: Records) -> str:
    """All three for people."""
    return "\n".join((_errors(records), _losses(records), _paths(records)))


def _errors(records: Records) -> str:
    heads, body = [], []
    for case, record in records["vibrations"].items():
        result = record.result
        if "reductions" not in result:
            continue
        heads = [
            "foil, cut-off", "reduction", "coordinates", "valid to, over cut-off",
            *(f"error at {over:g}" for over in result["over_cutoff"]),
        ]  # fmt: skip
        body += [
            [
                f"{case.thickness_um} um, {case.cutoff_hz:g} Hz",
                name,
                str(found["size"]),
                f"{found['valid_to_hz'] / case.cutoff_hz:.2g}",
                *(f"{error:.1g}" for error in found["errors"]),
            ]
            for name, found in result["reductions"].items()
        ]
    return markdown_table(heads, body) if body else "No crumple came to rest.\n"


def _losses(records: Records) -> str:
    body = []
    for case, record in records["vibrations"].items():
        if "loss" not in record.result:
            continue
        loss = np.array(record.result["loss"])
        free, held = (
            record.result[name][0] for name in ("eigenfrequencies", "stressed_eigenfrequencies")
        )
        body.append(
            [
                f"{case.thickness_um} um, seed {case.seed}",
                f"{free:.3g}",
                f"{held:.3g}",
                f"{loss.min():.2g} to {loss.max():.2g}",
                f"{np.median(loss):.2g}",
            ]
        )
    heads = ["foil", "first eigenfrequency without stress, Hz", "with it, Hz",
             "loss factor of twenty modes over that of the material", "median"]  # fmt: skip
    return markdown_table(heads, body)


def _paths(records: Records) -> str:
    body = [
        [
            f"{case.size_mm:g} mm, {case.amplitude_um:g} um",
            f"{case.path}, {case.surface}" if case.surface else case.path,
            f"{100 * result['reached_within']:.3g} %",
            f"{100 * result['reached']:.3g} %",
            result["status"].replace("_", " "),
            str(result["factorisations"]),
            str(result["turns"]),
            str(result["negative_eigenvalues"]),
        ]
        for case, record in records["quarters"].items()
        for result in (record.result,)
    ]
    heads = ["elements, imperfection", "path", "reached by a fifth of the budget", "by all of it",
             "end", "factorisations", "turns", "negative eigenvalues"]  # fmt: skip
    return markdown_table(heads, body)
