"""What the records of the convergence study say."""

from __future__ import annotations

import numpy as np

from foilstudy.study.kernel.plan import Results
from foilstudy.study.published import HEIGHT_MM


def ensemble(
    study: Results, key: str, thickness_um: int, element: str = "corner", index: int | None = None
) -> dict[float, np.ndarray]:
    """One number of all converged seeds at the common height, by element size (mm).

    Parameters
    ----------
    key : str
        Of what `crumpling.run` returns.
    index : int, optional
        Direction, where there is one number for each.
    """
    found: dict[float, list[float]] = {}
    for case, record in study["crumples"].items():
        place = (case.thickness_um, case.element, case.height_mm)
        if place == (thickness_um, element, HEIGHT_MM) and record["status"] == "converged":
            value = record[key] if index is None else record[key][index]
            found.setdefault(case.size_mm, []).append(value)
    return {size: np.array(values, float) for size, values in sorted(found.items())}
