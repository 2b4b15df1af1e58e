"""How far the true stiffness depends on the method: ``snakemake truth``.

One plastic foil by many ramps, dampings, imperfections and meshes, as data: ``config/truth.yaml``,
in the words of `foilstudy.study.real`, whose trials these are. `influences` holds each against what
it stands beside. docs/real-foil.md says what came out.
"""
