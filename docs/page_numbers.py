"""Write the numbers of the studies into the pages: docs/page_numbers.py [--check].

    .venv/bin/python docs/page_numbers.py           the pages, of the studies below results/
    .venv/bin/python docs/page_numbers.py --check   only say whether they are as they should be

What stands between ``<!-- numbers: NAME of STUDY, STUDY -->`` and ``<!-- end -->`` is what the
function NAME of docs/page_blocks makes of cube and tables of these studies, folders of results/; a
block that names no study is of the one that it is called as. Everything else is left alone.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

from page_blocks import BLOCKS, Study

from foilstudy.base.errors import Refusal

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "results"
PAGES = (
    "README.md",
    "docs/comparison.md",
    "docs/method.md",
    "docs/real-foil.md",
    "docs/speed.md",
    "docs/specimen.md",
    "docs/tradeoff.md",
)
BLOCK = re.compile(
    r"(?P<head><!-- numbers: (?P<name>\w+)(?: of (?P<studies>[\w, -]+?))? -->\n)"
    r"(?P<text>.*?)(?P<end><!-- end -->)",
    re.DOTALL,
)


def block(name: str, *studies: Study) -> str:
    """The text of a block, ending with a line break."""
    return "\n".join(BLOCKS[name](*studies)) + "\n"


def written(text: str, results: Path) -> str:
    """A page with its blocks made anew of the studies below a folder."""
    studies: dict[str, Study] = {}

    def remade(found: re.Match[str]) -> str:
        names = (found["studies"] or found["name"]).split(",")
        named = [studies.setdefault(n, Study(results / n)) for n in map(str.strip, names)]
        return found["head"] + block(found["name"], *named) + found["end"]

    return BLOCK.sub(remade, text)


def main() -> None:
    """Write the pages, or say which differ, and what is missing for which."""
    only_check, differ, missing = "--check" in sys.argv[1:], [], []
    for name in PAGES:
        path = ROOT / name
        before = path.read_text("utf-8")
        try:
            after = written(before, RESULTS)
        except Refusal as refusal:
            missing.append(f"{name} is left as it is: {refusal}")
            continue
        if before != after:
            differ.append(name)
            if not only_check:
                path.write_text(after, "utf-8")
    if differ:
        print(f"{'differs' if only_check else 'wrote'}: {', '.join(differ)}")
    for sentence in missing:
        print(sentence, file=sys.stderr)
    sys.exit(bool(missing or (differ and only_check)))


if __name__ == "__main__":
    main()
