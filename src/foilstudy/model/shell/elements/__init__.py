"""Strain and quadrature variants of the shell element: one protocol, one file per family."""

from foilstudy.base.registry import Choice, Registry

ELEMENTS = Registry(
    "element",
    {
        "corner": Choice(
            "model.shell.elements.corner:Corner",
            "strains where folds do not stretch the element",
        ),
        "one_point": Choice(
            "model.shell.elements.one_point:OnePoint",
            "strains in its middle, much too stiff at unresolved ridges, as in the published work",
        ),
        "uncontrolled": Choice(
            "model.shell.elements.uncontrolled:Uncontrolled",
            "one strain point and nothing else, which hourglasses; to see how it fails",
            caution="elements hourglass; use corner",
        ),
        "full": Choice(
            "model.shell.elements.full:Full",
            "full integration, which locks, and slow; to see how it fails",
            caution="elements lock, up to 36 times too much energy in thin foil; use corner",
        ),
    },
)
"""Elements by the name a configuration gives them; those to be used have a vectorised kernel."""

__all__ = ["ELEMENTS"]
