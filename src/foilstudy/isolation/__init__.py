"""What foil links do to a payload on mounts: transmissibility and the limits of link stiffness."""

from foilstudy.isolation.limits import kept_up_to, stiffness_share
from foilstudy.isolation.mounts import IdealMount, Mount, ResonantMount, Spring
from foilstudy.isolation.parallel import FLOOR, PAYLOAD, foil_link, in_parallel, two_ended
from foilstudy.isolation.scene import MOUNTS, mounts, static_spring
from foilstudy.isolation.transmissibility import decibels, transmissibility

__all__ = [
    "FLOOR",
    "MOUNTS",
    "PAYLOAD",
    "IdealMount",
    "Mount",
    "ResonantMount",
    "Spring",
    "decibels",
    "foil_link",
    "in_parallel",
    "kept_up_to",
    "mounts",
    "static_spring",
    "stiffness_share",
    "transmissibility",
    "two_ended",
]
