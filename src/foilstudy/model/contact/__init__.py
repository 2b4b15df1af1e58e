"""Self-contact of a sheet: a barrier between parts of its surface that come near each other.

Off where nothing is near; without bound towards the distance of one thickness, so that parts touch
as sheets of that thickness do and never pass through each other. The barrier is that of incremental
potential contact (Li et al., ACM Transactions on Graphics 39 (4), 2020).
"""

from foilstudy.model.contact.options import Contact
from foilstudy.model.contact.term import SelfContact

__all__ = ["Contact", "SelfContact"]
