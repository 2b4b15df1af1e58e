"""What parts of a foil do that come near each other: one file each, all of the protocol `Contact`.

With a barrier they repel each other, without bound towards the distance of one thickness, so that
they touch as sheets of that thickness do and never pass through each other. The barrier is that of
incremental potential contact (Li et al., ACM Transactions on Graphics 39 (4), 2020).
"""

from __future__ import annotations

from typing import Any, Protocol

from foilstudy.base.registry import Choice, Registry

__all__ = ["CONTACTS", "Contact"]


class Contact(Protocol):
    """A frozen specification, which is recorded with every crumple."""

    kind: str

    def terms(self, section: Any) -> tuple[Any, ...]:
        """What a problem has to add to the shell of a `Section` (`solve.problem.Term`)."""
        ...


CONTACTS = Registry(
    "contact",
    {
        "none": Choice(
            "model.contact.none:NoContact",
            "parts of the foil pass through each other, as published",
        ),
        "barrier": Choice(
            "model.contact.options:BarrierContact",
            "parts that come near repel each other and never cross; several times as slow where "
            "many touch",
        ),
    },
)
