"""The configuration of a run, checked before Snakemake's own reader sees it.

That reader ends some files in a traceback, takes aliases apart without end, and runs code that a
file of its template language holds. A logger is the first part of a project that Snakemake starts:
before the files are read, and after the command line is.
"""

from __future__ import annotations

import io
import sys
from contextlib import redirect_stderr
from pathlib import Path

from foilstudy.config import ConfigError, load_merged
from foilstudy.config.sources import read_word

__all__ = ["refuse_unreadable_config"]


def refuse_unreadable_config() -> None:
    """End the run if the files and words of its command line are no configuration.

    Without files, the words go over the default file, which the Snakefile knows and reads.

    Raises
    ------
    SystemExit
        With one sentence for each problem.
    """
    if "snakemake" not in Path(sys.argv[0]).parts[-2:]:  # also python -m snakemake
        return
    from snakemake.cli import parse_args

    with redirect_stderr(io.StringIO()):  # it says which profile it uses, for the second time
        _, args = parse_args(sys.argv[1:])
    words = args.config or ()
    try:
        if args.configfile:
            load_merged(args.configfile, words)
        for word in words:
            read_word(word)
    except ConfigError as problem:
        sys.exit(str(problem))
