"""Write a realisation in one of the formats."""

from __future__ import annotations

from pathlib import Path

from foilstudy.base.files import written_whole
from foilstudy.export.contents import Contents
from foilstudy.export.formats import FORMATS


def write(contents: Contents, name: str, path: Path) -> None:
    """Write one format; the file appears only when it is complete.

    Raises
    ------
    Refusal
        If the format is unknown, or cannot hold this model.
    """
    suffix = Path(FORMATS.choice(name).filename).suffix
    with written_whole(path) as partial:
        # writers that look at the ending of a name find the one they expect
        named = partial.with_suffix(partial.suffix + suffix)
        try:
            FORMATS[name](contents, named)
            named.replace(partial)
        finally:
            named.unlink(missing_ok=True)
