"""What the words of `accuracy` cost, and how far off they are: ``snakemake accuracy``.

The same foil by every word, and by ten times the ramp of the fastest, as data:
``config/accuracy.yaml``, in the words of `foilstudy.study.real`, whose trials these are.
docs/tradeoff.md says what came out.
"""
