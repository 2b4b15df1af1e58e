"""The Python of the pages: found, run as a reader would, and what it prints written back.

After a change of numbers ``python tests/pages.py README.md docs/results.md`` brings the printed
blocks of these pages up to date.
"""

from __future__ import annotations

import contextlib
import io
import re
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
_BLOCK = re.compile(
    r"^```python\n(?P<code>.*?)^```\n(?:\nprints[^\n]*\n\n```\n(?P<printed>.*?)^```$)?",
    re.DOTALL | re.MULTILINE,
)


@dataclass(frozen=True)
class Block:
    """A Python block of a page, which runs by itself.

    Attributes
    ----------
    page : Path
    line : int
        Before its first one.
    code : str
    printed : str or None
        What the page says that it prints.
    place : tuple of int
        Where that stands in the page.
    """

    page: Path
    line: int
    code: str
    printed: str | None
    place: tuple[int, int]

    def __str__(self) -> str:
        return f"{self.page.name}:{self.line + 1}"

    @property
    def is_module(self) -> bool:
        """Whether it is a file to be saved, as that of docs/studies.md."""
        return self.code.startswith('"""')

    def run(self) -> str:
        """What it prints, run in the working directory."""
        printed = io.StringIO()
        code = compile("\n" * self.line + self.code, str(self.page), "exec")
        with contextlib.redirect_stdout(printed):
            exec(code, {"__name__": "page"})
        return printed.getvalue()


def blocks(page: Path) -> list[Block]:
    """The Python blocks of a page."""
    text = page.read_text("utf-8")
    return [
        Block(
            page,
            text[: match.start("code")].count("\n"),
            match["code"],
            match["printed"],
            match.span("printed"),
        )
        for match in _BLOCK.finditer(text)
    ]


def pages() -> list[Path]:
    """README and docs."""
    return [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


def brought_up_to_date(page: Path) -> str:
    """The text of a page with what its blocks print now."""
    text = page.read_text("utf-8")
    for block in reversed(blocks(page)):
        if block.printed is not None:
            start, end = block.place
            text = text[:start] + block.run() + text[end:]
    return text


if __name__ == "__main__":
    for name in sys.argv[1:]:
        path = Path(name).resolve()
        path.write_text(brought_up_to_date(path), "utf-8")
