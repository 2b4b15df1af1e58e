"""Speed against accuracy, one setting at a time changed from the default: ``snakemake tradeoff``.

The settings are data, ``config/tradeoff.yaml``. Three ladders of truth hold them: a panel that
buckles without chance (`panel`), shapes of crumples that are refined exactly (`frozen`), and
ensembles of crumples (`ensembles`). `points` makes errors and ratios of the records, `knees` says
whether the defaults stand where they should; docs/tradeoff.md has what they say. `adaptive` asks
beside all that what a mesh of several element sizes would save.
"""
