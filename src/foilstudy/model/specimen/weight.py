"""The weight of the foil."""

from __future__ import annotations

import numpy as np

from foilstudy.model.shell.section import Section
from foilstudy.model.shell.tangent import mass_matrix
from foilstudy.model.supports.loads import DeadLoad


def weight_of(section: Section, gravity: float) -> DeadLoad:
    """Of a section, along the axis towards the bottom ring; follows its thickness.

    Parameters
    ----------
    section : Section
    gravity : float
        m/s2.
    """
    patch = section.patch
    masses = np.asarray(mass_matrix(patch, section.masses).sum(axis=1))
    force = np.zeros(patch.shape)
    force[2] = -gravity * masses.reshape(patch.rows, patch.columns, 3)[..., 2]
    return DeadLoad(section.reference, force)
