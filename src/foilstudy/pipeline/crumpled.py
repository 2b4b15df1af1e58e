"""A crumpled foil in memory: its shape, how it was reached, and what is measured of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Self

import numpy as np

from foilstudy.base.errors import Refusal
from foilstudy.base.outcome import USABLE
from foilstudy.base.record import read_record
from foilstudy.base.spec import dumped, loaded
from foilstudy.measure.air.protocols import Air
from foilstudy.measure.air.vacuum import Vacuum
from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.measure.stiffness import prestressed_stiffness
from foilstudy.measure.stiffness.contacts import (
    ContactBracket,
    Touching,
    contact_bracket,
    contact_springs,
)
from foilstudy.measure.stiffness.stress_removal import Relieved, StressRemoval
from foilstudy.measure.verdicts import Verdict, verdicts
from foilstudy.model.contact.springs import Springs
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import Patch
from foilstudy.pipeline.evidence import evidence_of
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.rest import STRESS_KEPT_MIN, Rest, refuse_rest
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.static import (
    MeshLimit,
    mesh_limit_of,
    mesh_limit_within,
    stress_free_stiffness,
)
from foilstudy.pipeline.structures import in_air, stress_free_structure
from foilstudy.pipeline.vibration import Vibration, vibration_of
from foilstudy.solve.paths import Arrival
from foilstudy.solve.problem import Problem, Term


@dataclass(frozen=True)
class Recipe:
    """What a crumple was made by, beside its foil.

    Attributes
    ----------
    mesh : Mesh
    imperfection : Imperfection
    method : Method
    """

    mesh: Mesh
    imperfection: Imperfection
    method: Method


@dataclass(frozen=True)
class SurfaceFaults:
    """What of a shape from elsewhere no real foil does.

    Attributes
    ----------
    folded_share : float
        Of the cells of its grid: turned over, or folded back onto a neighbour.
    crossing_share : float
        Of its area: crosses the rest.
    """

    folded_share: float
    crossing_share: float

    def __str__(self) -> str:
        return (
            f"{100 * self.folded_share:.2g} % of the cells are folded back, and "
            f"{100 * self.crossing_share:.2g} % of the area crosses the rest"
        )


@dataclass(frozen=True, eq=False, repr=False)
class Crumpled(Shape):
    """A crumpled foil: a `Shape` that knows how it came about.

    Attributes
    ----------
    recipe : Recipe or None
        None for a shape from elsewhere.
    arrival : Arrival or None
        How the equilibrium was reached; None where it was not sought here.
    faults : SurfaceFaults or None
        Of a shape from elsewhere.
    rest : Rest or None
        None as long as the foil has kept all its stress.
    """

    recipe: Recipe | None = None
    arrival: Arrival | None = None
    faults: SurfaceFaults | None = None
    rest: Rest | None = None

    def __repr__(self) -> str:
        how = f", {self.arrival.status}" if self.arrival else ""
        return f"{super().__repr__()[:-1]}{how}>"

    @property
    def status(self) -> str:
        """One of `foilstudy.base.outcome.STATUSES`; ``converged`` for a shape from elsewhere."""
        return self.arrival.status if self.arrival else "converged"

    @property
    def message(self) -> str:
        """One sentence on the status; on the faults of a shape from elsewhere, if it has any."""
        if self.arrival:
            return self.arrival.message
        faults = self.faults
        return str(faults) if faults and (faults.folded_share or faults.crossing_share) else ""

    @property
    def method(self) -> Method:
        """That of the recipe, the default one for a shape from elsewhere."""
        return self.recipe.method if self.recipe else Method()

    def relieved(self, removal: StressRemoval | None = None) -> Relieved:
        """The shell that the recipe calls stress-free in this shape."""
        return super().relieved(removal or self.method.stress_removal)

    @property
    def beyond_elastic(self) -> bool:
        """Whether the foil is more than an elastic shell, and so in a state of its own."""
        return len(self.problem().terms) > 1

    @property
    def stress_kept(self) -> float:
        """Share of its stress that waiting has left."""
        return self.rest.stress_kept if self.rest else 1.0

    def contacts(self) -> tuple[Touching, ...]:
        """The terms of contact, fresh; none where parts pass through each other."""
        terms = self.method.contact.terms(self.stressed.section)
        return tuple(term for term in terms if isinstance(term, Touching))

    def terms(self) -> tuple[Term, ...]:
        """See `Shape`; contact comes last, and then its friction."""
        return *super().terms(), *self.method.contact.terms(self.stressed.section)

    def problem(self) -> Problem:
        """The potential energy of the foil, at the state in which it has arrived."""
        problem = super().problem()
        for term in problem.terms:
            if isinstance(term, Springs):
                term.stand_at(self.points)
        if self.arrival and self.arrival.state:
            # what has let go since has no memory, and comes last
            known = self.arrival.state[: len(problem.terms)]
            problem.state = *known, *problem.state[len(known) :]
        return self._rested(problem) if self.rest else problem

    def _remembered(self) -> Problem:
        """Without contact, which a finer mesh may not carry."""
        problem = Problem(self.stressed, *super().terms())
        if self.arrival and self.arrival.state:
            problem.state = self.arrival.state[: len(problem.terms)]
        return problem

    def _rested(self, before: Problem) -> Problem:
        """The foil of before with all its moduli scaled down, and what has let go beside it."""
        left = replace(self, foil=self.rest.weakened(self.foil), arrival=None, rest=None)
        of_foil = Shape.terms(left)
        # contacts are no stress of the foil, and stay what they were
        contacts = before.terms[1 + len(of_foil) :]
        problem = self.rest.problem(self, left.stressed, (*of_foil, *contacts))
        problem.restore(before.recorded())
        return problem

    def before_waiting(self) -> Self:
        """The shape in which it has waited, with all its stress, as its way has left it.

        What contacts rubbed and the foil yielded when they gave way is not taken back.
        """
        return replace(self, rest=None, points=self.rest.points) if self.rest else self

    def waited(self, seconds: float) -> Self:
        """The same foil after it has stood in its shape; it keeps less of its stress.

        Where its parts touch it is settled then, as contacts keep what stiffness they have.

        Parameters
        ----------
        seconds : float
            Since it came to rest, s; its material says how much that takes.

        Raises
        ------
        Refusal
            If the foil is heavy: nothing would hold it up.
        """
        if self.rest:
            return self.before_waiting().waited(seconds)
        if seconds:
            refuse_rest(self.foil)
        rested = self._with_rest(seconds, self.points)
        if rested.rest and any(each.closed_at(self.points) for each in self.contacts()):
            return rested._given_way()
        return rested

    def _with_rest(self, seconds: float, points: np.ndarray) -> Self:
        """What is left of its stress after it has stood in a shape, which it is still in."""
        kept = max(STRESS_KEPT_MIN, self.foil.material.stress_kept(seconds))
        return replace(self, rest=Rest(kept, points)) if kept < 1 else self

    def _given_way(self) -> Self:
        """Settled where its contacts, which have kept their strength, press it now."""
        arrival = self.method.path.settle(self.problem(), self.points)
        if self.arrival:
            arrival = arrival.after(self.arrival)
        return replace(self, points=arrival.points, arrival=arrival)

    def refined(self) -> Self:
        """The same shape with every element split in four, at the same state.

        Raises
        ------
        Refusal
            If a term of the problem has a memory that cannot be split.
        """
        refined = super().refined()
        if self.rest:
            refined = replace(refined, rest=self.rest.refined())
        if not (self.arrival and self.arrival.state):
            return refined
        # what contacts remember is of knots that are others now: they begin anew
        refined = replace(refined, arrival=replace(self.arrival, state=()))
        fresh = replace(refined, arrival=None)._remembered()
        return refined._remembering(fresh, self._remembered().split())

    def _remembering(self, problem: Problem, values: Mapping[str, np.ndarray]) -> Self:
        """At the state that arrays tell of, where a term of a fresh problem has a memory."""
        if not problem.has_memory:
            return self
        problem.restore(values)
        return replace(self, arrival=replace(self.arrival, state=problem.state))

    def settled(self, method: Method | None = None) -> Self:
        """The nearest stable equilibrium, for a shape that was refined or came from elsewhere.

        Raises
        ------
        Refusal
            If it was refined and its contacts rubbed.
        """
        path = (method or self.method).path
        if self._has_lost_friction():
            raise Refusal(
                "what contacts that rub held on the mesh of the crumple is not known on a finer "
                "one; crumple the foil on the mesh that is wanted, or without friction."
            )
        arrival = path.settle(self.problem(), self.points)
        return replace(self, points=arrival.points, arrival=arrival)

    def _has_lost_friction(self) -> bool:
        rubs = bool(self.recipe) and getattr(self.method.contact, "friction", 0.0) > 0
        return rubs and self.patch != self.recipe.mesh.of_ramp().patch(self.foil)

    def stiffness(self) -> np.ndarray:
        """Axial and radial stiffness, stress-free, other motions held, shape (2,), N/m.

        Raises
        ------
        SolveError
            If it is singular.
        """
        return stress_free_stiffness(self)

    def mesh_limit(self, refinements: int = 2, coarsest: np.ndarray | None = None) -> MeshLimit:
        """That stiffness at element size zero, see `foilstudy.pipeline.static.mesh_limit_of`."""
        return mesh_limit_of(self, refinements, coarsest)

    def mesh_limit_within(
        self, error: float, most: int = 2, coarsest: np.ndarray | None = None
    ) -> MeshLimit:
        """The same with a stated error, see `foilstudy.pipeline.static.mesh_limit_within`."""
        return mesh_limit_within(self, error, most, coarsest)

    def prestressed_stiffness(self) -> np.ndarray:
        """Axial and radial stiffness with the stress left in, other motions held, shape (2,), N/m.

        That of small motions about the state in which the foil has arrived; of a plastic foil it
        is the stiffness of unloading, with its true stresses.

        Raises
        ------
        SolveError
            If the tangent with held rings is singular.
        """
        return prestressed_stiffness(self.problem(), self.points)

    def contact_bracket(self) -> ContactBracket:
        """Stress-free stiffness between what closed contacts may do, see `ContactBracket`.

        Raises
        ------
        SolveError
            If a stiffness is singular.
        """
        return contact_bracket(self.relieved(), self.contacts(), self.points)

    def verdicts(self) -> tuple[Verdict, ...]:
        """What the numbers of the crumple say of it, see `foilstudy.measure.verdicts`."""
        return verdicts(evidence_of(self, self.arrival))

    def vibration(
        self,
        options: DynamicsOptions | None = None,
        air: Air | None = None,
        contacts: str = "ignored",
    ) -> Vibration:
        """Dynamic stiffness, eigenfrequencies and mode shapes of the stress-free shape.

        Parameters
        ----------
        options : DynamicsOptions, optional
        air : Air, optional
            What surrounds it; nothing if left out.
        contacts : str
            What closed contacts do, a name of `ContactBracket`.

        Raises
        ------
        SolveError
            If a factorisation, the reduction or a mode search fails.
        """
        springs = contact_springs(contacts, self.contacts(), self.points)
        structure = in_air(self, stress_free_structure(self, springs), air or Vacuum())
        return vibration_of(structure, options or DynamicsOptions())

    def plot(self, ax=None):
        """Shaded picture, coloured by radial displacement.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Of a new figure if left out.

        Returns
        -------
        matplotlib.axes.Axes
        """
        from foilstudy.plot.single import draw_shape

        return draw_shape(self.points, self.foil.diameter / 2, str(self.foil), ax)

    @classmethod
    def recorded(cls, path: str | Path) -> Self:
        """Read a crumple back from its record, a ``crumple.nc``.

        Raises
        ------
        Refusal
            If the file is no such record, or its realisation has left no shape.
        """
        values, attributes = read_record(Path(path))
        if not {"foil", "mesh", "imperfection", "method"} <= attributes.keys():
            raise Refusal(f"{path}: is not the record of a crumple; give a crumple.nc.")
        if attributes.get("status") not in USABLE:
            raise Refusal(
                f"{path}: the realisation has left no shape ({attributes.get('status')}: "
                f"{attributes.get('message')})."
            )
        try:
            return cls.of_record(values, attributes)
        except Refusal as problem:
            raise Refusal(f"{path}: {problem}") from None

    @classmethod
    def of_record(cls, values: dict[str, np.ndarray], attributes: dict[str, str]) -> Self:
        """From the values and attributes of a record that holds a shape.

        Raises
        ------
        Refusal
            If the record does not say what it is of, as in releases before 0.3.
        """
        if missing := {"foil", *_RECIPE} - attributes.keys():
            raise Refusal(
                f"the record of the crumple does not say its {', '.join(sorted(missing))}; it is "
                "from an earlier release: run the study again."
            )
        foil = loaded(Foil, attributes["foil"])
        recipe = Recipe(*(loaded(kind, attributes[name]) for name, kind in _RECIPE.items()))
        points, reference = values["control_points"], values["reference_control_points"]
        _, rows, columns = points.shape
        along = rows - 2
        sizes = np.pi * foil.diameter / columns, foil.reference_height / along
        patch = Patch(columns, along, *sizes)
        arrival = Arrival(
            attributes["status"], attributes["message"], points,
            float(values["equilibrium_residual"]), _count(values["negative_eigenvalues"]),
            int(values["steps"]), int(values["newton_steps"]), int(values["hessians"]), None,
            shortened_steps=int(values.get("contact_shortened_steps", 0)),
        )  # fmt: skip
        element = recipe.mesh.element_at_work()
        crumpled = cls(foil, patch, points, reference, element, recipe, arrival)
        fresh = replace(crumpled, arrival=None).problem()
        waited = values.get("waiting_control_points", points)
        return crumpled._remembering(fresh, values)._with_rest(recipe.method.waiting, waited)


_RECIPE = {"mesh": Mesh, "imperfection": Imperfection, "method": Method}


def described(foil: Foil, recipe: Recipe) -> dict[str, str]:
    """What the record of a crumple says of itself; `Crumpled.recorded` needs nothing else."""
    return {"foil": dumped(foil)} | {name: dumped(getattr(recipe, name)) for name in _RECIPE}


def _count(number: float) -> int | None:
    return None if np.isnan(number) else int(number)
