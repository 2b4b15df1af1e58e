"""How the stress is taken out of a crumple before its stress-free stiffness is measured."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Protocol, runtime_checkable

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.patch import Patch
from foilstudy.model.shell.shell import Shell


class Relieved(Protocol):
    """What is measured once the stress has been taken out; a `Shell` is one.

    Attributes
    ----------
    patch : Patch
    """

    patch: Patch

    def tangent(self) -> sparse.csr_matrix:
        """Stiffness in the shape that was relieved, all control points, see `Shell.tangent`."""
        ...

    def tangent_blocks(self) -> np.ndarray:
        """The same by control point and neighbour, see `Shell.tangent_blocks`."""
        ...


@runtime_checkable
class Residual(Relieved, Protocol):
    """What still has stress in it."""

    def residual_force(self) -> np.ndarray:
        """Of that stress on the control points, shape (3, rows, columns), N."""
        ...


class StressRemoval(Protocol):
    """A way to a shell whose stiffness is called stress-free; a frozen specification."""

    def relieved(self, shell: Shell, points: np.ndarray) -> Relieved:
        """The shell that is measured, from one that is stressed in the shape `points`."""
        ...


@dataclass(frozen=True)
class Reset:
    """The shape becomes the rest shape: exact, no residual stress."""

    kind = "reset"

    def relieved(self, shell: Shell, points: np.ndarray) -> Shell:
        """See `StressRemoval`."""
        return Shell(replace(shell.section, reference=points), shell.element)
