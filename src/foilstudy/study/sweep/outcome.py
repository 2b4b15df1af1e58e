"""How the work of a job ends: with values, or with the reason why there are none."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from foilstudy.base.record import MACHINE_FAULTS

Values = dict[str, np.ndarray | float]
"""By the names of `foilstudy.study.sweep.quantities.QUANTITIES`; SI."""


@dataclass(frozen=True)
class Outcome:
    """Status and message, as they stand in a record, its values, and what else it says."""

    status: str
    message: str
    values: Values = field(default_factory=dict)
    attributes: dict[str, str] = field(default_factory=dict)


def outcome_of(work: Callable[[], Outcome]) -> Outcome:
    """What `work` returns; ``failed`` if it cannot, as a study must survive any one realisation.

    A fault of the machine is none of the realisation: it is passed on, and the job done again.
    """
    try:
        return work()
    except MACHINE_FAULTS:
        raise
    except Exception as error:
        traceback.print_exc()
        return Outcome("failed", f"{type(error).__name__}: {error}")
