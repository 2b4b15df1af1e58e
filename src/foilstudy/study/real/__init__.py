"""What separates simulation from measurement: ``snakemake real``.

The published foil, crumpled by models that come nearer and nearer to the real one, as data:
``config/real.yaml``. `trial` runs the jobs of a study for one foil and one model; `laws` fits the
laws of the stiffness of every model, which stand beside the measured ones. docs/real-foil.md says
what came out.
"""
