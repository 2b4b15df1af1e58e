"""What one job needs to know, and nothing else.

A task is stored as a parameter of its job, so a job runs again exactly when something in its task
has changed: no report title, no other cell of the sweep.
"""

from __future__ import annotations

from pydantic import Field

from .air import Air
from .contact import Contact
from .mesh import Mesh
from .sections import (
    Dynamics,
    Height,
    Imperfection,
    Installation,
    Material,
    Method,
    Relaxation,
    Section,
    Sheet,
    Thickness,
)
from .specimen import Specimen

__all__ = ["CrumpleTask", "RefineTask", "ResponseTask"]


class _Task(Section):
    sheet: Sheet
    material: Material
    specimen: Specimen = Field(default_factory=Specimen)
    thickness_um: Thickness
    reference_height_mm: Height
    seed: int = Field(ge=0)

    @property
    def overlength_percent(self) -> float:
        """Overlength in per cent of the gap height."""
        gap = self.sheet.gap_height_mm
        return 100.0 * (self.reference_height_mm - gap) / gap


class CrumpleTask(_Task):
    """Crumple one realisation: one thickness, one reference height, one seed."""

    imperfection: Imperfection
    mesh: Mesh
    relaxation: Relaxation
    installation: Installation
    contact: Contact
    method: Method


class RefineTask(_Task):
    """Relax one crumpled realisation again on refined meshes."""

    refinements: int = Field(ge=1)


class ResponseTask(_Task):
    """Static and dynamic stiffness of one crumpled realisation."""

    unsaid_if_empty = ("one_sided",)

    error_percent: float | None = None
    refinements: int = Field(ge=0)
    dynamics: Dynamics
    air: Air
    linear_directions: tuple[str, ...] = Field((), strict=False)
    one_sided: tuple[str, ...] = Field((), strict=False)
