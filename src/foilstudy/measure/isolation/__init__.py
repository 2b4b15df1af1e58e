"""What foil links do to a payload on mounts: transmissibility and the limits of link stiffness."""

from foilstudy.measure.isolation.limits import kept_up_to, stiffness_share
from foilstudy.measure.isolation.mounts import IdealMount, Mount, ResonantMount, Spring
from foilstudy.measure.isolation.parallel import FLOOR, PAYLOAD, foil_link, in_parallel, two_ended
from foilstudy.measure.isolation.transmissibility import decibels, transmissibility

__all__ = [
    "FLOOR",
    "PAYLOAD",
    "IdealMount",
    "Mount",
    "ResonantMount",
    "Spring",
    "decibels",
    "foil_link",
    "in_parallel",
    "kept_up_to",
    "stiffness_share",
    "transmissibility",
    "two_ended",
]
