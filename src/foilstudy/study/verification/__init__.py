"""The shell held against theory and publications.

Each benchmark is a function of the element under test that returns a `records.Benchmark`;
`registry.MODULES` names them all and ``snakemake verify`` runs them.
"""
