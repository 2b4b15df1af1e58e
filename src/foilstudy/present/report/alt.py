"""What a figure shows, in words for those who cannot see it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

_FORMS = {
    "stiffness_axial": "Curves on logarithmic axes, a panel for each thickness.",
    "stiffness_radial": "Curves on logarithmic axes, a panel for each thickness.",
    "morphology": "Shaded pictures of crumpled cylinders, thickness by row, overlength by column.",
    "seeds": "Shaded pictures of crumpled cylinders side by side, alike but for their folds.",
    "stiffness_map": "Coloured maps over overlength and thickness, one for each direction.",
    "fit_quality": "Dots about a straight line, and their ratio to it.",
    "prestressed": "Marks on logarithmic axes, a row a direction, a panel a thickness.",
    "variability": "Dots with error bars and a straight line with its band, one panel a direction.",
    "dynamic_stiffness": "Curves with bands against frequency, from a level line to resonances.",
    "convergence_high_frequency": "Curves against frequency that come together towards the right.",
    "eigenfrequency_law": "Lines through dots on logarithmic axes, one for each thickness.",
    "modal_density": "Curves with bands against frequency, beside dashed lines of a flat plate.",
    "mac_seeds": "Squares of grey, darker where a mode of one seed is like one of the other.",
    "design_chart": "Tables of coloured cells, overlength by column, thickness by row.",
    "transmissibility": "Curves against frequency with a peak at the suspension frequency.",
    "mesh_error": "Lines over overlength, one for each thickness.",
    "energy": "Stacked bars of membrane, bending and stabilisation energy.",
    "history": "Curves of height, ring force, energies and residual of one realisation over steps.",
}
"""What kind of picture each figure is."""

_SENTENCES_MAX = 2


def alt_text(figure_id: str, title: str, seen: Mapping[str, Sequence[str]]) -> str:
    """Say what kind of picture a figure is and what is to be seen in it.

    Parameters
    ----------
    figure_id, title : str
        Of the figure.
    seen : mapping of str to sequence of str
        What the page says of the data of a figure, by id.
    """
    sentences = [sentence for sentence in seen.get(figure_id, ()) if sentence]
    return " ".join([f"{title}.", _FORMS.get(figure_id, ""), *sentences[:_SENTENCES_MAX]]).strip()
