"""Bring a page's table up to date: python -m foilstudy.study.verification PAGE_MD TABLE_MD.

The page keeps everything but what stands between its two marks.
"""

import sys
from pathlib import Path

from foilstudy.base.files import written_whole

START, END = "<!-- table of the last run -->\n", "<!-- end of the table -->\n"

page, table = (Path(path).read_text(encoding="utf-8") for path in sys.argv[1:])
before, rest = page.split(START)
_, after = rest.split(END)
with written_whole(sys.argv[1]) as partial:
    partial.write_text(f"{before}{START}{table}{END}{after}", encoding="utf-8")
