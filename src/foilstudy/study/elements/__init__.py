"""Element variants held against each other, error against cost: ``snakemake elements``.

The variants are data (`variants`), every measurement takes one of them and returns plain numbers
(`bending`, `frozen`, `buckled`, `crumpling`, `cost`), and `chart` draws them all. docs/elements.md
has the decision.
"""
