"""The isolated payload of a study configuration."""

from __future__ import annotations

from pydantic import model_validator

from .sections import Section, unit_field

__all__ = ["Isolation"]


class Isolation(Section):
    """Isolated payload on mounts, with foil links between it and the floor.

    It decides the transmissibility and the design chart; changing it computes no physics again.
    The mount is damped structurally, with a loss factor of twice `damping_percent`.
    """

    payload_mass_kg: float = unit_field(
        "kg", "Mass that all mounts together carry.", 100.0, gt=0, le=1e7
    )
    suspension_axial_hz: float = unit_field(
        "Hz",
        "Frequency of the payload on its mounts without links, along the axis of the foil "
        "cylinder; with the mass it gives the stiffness of the mount.",
        2.0,
        ge=0.001,
        le=1e5,
    )
    suspension_radial_hz: float = unit_field(
        "Hz", "The same across the axis.", 2.0, ge=0.001, le=1e5
    )
    damping_percent: float = unit_field(
        "%", "Damping of the mount, in per cent of critical at resonance.", 5.0, gt=0, lt=100
    )
    internal_resonance_hz: float = unit_field(
        "Hz",
        "Resonance within the mount, both ends held; of the second mount that is shown.",
        60.0,
        gt=0,
        le=1e6,
    )
    internal_mass_percent: float = unit_field(
        "%", "Mass that moves in it, in per cent of the payload's.", 1.0, gt=0, le=1000
    )
    links: int = unit_field(
        "1", "Foil links in parallel to the mount, all alike.", 1, ge=1, le=10_000
    )
    stiffness_share_percent: float = unit_field(
        "%",
        "Dynamic stiffness that all links together may have, in per cent of the mount's.",
        10.0,
        gt=0,
        le=1e4,
    )
    up_to_hz: float = unit_field(
        "Hz",
        "Frequency up to which the share is to be kept; it is judged within the computed band, "
        "which ends at `dynamics.shown_max_hz`.",
        100.0,
        gt=0,
        le=1e6,
    )

    @model_validator(mode="after")
    def _internal_resonance_is_possible(self) -> Isolation:
        highest = max(self.suspension_axial_hz, self.suspension_radial_hz)
        # Two springs in series and the mass between them: see foilstudy.measure.isolation.mounts.
        least = 4 * (highest / self.internal_resonance_hz) ** 2 * 100
        if self.internal_mass_percent < least:
            raise ValueError(
                f"isolation.internal_mass_percent is {self.internal_mass_percent:g} %, too light "
                f"for a mount of {highest:g} Hz with isolation.internal_resonance_hz: "
                f"{self.internal_resonance_hz:g}; use at least {1.01 * least:.3g} %, or a "
                "higher internal resonance."
            )
        return self
