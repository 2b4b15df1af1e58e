"""No contact: parts of a foil pass through each other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class NoContact:
    """As in the published model; costs nothing."""

    kind = "none"

    def terms(self, section: Any) -> tuple[()]:
        """See `Contact`: none."""
        return ()
