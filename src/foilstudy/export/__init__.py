"""A realisation in the formats of other tools: one file per format behind one registry."""

from foilstudy.export.contents import Contents
from foilstudy.export.registry import FORMATS, Format, check_format, write

__all__ = [
    "FORMATS",
    "Contents",
    "Format",
    "check_format",
    "write",
]
