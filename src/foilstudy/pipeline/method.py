"""How a foil is crumpled: the mesh and the method, as data that is recorded with the result."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Self

from foilstudy.base.ranges import require_number
from foilstudy.base.spec import choice_field
from foilstudy.measure.choices import STRESS_REMOVALS
from foilstudy.measure.stiffness.stress_removal import Reset, StressRemoval
from foilstudy.model.contact import CONTACTS, Contact
from foilstudy.model.contact.none import NoContact
from foilstudy.model.foil import Foil
from foilstudy.model.mesh_size import element_size_for
from foilstudy.model.patch import Patch
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.elements.protocol import Element
from foilstudy.solve.choices import PATHS
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.pace import SLOWNESS, ramp_steps, rest_steps
from foilstudy.solve.paths import Path
from foilstudy.solve.paths.relaxation import RelaxationPath

__all__ = ["Mesh", "Method"]


@dataclass(frozen=True)
class Mesh:
    """Discretisation of a foil.

    Attributes
    ----------
    element_size : float
        Edge length of the elements, m; the patch takes the nearest that fits.
    element : str
        A name of `foilstudy.model.shell.elements.ELEMENTS`.
    ramp_coarsenings : int
        How often the elements are doubled for the ramp, after which the crumple is refined and
        relaxed on this mesh.
    """

    element_size: float
    element: str = "corner"
    ramp_coarsenings: int = field(default=0, repr=False)

    def __post_init__(self):
        require_number("element size of a mesh", self.element_size, "m", above=0)
        ELEMENTS.choice(self.element)

    @classmethod
    def resolving(cls, foil: Foil, energy_error: float = 0.1) -> Self:
        """The coarsest mesh that keeps an expected relative error of the crumple's strain energy.

        See `foilstudy.model.mesh_size`.
        """
        return cls(element_size_for(energy_error, foil.diameter / 2, foil.thickness))

    def patch(self, foil: Foil) -> Patch:
        """The patch of a foil."""
        halvings = self.ramp_coarsenings
        return Patch.for_cylinder(foil.diameter, foil.reference_height, self.element_size, halvings)

    def of_ramp(self) -> Self:
        """The mesh on which a foil is pushed together."""
        larger = self.element_size * 2**self.ramp_coarsenings
        return replace(self, element_size=larger, ramp_coarsenings=0)

    def element_at_work(self) -> Element:
        """The element of that name, with its default parameters."""
        return ELEMENTS[self.element]()


@dataclass(frozen=True)
class Method:
    """What decides a crumple beside foil, mesh and imperfection.

    Attributes
    ----------
    path : Path
        From the cylinder to the equilibrium, with all its numbers.
    stress_removal : StressRemoval
        What makes the crumple stress-free before it is measured.
    contact : Contact
        What parts of the foil do that come near each other.
    waiting : float
        How long the foil then stands before it is measured, s.
    """

    path: Path = choice_field(PATHS, RelaxationPath)
    stress_removal: StressRemoval = choice_field(STRESS_REMOVALS, Reset)
    contact: Contact = choice_field(CONTACTS, NoContact)
    waiting: float = 0.0

    def __post_init__(self):
        require_number("waiting time of a method", self.waiting, "s", least=0)

    @classmethod
    def following(cls, foil: Foil, slowness: float = SLOWNESS) -> Self:
        """The standard one, with a ramp that the foil can follow: thin foil moves slowly.

        Left out, `slowness` is that of a study of standard accuracy; see `foilstudy.solve.pace`.
        """
        slenderness = foil.diameter / 2 / foil.thickness
        steps = ramp_steps(slenderness, slowness)
        settling = SettleOptions(relaxation_steps_max=rest_steps(steps, slenderness))
        return cls(RelaxationPath(steps, settling=settling))

    def __repr__(self) -> str:
        kinds = f"{self.path.kind}, stress {self.stress_removal.kind}"
        return f"<Method: {kinds}{f', contact {self.contact.kind}' if self.touches else ''}>"

    @property
    def touches(self) -> bool:
        """Whether parts of the foil may touch."""
        return not isinstance(self.contact, NoContact)
