"""What is chosen about a barrier."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from foilstudy.base.ranges import require_number
from foilstudy.model.contact.friction import Friction
from foilstudy.model.contact.planes import RingPlanes
from foilstudy.model.contact.sizes import FRICTION_MAX
from foilstudy.model.contact.springs import STIFFNESS, Springs
from foilstudy.model.contact.term import SelfContact
from foilstudy.model.shell.section import Section


@dataclass(frozen=True)
class BarrierContact:
    """A barrier between parts of a sheet that come nearer than thickness and reach.

    Attributes
    ----------
    reach : float, optional
        Gap between the faces of two sheets at which the barrier begins, m; left out, 1 mm, and a
        quarter of an element at most.
    stiffness : float
        Energy of the barrier relative to membrane stiffness E t/(1 - nu^2) times reach squared. A
        softer one is entered more deeply, where it is stiffer.
    ring_planes : bool
        Whether the planes of the rings are barriers, too.
    friction : float
        Coefficient of Coulomb's friction of all of them.
    """

    kind = "barrier"
    reach: float | None = None
    stiffness: float = STIFFNESS
    ring_planes: bool = False
    friction: float = 0.0

    def __post_init__(self):
        if self.reach is not None:
            require_number("reach of a contact", self.reach, "m", above=0)
        require_number("stiffness of a contact", self.stiffness, "", above=0)
        require_number("friction of a contact", self.friction, "", least=0, most=FRICTION_MAX)

    def terms(self, section: Section) -> tuple[Any, ...]:
        """See `Contact`.

        Raises
        ------
        Refusal
            If thickness and reach are too large for the elements.
        """
        pressing: tuple[Springs, ...] = (SelfContact(section, self.reach, self.stiffness),)
        if self.ring_planes:
            pressing += (RingPlanes(section, self.reach, self.stiffness),)
        if not self.friction:
            return pressing
        return *pressing, *(Friction(each, self.friction) for each in pressing)
