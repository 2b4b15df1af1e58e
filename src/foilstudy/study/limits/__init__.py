"""Where methods fail: every method on every foil, judged by its numbers: ``snakemake limits``.

The methods are data, ``config/limits.yaml``. `trial` crumples one foil by one of them and records
what its verdicts rest on; `map` holds all against the default; `gallery` shows an example of every
kind of failure. ``snakemake limits_quick`` is a corner of the map that takes minutes.
docs/limits.md says what came out.
"""
