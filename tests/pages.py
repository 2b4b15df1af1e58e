"""The Python of the pages: found, run as a reader would, and what it prints written back.

After a change of numbers, in a clone that holds what the page reads:
``python tests/pages.py README.md`` brings the printed blocks of a page up to date.
"""

from __future__ import annotations

import contextlib
import io
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
BLOCK = re.compile(
    r"^```python\n(?P<code>.*?)^```\n"
    r"(?:\nprints[^\n]*\n\n```\n(?P<printed>.*?)^```$)?",
    re.DOTALL | re.MULTILINE,
)


@dataclass(frozen=True)
class Block:
    """A Python block of a page.

    Attributes
    ----------
    code : str
    place : str
        Page and line.
    stated : str or None
        What the page says that it prints.
    printed : str
        What it has printed.
    """

    code: str
    place: str
    stated: str | None
    printed: str


def pages() -> list[Path]:
    """Every page with Python that runs by itself; a module in the page is none."""
    found = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
    return [page for page in found if BLOCK.search(page.read_text("utf-8")) if not is_module(page)]


def is_module(page: Path) -> bool:
    """Whether the Python of a page is a file to be saved, as that of docs/studies.md."""
    return all(match["code"].startswith('"""') for match in BLOCK.finditer(page.read_text("utf-8")))


def run(page: Path) -> Iterator[Block]:
    """Run the blocks of a page in the working directory, one after another, as in one session."""
    text = page.read_text("utf-8")
    space: dict = {"__name__": "page"}
    for match in BLOCK.finditer(text):
        line = text[: match.start("code")].count("\n")
        place = f"{page.relative_to(ROOT)}:{line + 1}"
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile("\n" * line + match["code"], str(page), "exec"), space)
        yield Block(match["code"], place, match["printed"], printed.getvalue())


def brought_up_to_date(page: Path) -> str:
    """The text of a page with what its blocks print now."""
    text = page.read_text("utf-8")
    for block in run(page):
        if block.stated is not None:
            text = text.replace(block.stated, block.printed)
    return text


if __name__ == "__main__":
    for name in sys.argv[1:]:
        path = Path(name).resolve()
        path.write_text(brought_up_to_date(path), "utf-8")
