"""Every quantity of a realisation, declared once: for its record and for the cube."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from foilstudy.base.record import Quantity

_DIRECTION = ("direction",)
_DYNAMIC = ("definition", "direction", "frequency")
_INTERFACE = ("interface_dof", "interface_dof_in")
_CONTROL = ("component", "row", "column")
_NODE = ("component", "node_row", "node_column")
_HISTORY = ("history",)


@dataclass(frozen=True)
class Declared:
    """Unit and meaning of a quantity, and what it is in the cube.

    Attributes
    ----------
    units, words : str
        In the record; SI.
    dims : tuple of str
        Beyond the realisation.
    in_cube : bool
    cube_units : str
        Where the cube has another unit.
    cube_scale : float
        From the one to the other.
    only : str
        Where there is one only by a switch of the configuration, its name in
        `foilstudy.study.sweep.switches.SWITCHES`; empty for what every study has.
    """

    units: str
    words: str
    dims: tuple[str, ...] = ()
    in_cube: bool = True
    cube_units: str = ""
    cube_scale: float = 1.0
    only: str = ""


def _length(words: str) -> Declared:
    """A length in m that the cube gives in mm."""
    return Declared("m", words, cube_units="mm", cube_scale=1e3)


def _true(units: str, words: str, dims: tuple[str, ...] = ()) -> Declared:
    """Of the foil as it stands; for an elastic one the pre-stressed stiffness says it."""
    return Declared(units, words, dims, only="beyond_elastic")


def _contact_stiffness(words: str) -> Declared:
    words = f"static stiffness, other motions held, closed contacts {words}"
    return Declared("N/m", words, _DIRECTION, only="touching")


def _one_sided(words: str) -> Declared:
    words = f"secant stiffness of the foil as it stands, other motions held, {words}"
    return Declared("N/m", words, _DIRECTION, only="one_sided")


def _with_contacts(kind: str, words: str) -> dict[str, Declared]:
    """Dynamic stiffness and eigenfrequencies with closed contacts of a kind."""
    only, of = f"contacts_{kind}", f"closed contacts {words}"
    return {
        f"dynamic_stiffness_contacts_{kind}_re": Declared(
            "N/m", f"dynamic stiffness, {of}, real part", _DYNAMIC, only=only
        ),
        f"dynamic_stiffness_contacts_{kind}_im": Declared(
            "N/m", f"dynamic stiffness, {of}, imaginary part", _DYNAMIC, only=only
        ),
        f"eigenfrequency_contacts_{kind}": Declared(
            "Hz", f"eigenfrequency, rings clamped, {of}", ("mode",), only=only
        ),
    }


def _record_only(units: str, words: str, dims: tuple[str, ...]) -> Declared:
    return Declared(units, words, dims, in_cube=False)


_CLOSED = {
    "normal": "springs along their gaps, as the barrier",
    "rigid": "rigid along their gaps",
    "stuck": "rigid in all directions",
}

QUANTITIES: dict[str, Declared] = {
    "static_stiffness": Declared("N/m", "static stiffness, other motions held", _DIRECTION),
    "static_stiffness_free": Declared("N/m", "static stiffness, other motions free", _DIRECTION),
    "static_stiffness_converged": Declared(
        "N/m", "static stiffness of the same shape, extrapolated to element size zero", _DIRECTION
    ),
    "static_stiffness_mesh_error": Declared(
        "N/m", "estimated mesh error of static_stiffness_converged", _DIRECTION
    ),
    "stiffness_contacts_ignored": _contact_stiffness("as if they were open"),
    **{f"stiffness_contacts_{kind}": _contact_stiffness(words) for kind, words in _CLOSED.items()},
    "stiffness_loading": _one_sided("the top ring pushed down, radially along x and y"),
    "stiffness_unloading": _one_sided("the top ring moved the other way"),
    "static_refinements": Declared("1", "refinements of the shape that these took"),
    "prestressed_stiffness": Declared(
        "N/m", "static stiffness at the stressed equilibrium, other motions held", _DIRECTION
    ),
    "prestressed_stiffness_converged": Declared(
        "N/m", "pre-stressed stiffness, relaxed again on the finest mesh", _DIRECTION
    ),
    "prestressed_stiffness_mesh_error": Declared(
        "N/m", "step of prestressed_stiffness_converged from the next coarser mesh", _DIRECTION
    ),
    "amplitude_1_percent": Declared(
        "m",
        "amplitude at which the secant stiffness at the stressed equilibrium has changed by 1 %, "
        "infinite where it is beyond 1 mm",
        _DIRECTION,
        only="swept",
    ),
    "refined_static_stiffness": Declared(
        "N/m", "static stiffness of the shape relaxed again on the finest mesh", _DIRECTION
    ),
    "interface_stiffness": Declared(
        "N/m, N, N m",
        "stress-free interface stiffness, rotations in rad",
        _INTERFACE,
    ),
    "true_stiffness": _true(
        "N/m", "static stiffness of the foil as it stands, other motions held", _DIRECTION
    ),
    "true_stiffness_free": _true(
        "N/m",
        "static stiffness of the foil as it stands, other motions free; NaN if its ring runs away",
        _DIRECTION,
    ),
    "true_interface_stiffness": _true(
        "N/m, N, N m",
        "interface stiffness of the foil as it stands, rotations in rad",
        _INTERFACE,
    ),
    "true_negative_eigenvalues": _true(
        "1", "negative eigenvalues of the tangent behind it, rings held"
    ),
    "true_ring_negative_eigenvalues": _true(
        "1", "motions of the top ring that it does not resist, the bottom ring held"
    ),
    "true_dynamic_stiffness_re": _true(
        "N/m", "dynamic stiffness of the foil as it stands, real part", _DYNAMIC
    ),
    "true_dynamic_stiffness_im": _true(
        "N/m", "dynamic stiffness of the foil as it stands, imaginary part", _DYNAMIC
    ),
    "true_eigenfrequency": _true(
        "Hz", "eigenfrequency of the foil as it stands, rings clamped", ("mode",)
    ),
    "dynamic_stiffness_re": Declared("N/m", "dynamic stiffness, real part", _DYNAMIC),
    "dynamic_stiffness_im": Declared("N/m", "dynamic stiffness, imaginary part", _DYNAMIC),
    "eigenfrequency": Declared("Hz", "eigenfrequency, rings clamped", ("mode",)),
    **{
        name: what
        for kind, words in _CLOSED.items()
        for name, what in _with_contacts(kind, words).items()
    },
    "first_eigenfrequency": Declared("Hz", "first eigenfrequency, rings clamped"),
    "vacuum_first_eigenfrequency": Declared(
        "Hz", "first eigenfrequency without the air, rings clamped", only="in_air"
    ),
    "enclosed_volume": Declared(
        "m3",
        "volume between foil and end plates",
        cube_units="l",
        cube_scale=1e3,
        only="in_air",
    ),
    "membrane_energy": Declared("J", "membrane energy"),
    "bending_energy": Declared("J", "bending energy"),
    "stabilisation_energy": Declared("J", "stabilisation energy"),
    "plastic_relief_energy": Declared(
        "J", "what plastic strains take off these three: a negative energy", only="yielding"
    ),
    "reaction_force": Declared("N", "axial force of the crumpled foil on the top ring"),
    "free_height": Declared(
        "m",
        "height to which the foil sprang when its ring was let go, the last time",
        (),
        cube_units="mm",
        cube_scale=1e3,
        only="lets_go",
    ),  # fmt: skip
    "radial_displacement_min": _length("smallest radial displacement"),
    "radial_displacement_max": _length("largest radial displacement"),
    "radial_displacement_rms": _length("root mean square radial displacement"),
    "equilibrium_residual": Declared("1", "force on the free foil over force on the rings"),
    "negative_eigenvalues": Declared("1", "negative eigenvalues of the tangent at the end"),
    "attempt": Declared(
        "1", "attempt that led here: 1 as configured, more with safer settings", only="retrying"
    ),
    "steps": Declared("1", "pseudo-time steps, ramp included"),
    "newton_steps": Declared("1", "quasi-Newton steps after them"),
    "hessians": Declared("1", "tangents formed for them"),
    "refined_strain_energy": Declared("J", "strain energy, relaxed again on the finest mesh"),
    "refined_element_size": _length("element size of the finest relaxed mesh"),
    "refined_residual": Declared("1", "equilibrium residual on the finest relaxed mesh"),
    "refined_negative_eigenvalues": Declared("1", "negative eigenvalues on that mesh"),
    "refined_steps": Declared("1", "pseudo-time steps on that mesh"),
    "element_size": _length("element size of the crumpled mesh"),
    "fold_angle": Declared(
        "rad",
        "angle between neighbouring elements that one pair in a hundred exceeds",
        cube_units="deg",
        cube_scale=180 / np.pi,
    ),
    "youngs_modulus": Declared(
        "Pa", "Young's modulus drawn", cube_units="MPa", cube_scale=1e-6, only="drawing"
    ),
    "yield_stress": Declared(
        "Pa", "yield stress drawn", cube_units="MPa", cube_scale=1e-6, only="drawing"
    ),
    "beyond_yield_share": Declared("1", "share of the surface beyond the yield stress"),
    "plastic_share": Declared("1", "share of the volume that has yielded", only="yielding"),
    "plastic_strain_max": Declared("1", "largest accumulated plastic strain", only="yielding"),
    "dissipated_work": Declared("J", "work that plastic flow has used up", only="yielding"),
    "stress_kept": _true("1", "share of the stress that waiting has left"),
    "self_crossing_share": Declared("1", "share of the surface crossed by another part"),
    "contact_share": Declared("1", "share of the knots in closed contacts", only="touching"),
    "contact_pairs": Declared(
        "1", "pairs of points and triangles or edges that touch", only="touching"
    ),
    "contact_knots_at_rings": Declared(
        "1", "knots that touch the planes of the rings", only="touching"
    ),
    "contact_gap_min": Declared(
        "m",
        "smallest gap of a closed contact",
        cube_units="um",
        cube_scale=1e6,
        only="touching",
    ),
    "contact_friction_work": Declared(
        "J", "work used up by friction of the foil on itself", only="rubbing"
    ),
    "contact_friction_slipping_share": Declared(
        "1", "share of its contacts with itself that stand at the limit of sticking", only="rubbing"
    ),
    "ring_plane_friction_work": Declared(
        "J", "work used up by friction on the planes of the rings", only="rubbing"
    ),
    "ring_plane_friction_slipping_share": Declared(
        "1", "share of the contacts with these that stand at the limit", only="rubbing"
    ),
    "contact_shortened_steps": Declared(
        "1", "steps shortened lest parts of the foil cross", only="touching"
    ),
    "clamp_slip_max": replace(
        _length("farthest that the foil has slipped in a clamp, out or in"), only="slipping"
    ),
    "clamp_slip_mean": replace(
        _length("mean around both clamps of what has come out of them"), only="slipping"
    ),
    "clamp_slipped_share": Declared(
        "1", "share of both edges that has ever slipped", only="slipping"
    ),
    "clamp_work": Declared("J", "work used up by slipping in the clamps", only="slipping"),
    "broad_wave_share": Declared(
        "1", "share of the radial displacement that bulges or sways the cylinder as a whole"
    ),
    "calmer_half": Declared(
        "1", "radial displacement of the calmer half of the height over that of the other, RMS"
    ),
    "developed_height": _length("length of the meridians of the crumple, mean around"),
    "shortening_spread": Declared(
        "1", "share of the height that takes part in the shortening: 1 if evenly, 0.1 if a band"
    ),
    "shortening_gini": Declared("1", "Gini coefficient of the shortening of ten bands of height"),
    "axisymmetric_share": Declared("1", "share of the radial displacement that is axisymmetric"),
    "alternation": Declared("1", "opposition of the twists of neighbouring elements"),
    "hidden_energy": Declared(
        "1",
        "energy by fully integrated elements over that by its own, times (thickness / size)^2",
    ),
    "verdict": Declared("1", "what the numbers of the realisation say of it, a bit each"),
    "mode_count": Declared(
        "1", "eigenfrequencies, rings clamped, below a frequency", ("frequency",)
    ),
    "reduced_coordinates": Declared("1", "coordinates of the reduced model"),
    "reduction_error": Declared("1", "estimated largest relative error of the reduction"),
    "valid_to_frequency": Declared("Hz", "frequency up to which that meets the tolerance"),
    "seconds_crumple": Declared("s", "time of crumpling"),
    "seconds_static": Declared("s", "time of the static stiffness"),
    "seconds_dynamic": Declared("s", "time of the dynamic stiffness"),
    "seconds_refined": Declared("s", "time of relaxing again on refined meshes"),
    "peak_memory": Declared("MB", "peak memory of the response job"),
    "cylinder_stiffness": _record_only(
        "N/m",
        "static stiffness of the uncrumpled cylinder",
        ("thickness", "overlength", "direction"),
    ),
    "frequency": _record_only("Hz", "frequency", ("frequency",)),
    "mode_shape": _record_only(
        "m/sqrt(kg m2)",
        "mass-normalised displacement of the surface at the knots, clamped rings",
        ("shape_mode", "component", "node_row", "node_column"),
    ),
    "control_points": _record_only("m", "control points, crumpled", _CONTROL),
    "reference_control_points": _record_only("m", "control points, stress-free", _CONTROL),
    "waiting_control_points": _record_only(
        "m", "control points of the shape in which stress has relaxed", _CONTROL
    ),
    "surface": _record_only("m", "surface points at the knots, crumpled", _NODE),
    "reference_surface": _record_only("m", "surface points at the knots, stress-free", _NODE),
    "radial_displacement": _record_only("m", "radial displacement", _NODE[1:]),
    "shortening_profile": _record_only(
        "m", "shortening of bands of the developed height, from the bottom ring", ("band",)
    ),
    "plastic_strain": _record_only(
        "1",
        "plastic strains 11, 22, 2 12 of the layers in Cartesian axes, and the accumulated one",
        ("element_row", "layer", "plastic_component", "element_column"),
    ),
    **{
        f"{name}_friction_contacts": _record_only(
            "m, N, 1",
            "of contacts: knots, sides, weights, direction, normal force, spring, arms",
            (f"{name}_friction_contact", "friction_value"),
        )
        for name in ("contact", "ring_plane")
    },
    "work_spent": _record_only(
        "J",
        "what the way took beside the energies: used up by plastic flow, friction and clamps, or "
        "kept by hardening",
        (),
    ),
    "clamp_slip": _record_only(
        "m",
        "what has come out of the bottom and of the top clamp at each column of control points",
        ("ring", "column"),
    ),
    "history_step": _record_only("1", "pseudo-time step", _HISTORY),
    "history_height": _record_only("m", "height between the rings", _HISTORY),
    "history_reaction_force": _record_only(
        "N", "axial force of the foil on the top ring", _HISTORY
    ),
    "history_kinetic_energy": _record_only("J", "kinetic energy of the fictitious mass", _HISTORY),
    "history_residual": _record_only(
        "1", "norm of the force on the free foil over that on the rings", _HISTORY
    ),
}
"""By name, in the order of the cube."""


_ENERGY = "_energy"


def declared(name: str) -> Declared:
    """What is declared of a quantity; further terms of the energy are known by their ending.

    Raises
    ------
    KeyError
        If it is not declared.
    """
    if name not in QUANTITIES and name.endswith(_ENERGY):
        words = name.removesuffix(_ENERGY).removeprefix("history_").replace("_", " ")
        dims = _HISTORY if name.startswith("history_") else ()
        return _record_only("J", f"energy of the {words}", dims)
    return QUANTITIES[name]


def quantities(values: Mapping[str, np.ndarray | float]) -> dict[str, Quantity]:
    """Values with what is declared of them.

    Raises
    ------
    KeyError
        If a value is not declared.
    """
    return {
        name: Quantity(value, what.units, what.words, what.dims)
        for name, value in values.items()
        for what in (declared(name),)
    }
