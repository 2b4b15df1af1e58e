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
            caution="elements lock, half as much energy again and more; use corner",
        ),
    },
)
"""Elements by the name a configuration gives them; those to be used have a vectorised kernel."""
LESSER_MODELS = Registry(
    "lesser model",
    {
        "tension_field": Choice(
            "model.shell.elements.tension_field:TensionField",
            "a membrane that wrinkles at no cost and does not bend: has neither ridges nor, where "
            "it is slack, a stiffness",
        ),
        "mass_spring": Choice(
            "model.shell.elements.mass_spring:MassSpring",
            "springs and hinges on triangles, whose Poisson's ratio is 1/3 in plane and -1/3 in "
            "bending",
        ),
    },
)
"""In place of an element: models that leave something out, to see what that does to a crumple."""

__all__ = ["ELEMENTS", "LESSER_MODELS"]
