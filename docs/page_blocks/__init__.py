"""What stands in the blocks of numbers of the pages, see docs/page_numbers.py."""

from page_blocks.aims import aims
from page_blocks.buys import buys
from page_blocks.laws import differences, dimensionless, headline, law, summary, thin, trust
from page_blocks.localisation import correlation, followed, localisation
from page_blocks.ramps import ramps
from page_blocks.realisations import (
    accuracy,
    costs,
    dynamics,
    eigenfrequency,
    explanation,
    influences,
    shapes,
    steps,
    tradeoff,
)
from page_blocks.stiffness import beside, bound, experiment, prestress, simulation, variability
from page_blocks.study import Study
from page_blocks.whole import whole

__all__ = ["BLOCKS", "Study"]

BLOCKS = {
    each.__name__: each
    for each in (
        headline, law, differences, dimensionless, summary, trust, beside, simulation, experiment,
        bound, prestress, variability, dynamics, eigenfrequency, shapes, steps, costs, tradeoff,
        explanation, influences, thin, whole, accuracy, buys, localisation, correlation, ramps,
        followed, aims,
    )
}  # fmt: skip
"""Functions of studies that yield lines, by the name of their block."""
