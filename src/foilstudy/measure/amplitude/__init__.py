"""How far a stiffness holds: force over motion, normal forms of modes, harmonic balance.

Numbers only: what solves for equilibria of a foil is in `foilstudy.pipeline.amplitude`.
"""
