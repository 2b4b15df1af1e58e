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
    },
)
"""Elements with a vectorised kernel, by the name a configuration gives them."""

__all__ = ["ELEMENTS"]
