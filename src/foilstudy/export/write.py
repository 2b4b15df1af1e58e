"""Write a realisation in one of the formats."""

from __future__ import annotations

from pathlib import Path

from foilstudy.base.files import written_whole
from foilstudy.export.contents import Contents
from foilstudy.export.formats import FORMATS, check_format


def write(contents: Contents, name: str, path: Path) -> None:
    """Write one format; the file appears only when it is complete.

    Raises
    ------
    ValueError
        If the format is unknown, or cannot hold this model.
    """
    check_format(name)
    with written_whole(path) as partial:
        # writers that look at the ending of a name find the one they expect
        named = partial.with_suffix(partial.suffix + Path(FORMATS[name].filename).suffix)
        try:
            FORMATS[name].writer()(contents, named)
            named.replace(partial)
        finally:
            named.unlink(missing_ok=True)
