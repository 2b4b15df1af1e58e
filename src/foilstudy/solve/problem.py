"""A problem: the potential energy of a sheet as a sum of terms, over an explicit state.

Relaxation and minimisation take a problem and know nothing of what it is made of. The shell is the
first term; loads, contact or the stress of a plastic foil are further ones. A term
without memory has the state None. One with memory is evaluated at the state that was last
committed; `commit` lets every term take note of a shape that has been reached.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, runtime_checkable

import numpy as np
import scipy.sparse as sparse

from foilstudy.base.errors import Refusal
from foilstudy.linalg import SymmetricBlocks
from foilstudy.model.patch import RING_ROWS, Patch
from foilstudy.model.shell.held import held_blocks
from foilstudy.model.shell.shell import Shell

__all__ = [
    "Following",
    "GivingWay",
    "Joint",
    "Lagging",
    "Lasting",
    "Problem",
    "Resting",
    "Telling",
    "Term",
]


class Term(Protocol):
    """A share of the potential energy, as a function of the control points at a given state.

    States are values: a term never changes one, it returns another.

    Attributes
    ----------
    energy_names : tuple of str
        What the energies that `force` returns are called.
    """

    energy_names: tuple[str, ...]

    def start(self) -> Any:
        """State of what nothing has happened to yet; None if the term has no memory."""
        ...

    def force(self, points: np.ndarray, out: np.ndarray, state: Any) -> np.ndarray:
        """Write the derivative of the energy by the control points, N, and return the energies, J.

        Parameters
        ----------
        points, out : ndarray, shape (3, rows, columns)
        state
            From `start` or `evolved`.

        Returns
        -------
        ndarray, shape (len(energy_names),)
        """
        ...

    def tangent(self, points: np.ndarray, state: Any) -> sparse.csr_matrix:
        """Derivative of the force, all control points, ordered row, column, component, N/m."""
        ...

    def evolved(self, points: np.ndarray, state: Any) -> Any:
        """State once the shape has been reached from `state`."""
        ...


@runtime_checkable
class Telling(Term, Protocol):
    """A term of which there is more to know than its energy."""

    def numbers(self, state: Any) -> dict[str, float]:
        """What is worth knowing of the state, or of the last shape, by the names of quantities."""
        ...


@runtime_checkable
class Lasting(Telling, Protocol):
    """A term whose state can be kept in a record and taken to a finer mesh."""

    def recorded(self, state: Any) -> dict[str, np.ndarray]:
        """The state as arrays, by the names of quantities."""
        ...

    def split(self, state: Any) -> dict[str, np.ndarray]:
        """The same with every element split in four."""
        ...

    def restored(self, values: Mapping[str, np.ndarray]) -> Any:
        """The state that arrays tell of, on this term's own mesh."""
        ...


@runtime_checkable
class Following(Term, Protocol):
    """A term whose state goes where energy and what has been spent are least together.

    So the force at the state that a shape leads to is the derivative of that sum, and a minimum can
    be sought with the state following; of other terms it is held.
    """

    def spent(self, state: Any) -> float:
        """What the state has used up or holds back beside the energy of the term, J."""
        ...


@runtime_checkable
class Lagging(Following, Protocol):
    """One that follows within a step by what the shape last committed decides, as friction does.

    Its `evolved` is what commits: it takes note of what the new shape decides.
    """

    def led(self, points: np.ndarray, state: Any) -> Any:
        """State that a shape leads to within the step."""
        ...


@runtime_checkable
class GivingWay(Term, Protocol):
    """A support of the rings' own control points that does not hold whatever pulls at them."""

    def given_way(self, points: np.ndarray, force: np.ndarray, state: Any, at_rest: bool) -> Any:
        """Move control points of the rings where the force on them is too large; the state then.

        `at_rest` says whether the rings themselves stand still.
        """
        ...

    def unheld(self, points: np.ndarray, force: np.ndarray, state: Any) -> float:
        """Norm of the forces by which it is too large, N."""
        ...

    def used_up(self, state: Any) -> float:
        """Work by which it has given way, J."""
        ...

    def raised(self, points: np.ndarray, state: Any) -> float:
        """How far it has moved the control points of the top ring upwards, their mean, m."""
        ...


@runtime_checkable
class Joint(Term, Protocol):
    """A term of a shell that is evaluated together with it at less cost than by itself.

    Attributes
    ----------
    shell : Shell
    """

    shell: Shell

    def gradient_with_shell(self, points: np.ndarray, out: np.ndarray, state: Any) -> None:
        """Write the force of both, N."""
        ...

    def force_with_shell(self, points: np.ndarray, out: np.ndarray, state: Any) -> np.ndarray:
        """The same; return the energies, those of the shell first, J."""
        ...


@runtime_checkable
class Resting(Term, Protocol):
    """A term that exerts nothing most of the time, and tells so at little cost."""

    def rests(self, points: np.ndarray) -> bool:
        """Whether it exerts nothing in a shape, of which it then takes note as `force` does."""
        ...


class Problem:
    """A shell and what acts on it.

    Parameters
    ----------
    shell : Shell
    others : Term
        Further terms.
    whole : Shell, optional
        As stiff as shell and terms together at least, where the shell is only a share of the foil;
        the masses of a relaxation are made for it.

    Attributes
    ----------
    shell, whole : Shell
    beginning : ndarray, shape (3, rows, columns)
        Control points from which a motion sets out, m: the stress-free ones, unless the rings of
        the sheet are elsewhere.
    terms : tuple of Term
    energy_names : tuple of str
        Of all terms, in their order; the first ones are the shell's.
    state : tuple
        One for each term; as last committed.
    """

    def __init__(self, shell: Shell, *others: Term, whole: Shell | None = None):
        self.shell, self.whole = shell, whole or shell
        self.beginning = shell.reference
        self.terms: tuple[Term, ...] = (shell, *others)
        # what is evaluated together with the shell, if anything is, and how many terms that makes
        joint = bool(others) and isinstance(others[0], Joint) and others[0].shell is shell
        self._joint: Joint | None = others[0] if joint else None
        self._first = 2 if joint else 1
        self._resting = tuple(isinstance(term, Resting) for term in self.terms)
        self._giving_way = tuple(isinstance(term, GivingWay) for term in self.terms)
        self.gives_way = any(self._giving_way)
        names = [name for term in self.terms for name in term.energy_names]
        # a second one of a name is told apart
        self.energy_names = tuple(
            f"{name}_{k + 1}" if (k := names[:i].count(name)) else name
            for i, name in enumerate(names)
        )
        self.state: tuple[Any, ...] = tuple(term.start() for term in self.terms)

    @property
    def patch(self) -> Patch:
        """That of the shell."""
        return self.shell.patch

    @property
    def reference(self) -> np.ndarray:
        """Stress-free control points of the shell, shape (3, rows, columns), m."""
        return self.shell.reference

    @property
    def has_memory(self) -> bool:
        """Whether any term depends on what has happened before."""
        return any(state is not None for state in self.state)

    def force(
        self, points: np.ndarray, out: np.ndarray, state: tuple[Any, ...] | None = None
    ) -> np.ndarray:
        """Write the gradient of the potential energy, N; return the energies of all terms, J.

        Parameters
        ----------
        points, out : ndarray, shape (3, rows, columns)
        state : tuple, optional
            Another one than that last committed.
        """
        states = self.state if state is None else state
        if self._joint:
            energies = self._joint.force_with_shell(points, out, states[1])
        else:
            energies = self.shell.force(points, out, states[0])
        if self._first == len(self.terms):
            return energies
        return np.concatenate([energies, *self._add_others(points, out, states)])

    def gradient(self, points: np.ndarray, out: np.ndarray) -> None:
        """The same bits without the energies, which cost a little."""
        if self._joint is None:
            self.shell.force(points, out, self.state[0])
        else:
            self._joint.gradient_with_shell(points, out, self.state[1])
        self._add_others(points, out, self.state)

    def _add_others(
        self, points: np.ndarray, out: np.ndarray, states: tuple[Any, ...]
    ) -> list[np.ndarray]:
        """Add what the terms beside the shell exert; return their energies, J."""
        energies, share = [], None
        for k in range(self._first, len(self.terms)):
            term = self.terms[k]
            if self._resting[k] and term.rests(points):
                energies.append(np.zeros(len(term.energy_names)))
                continue
            share = np.empty_like(out) if share is None else share
            energies.append(term.force(points, share, states[k]))
            out += share
        return energies

    def value(self, points: np.ndarray) -> float:
        """Potential energy, J."""
        return float(self.force(points, np.empty_like(points)).sum())

    def followed(self, points: np.ndarray) -> tuple[Any, ...]:
        """The state that a shape leads to, nothing committed; held where no term follows."""
        return tuple(
            _led(term, points, state) for term, state in zip(self.terms, self.state, strict=True)
        )

    def spent(self, state: tuple[Any, ...]) -> float:
        """What terms that follow have spent at a state, J."""
        pairs = zip(self.terms, state, strict=True)
        return sum((t.spent(s) for t, s in pairs if isinstance(t, Following)), start=0.0)

    def work_spent(self) -> float:
        """What the way has taken beside the energies, J: spent, and used up by supports."""
        terms = zip(self.terms, self.state, self._giving_way, strict=True)
        given = sum((t.used_up(s) for t, s, gives_way in terms if gives_way), start=0.0)
        return self.spent(self.state) + given

    def tangent(
        self, points: np.ndarray, state: tuple[Any, ...] | None = None
    ) -> sparse.csr_matrix:
        """Second derivative of the potential energy, N/m; of any sparsity, symmetric."""
        pairs = zip(self.terms, self.state if state is None else state, strict=True)
        matrices = [term.tangent(points, own) for term, own in pairs]
        return sum(matrices[1:], start=matrices[0])

    def held_tangent(
        self, points: np.ndarray, state: tuple[Any, ...] | None = None
    ) -> sparse.csr_matrix | SymmetricBlocks:
        """The same of the control points between held rings; of a mere shell in blocks.

        So it is where no other term is at work, to the same bits as without them.
        """
        own, *states = self.state if state is None else state
        pairs = zip(self.terms[1:], states, strict=True)
        others = [term.tangent(points, each) for term, each in pairs]
        if not any(matrix.nnz for matrix in others):
            return held_blocks(self.patch, self.shell.tangent_blocks(points))
        owned = RING_ROWS * 3 * self.patch.columns
        tangent = sum(others, start=self.shell.tangent(points, own))
        return tangent[owned:-owned, owned:-owned].tocsr()

    def give_way(self, points: np.ndarray, force: np.ndarray, at_rest: bool) -> None:
        """Let the rings give way to the force on them, and their control points move."""
        self.state = tuple(
            term.given_way(points, force, state, at_rest) if gives_way else state
            for term, state, gives_way in zip(self.terms, self.state, self._giving_way, strict=True)
        )

    def unheld(self, points: np.ndarray, force: np.ndarray) -> float:
        """Norm of the force on the rings that they do not hold, N."""
        terms = zip(self.terms, self.state, self._giving_way, strict=True)
        return sum(
            (t.unheld(points, force, s) for t, s, gives_way in terms if gives_way), start=0.0
        )

    def ring_height(self, points: np.ndarray) -> float:
        """Height of the top ring, m: its control points but for what they have given way."""
        terms = zip(self.terms, self.state, self._giving_way, strict=True)
        raised = sum((t.raised(points, s) for t, s, gives_way in terms if gives_way), start=0.0)
        return float(points[2, -RING_ROWS:].mean()) - raised

    def numbers(self) -> dict[str, float]:
        """What terms say of their state and of the last shape, by the names of quantities."""
        values: dict[str, float] = {}
        for term, state in zip(self.terms, self.state, strict=True):
            if isinstance(term, Telling):
                values |= term.numbers(state)
        return values

    def recorded(self) -> dict[str, np.ndarray]:
        """The state of terms whose memory lasts, as arrays by the names of quantities."""
        values: dict[str, np.ndarray] = {}
        for term, state in zip(self.terms, self.state, strict=True):
            if isinstance(term, Lasting):
                values |= term.recorded(state)
        return values

    def split(self) -> dict[str, np.ndarray]:
        """The same with every element split in four.

        Raises
        ------
        Refusal
            If a term with a memory does not know how.
        """
        values: dict[str, np.ndarray] = {}
        for term, state in zip(self.terms, self.state, strict=True):
            if isinstance(term, Lasting):
                values |= term.split(state)
            elif state is not None:
                raise Refusal(
                    f"the memory of {type(term).__name__} cannot be taken to a finer mesh; crumple "
                    "on the mesh that is wanted."
                )
        return values

    def restore(self, values: Mapping[str, np.ndarray]) -> None:
        """Take the state of terms whose memory lasts from arrays."""
        self.state = tuple(
            term.restored(values) if isinstance(term, Lasting) else state
            for term, state in zip(self.terms, self.state, strict=True)
        )

    def commit(self, points: np.ndarray) -> None:
        """Let every term take note that the shape has been reached."""
        self.state = tuple(
            t.evolved(points, s) for t, s in zip(self.terms, self.state, strict=True)
        )


def _led(term: Term, points: np.ndarray, state: Any) -> Any:
    if isinstance(term, Lagging):
        return term.led(points, state)
    return term.evolved(points, state) if isinstance(term, Following) else state
