"""The shell held against theory and publications: ``snakemake verify``.

Each benchmark is a function of the element under test that returns a `records.Benchmark`;
`plan.BENCHMARKS` names them all.
"""
