"""The element size that an error of the crumple's strain energy asks for.

A ridge of a crumpled sheet is as wide as sqrt(R t) to within a power of its length, so that the
error of the strain energy is expected to be a function of h / sqrt(R t) alone, whatever the foil.
The function is that of 500 um foil with h / sqrt(R t) from 0.18 to 1 (docs/convergence.md). At 50
um the energies at 2.5 and 1.25 mm (1.1 and 0.56) agree within their scatter, which the function
neither contradicts nor confirms.
"""

from __future__ import annotations

import math

ERROR_ORDER = 2.0
"""Of energies, by theory and in the benchmarks (docs/verification.md). Fitted to the crumples
together with the limit it is 2.6 +- 0.7: they do not contradict it."""
ERROR_COEFFICIENT = 0.48
"""Relative error of the strain energy by the default element over (h / sqrt(R t))^order: weighted
least squares over the means of two or three seeds at 7, 5, 4, 2.5 and 1.25 mm, standard error
0.07."""
STIFFNESS_ERROR_COEFFICIENT = 0.38
"""Relative error of the stiffness of a given folded shape, at most, over (h / sqrt(R t))^2, as
measured (docs/method.md, section 6)."""
UNREFINED_ERROR_COEFFICIENT = 0.6
"""The same on the mesh of the crumple itself, whose folds have adapted to it: 0.58 of 48 values."""
SLENDERNESS_MAX = 1.0
"""Largest h / sqrt(R t) of that fit."""


def expected_energy_error(size: float, radius: float, thickness: float) -> float:
    """Relative error of the strain energy of a crumple, lengths in m."""
    return energy_error_at(size / math.sqrt(radius * thickness))


def energy_error_at(slenderness):
    """The same of the element size over sqrt(R t); a number or an array."""
    return ERROR_COEFFICIENT * slenderness**ERROR_ORDER


def stiffness_error_at(slenderness: float, halvings: int) -> float:
    """Relative error of the stiffness of a given shape whose elements have been halved.

    Parameters
    ----------
    slenderness : float
        Size of the elements it was crumpled on over sqrt(R t).
    halvings : int
    """
    refined = STIFFNESS_ERROR_COEFFICIENT if halvings else UNREFINED_ERROR_COEFFICIENT
    return refined * (slenderness / 2**halvings) ** ERROR_ORDER


def element_size_for(error: float, radius: float, thickness: float) -> float:
    """Largest element size whose expected error is at most `error` (relative); lengths in m.

    Rounded down to three digits, and within the range of the fit.
    """
    slenderness = min((error / ERROR_COEFFICIENT) ** (1 / ERROR_ORDER), SLENDERNESS_MAX)
    size = math.sqrt(radius * thickness) * slenderness
    step = 10.0 ** (math.floor(math.log10(size)) - 2)
    return math.floor(size / step * (1 + 1e-12)) * step
