"""How the stress is taken out of a crumple before its stress-free stiffness is measured."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from foilstudy.model.shell.shell import Shell


class StressRemoval(Protocol):
    """A way to a shell whose stiffness is called stress-free; a frozen specification."""

    def relieved(self, shell: Shell, points: np.ndarray) -> Shell:
        """The shell that is measured, from one that is stressed in the shape `points`."""
        ...


@dataclass(frozen=True)
class Reset:
    """The shape becomes the rest shape: exact, no residual stress."""

    kind = "reset"

    def relieved(self, shell: Shell, points: np.ndarray) -> Shell:
        """See `StressRemoval`."""
        return Shell(replace(shell.section, reference=points), shell.element)
