"""The air about a foil: what it adds to mass and stiffness (docs/air.md).

Frictionless and, but for the mean pressure of a sealed volume, incompressible: right where the
waves of the foil are much shorter than those of sound.
"""
