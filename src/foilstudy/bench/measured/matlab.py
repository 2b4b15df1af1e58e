"""Responses from MATLAB variables.

``frequency_Hz``, ``response`` (complex) and ``unit`` (text); perhaps ``deviation`` and
``coherence``. Several functions stand in structures, by their names.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.bench.estimation.estimate import Estimate
from foilstudy.bench.measured.conversion import as_stiffness, unit_named
from foilstudy.bench.measured.table import chosen

__all__ = ["read", "variables"]

_NEEDED = ("frequency_Hz", "response", "unit")


def read(path: Path, function: str | None = None) -> Estimate:
    """See `Reader`."""
    content = variables(path)
    if not content.keys() >= set(_NEEDED):
        names = [k for k, v in content.items() if isinstance(v, dict) and v.keys() >= set(_NEEDED)]
        if not names:
            there = ", ".join(k for k in content if not k.startswith("__"))
            raise Refusal(
                f"{path}: holds {there or 'nothing'}, not {', '.join(_NEEDED)}; save these three."
            )
        content = content[chosen(path, names, function)]
    quantity, size = unit_named(str(content["unit"]), path)
    deviation = content.get("deviation")
    return as_stiffness(
        path, quantity, content["frequency_Hz"], size * np.asarray(content["response"]),
        None if deviation is None else size * np.asarray(deviation), content.get("coherence"),
    )  # fmt: skip


def variables(path: Path) -> dict[str, Any]:
    """Everything in a MATLAB file, by name.

    Raises
    ------
    Refusal
        If it cannot be read.
    """
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError

    try:
        return loadmat(path, simplify_cells=True)
    except NotImplementedError:
        raise Refusal(f"{path}: is of version 7.3; save it with -v7.") from None
    except (ValueError, TypeError, OSError, MatReadError) as error:
        raise Refusal(f"{path}: cannot be read as a MATLAB file ({error}); save it anew.") from None
