"""What a configuration switches on, and with it the quantities that there are then only."""

from __future__ import annotations

from collections.abc import Callable

from foilstudy.config import StudyConfig
from foilstudy.measure.choices import CLOSED_CONTACTS

SWITCHES: dict[str, Callable[[StudyConfig], bool]] = {
    "yielding": lambda study: study.yields,
    "beyond_elastic": lambda study: study.beyond_elastic,
    "in_air": lambda study: study.air.kind != "none",
    "drawing": lambda study: bool(study.specimen.draws),
    "lets_go": lambda study: study.lets_go,
    "swept": lambda study: bool(study.amplitude.directions),
    "one_sided": lambda study: bool(study.stiffness.one_sided),
    "touching": lambda study: study.contact.kind != "none",
    "rubbing": lambda study: study.contact.friction > 0,
    "slipping": lambda study: study.specimen.clamp_slip_mm > 0,
    "retrying": lambda study: study.method.retries > 0,
    **{
        f"contacts_{kind}": lambda study, kind=kind: kind in study.dynamics.contacts
        for kind in CLOSED_CONTACTS
    },
}
"""Whether a study has the quantities whose `Declared.only` is such a name."""
