"""Element variants held against each other: error against cost.

``snakemake elements`` runs it; the variants are data (`variants`), every measurement takes one of
them and returns plain numbers (`bending`, `frozen`, `buckled`, `crumpling`, `cost`), and `chart`
draws them all. docs/elements.md has the decision.
"""

VARIANT_NAMES = (
    "one_point_0p01", "one_point_0p05", "one_point_0p2", "one_point_1", "gauss_2", "gauss_3",
    "patch_wise", "cas_0", "cas_1", "staggered_0", "staggered_third", "staggered_1", "corner_0",
    "corner_half", "corner_1", "corner_1_bend_4",
)  # fmt: skip
"""Keys of `variants.VARIANTS`: a workflow can list them without importing what computes them."""
