"""Strain and quadrature variants of the shell element: one protocol, one file per family."""

from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.elements.protocol import Element, ElementKernel
from foilstudy.model.shell.elements.sampled import Sampled
from foilstudy.model.shell.elements.sampling import staggered

ELEMENTS: dict[str, Element] = {"corner": Corner(), "one_point": OnePoint()}
"""Elements with a vectorised kernel, by the name a configuration gives them."""

STAGGERED: Element = Sampled(staggered())
"""A second discretisation for the error of a given shape's stiffness; no vectorised kernel."""

DEFAULT_ELEMENT = ELEMENTS["corner"]

__all__ = [
    "DEFAULT_ELEMENT",
    "ELEMENTS",
    "STAGGERED",
    "Corner",
    "Element",
    "ElementKernel",
    "OnePoint",
    "Sampled",
]
