"""Write the reference page and the JSON schema: ``python -m foilstudy.config [FOLDER]``."""

from __future__ import annotations

import argparse
from pathlib import Path

from .docs import reference_page, schema_text


def main() -> None:
    """Write ``README.md`` and ``schema.json`` of the configuration into a folder."""
    parser = argparse.ArgumentParser(prog="python -m foilstudy.config", description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=Path("config"))
    folder = parser.parse_args().folder
    for name, text in {"README.md": reference_page(), "schema.json": schema_text()}.items():
        (folder / name).write_text(text, encoding="utf-8")
        print(f"wrote {folder / name}")


if __name__ == "__main__":
    main()
