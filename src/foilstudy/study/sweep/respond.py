"""The job that measures static and dynamic stiffness of one crumpled realisation."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from foilstudy.base.costs import measured
from foilstudy.base.outcome import USABLE
from foilstudy.base.record import write_record
from foilstudy.base.spec import dumped
from foilstudy.config import ResponseTask
from foilstudy.config.foils import foil_of
from foilstudy.config.scene import air_of, dynamics_of
from foilstudy.linalg import SolveError, lowest_modes
from foilstudy.measure.air.protocols import Air
from foilstudy.measure.air.surface import WettedSurface
from foilstudy.measure.dynamics import DynamicsOptions, Structure
from foilstudy.measure.stiffness import fixed_stiffness, free_stiffness
from foilstudy.measure.stiffness.contacts import CONTACT_SPRINGS
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.measure.verdicts import Evidence, flags, verdicts
from foilstudy.model.patch import Patch
from foilstudy.pipeline.amplitude.sweep import linear_amplitude
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.one_sided import one_sided
from foilstudy.pipeline.structures import in_air, stress_free_structure
from foilstudy.pipeline.true_state import true_state
from foilstudy.pipeline.vibration import Vibration, surface_modes, vibration_of
from foilstudy.study.sweep.origins import read_crumple, response_origin
from foilstudy.study.sweep.outcome import Outcome, Values, outcome_of
from foilstudy.study.sweep.quantities import quantities

_OF_CONTACTS = {
    "dynamic_stiffness_re": "dynamic_stiffness_contacts_{}_re",
    "dynamic_stiffness_im": "dynamic_stiffness_contacts_{}_im",
    "eigenfrequency": "eigenfrequency_contacts_{}",
}
"""What of the dynamics is measured with closed contacts, too, and what it is called then."""


def respond_job(task: ResponseTask, crumple_path: Path, path: Path) -> None:
    """Measure the crumple in `crumple_path` and write `path`, whatever happens.

    A crumple without a shape passes its status on; a failed measurement becomes a record whose
    ``status`` and ``message`` say so.

    Raises
    ------
    Refusal
        If the record of the crumple is unreadable or another's: no outcome of this realisation.
    """
    recorded, attributes = read_crumple(crumple_path, task)
    origin = response_origin(task, attributes)  # before the work: the code may be edited meanwhile
    outcome = Outcome(attributes["status"], attributes["message"])

    def work() -> Outcome:
        values = _measured(task, Crumpled.of_record(recorded, attributes))
        missing = (
            _without_prestress(values),
            _without_amplitude(task, values),
            _without_secants(task, values),
            _beyond_validity(task, values),
            _without_contacts(task, values),
            _unstable(values),
        )
        words = filter(None, (outcome.message, *missing))
        return Outcome(outcome.status, "; ".join(words), values)

    with measured() as cost:
        if outcome.status in USABLE:
            outcome = outcome_of(work)
    known = {**recorded, **outcome.values} if outcome.status in USABLE else {}
    found = verdicts(Evidence.of(outcome.status, known))
    values = outcome.values | {
        "verdict": float(flags(found)),
        "peak_memory": cost.peak_memory_mb,
    }
    described = {
        "status": outcome.status,
        "message": outcome.message,
        "foil": dumped(foil_of(task)),
    }
    write_record(path, quantities(values), described, origin)
    print(_summary(values) if outcome.values else f"{outcome.status}: {outcome.message}")


def _prestressed(crumpled: Crumpled) -> np.ndarray:
    """NaN where the tangent is singular: the other numbers need none of it."""
    try:
        return crumpled.prestressed_stiffness()
    except SolveError as error:
        print(f"no pre-stressed stiffness: {error}")
        return np.full(2, np.nan)


def _without_prestress(values: dict) -> str:
    if np.isfinite(values["prestressed_stiffness"]).all():
        return ""
    return "no pre-stressed stiffness, as the tangent of the crumple is singular"


def _without_amplitude(task: ResponseTask, values: dict) -> str:
    without = _unknown(task.linear_directions, values, "amplitude_1_percent")
    if not without:
        return ""
    return (
        f"no {' and '.join(without)} linear amplitude, as the foil finds no equilibrium on the way "
        "to it"
    )


def _without_secants(task: ResponseTask, values: dict) -> str:
    without = _unknown(task.one_sided, values, "stiffness_loading", "stiffness_unloading")
    if not without:
        return ""
    return (
        f"not both secants ({', '.join(without)}), as the foil snaps or finds no equilibrium near "
        "where it stands"
    )


def _unknown(asked: Sequence[str], values: dict, *names: str) -> list[str]:
    """Directions that were asked for and of which one of some quantities is NaN."""
    return [
        direction
        for k, direction in enumerate(DIRECTIONS)
        if direction in asked and any(np.isnan(values[name][k]) for name in names)
    ]


def _without_contacts(task: ResponseTask, values: dict) -> str:
    """What to say of dynamics with closed contacts that are known less far than with open ones."""
    open_to = np.isfinite(values["dynamic_stiffness_re"]).sum()
    without = [
        kind
        for kind in task.dynamics.contacts
        if np.isfinite(values[f"dynamic_stiffness_contacts_{kind}_re"]).sum() < open_to
    ]
    if not without:
        return ""
    return (
        f"dynamic stiffness with closed contacts ({', '.join(without)}) not in the whole band, as "
        "the reduced model is wrong beyond or could not be made: lower dynamics.shown_max_hz or "
        "raise dynamics.tolerance"
    )


def _beyond_validity(task: ResponseTask, values: dict) -> str:
    """What to say of a reduced model that does not reach to the end of the band."""
    error, options = values["reduction_error"], task.dynamics
    if error <= options.tolerance:
        return ""
    remedy = "lower dynamics.shown_max_hz or raise dynamics.tolerance"
    if options.reduction != "rational_krylov":
        remedy = f"set dynamics.reduction: rational_krylov, or {remedy}"
    reach = f"only to {values['valid_to_frequency']:.4g} Hz"
    if not np.isfinite(values["dynamic_stiffness_re"]).any():
        reach = "at no frequency of the shown band"
    return (
        f"dynamic stiffness {reach}, as the {options.reduction} model is wrong by about "
        f"{100 * error:.2g} % in it: {remedy}"
    )


def _unstable(values: dict) -> str:
    """What to say of an equilibrium about which nothing oscillates."""
    count = values.get("true_negative_eigenvalues", 0)
    if not count:
        return ""
    return (
        f"no dynamic stiffness of the foil as it stands, as its tangent has {count:g} negative "
        "eigenvalues"
    )


def _summary(values: dict) -> str:
    axial, radial = values["static_stiffness"]
    seconds = values["seconds_static"] + values["seconds_dynamic"]
    return f"axial {axial:.4g} N/m, radial {radial:.4g} N/m ({seconds:.1f} s)"


def _measured(task: ResponseTask, crumpled: Crumpled) -> Values:
    with measured() as static:
        structure = stress_free_structure(crumpled)
        values = _static(crumpled, structure, task) | _amplitudes(crumpled, task)
        values |= _secants(crumpled, task)
    with measured() as dynamic:
        options, air = dynamics_of(task.dynamics), air_of(task.air)
        if task.air.kind != "none":
            values |= _without_air(structure, crumpled)
        values |= _dynamic(in_air(crumpled, structure, air), options, crumpled.patch)
        if task.dynamics.contacts:
            values |= _on_contacts(task.dynamics.contacts, crumpled, values, options, air)
        true = _true(crumpled, options, air) if crumpled.beyond_elastic else {}
        # what is true of such a foil is pre-stressed stiffness, and need not be measured twice
        same = true["true_stiffness"] if true else _prestressed(crumpled)
        values |= true | {"prestressed_stiffness": same}
    return values | {"seconds_static": static.seconds, "seconds_dynamic": dynamic.seconds}


def _static(crumpled: Crumpled, structure: Structure, task: ResponseTask) -> Values:
    interface = structure.static.stiffness
    plain = fixed_stiffness(interface)
    if task.error_percent is None:
        limit = crumpled.mesh_limit(task.refinements, plain)
    else:
        limit = crumpled.mesh_limit_within(task.error_percent / 100, task.refinements, plain)
    return {
        "static_stiffness": plain,
        "static_stiffness_free": free_stiffness(interface),
        "static_stiffness_converged": limit.stiffness,
        "static_stiffness_mesh_error": limit.error,
        "static_refinements": float(limit.refinements),
        "interface_stiffness": interface,
        **(_bracket(crumpled) if crumpled.method.touches else {}),
    }


def _true(crumpled: Crumpled, options: DynamicsOptions, air: Air) -> Values:
    """Nothing where the tangent is singular, which the message says of the pre-stressed one."""
    try:
        state = true_state(crumpled, options, air)
    except SolveError as error:
        print(f"no true stiffness: {error}")
        return {}
    values: Values = {
        "true_stiffness": state.stiffness,
        "true_stiffness_free": state.free_stiffness,
        "true_interface_stiffness": state.interface,
        "true_negative_eigenvalues": float(state.negative_eigenvalues),
        "true_ring_negative_eigenvalues": float(state.ring_negative_eigenvalues),
    }
    if state.vibration:
        values |= {
            "true_dynamic_stiffness_re": state.vibration.dynamic_stiffness.real,
            "true_dynamic_stiffness_im": state.vibration.dynamic_stiffness.imag,
            "true_eigenfrequency": state.vibration.eigenfrequencies,
        }
    return values


def _without_air(structure: Structure, crumpled: Crumpled) -> Values:
    """What the numbers with air are compared with, and how much of it is enclosed."""
    stiffness, mass = structure.stiffness.interior, structure.mass.interior
    first = lowest_modes(stiffness, mass, structure.static.factor, 1).eigenvalues[0]
    return {
        "vacuum_first_eigenfrequency": float(np.sqrt(first) / (2 * np.pi)),
        "enclosed_volume": WettedSurface(crumpled.patch, crumpled.points).volume,
    }


def _amplitudes(crumpled: Crumpled, task: ResponseTask) -> Values:
    """How far the stiffness holds, in the directions that the task asks for."""
    if not task.linear_directions:
        return {}
    found = [
        linear_amplitude(crumpled, direction) if direction in task.linear_directions else np.nan
        for direction in DIRECTIONS
    ]
    return {"amplitude_1_percent": np.array(found)}


def _secants(crumpled: Crumpled, task: ResponseTask) -> Values:
    """Stiffness one way and the other, in the directions that the task asks for."""
    if not task.one_sided:
        return {}
    found = np.full((2, len(DIRECTIONS)), np.nan)
    for k, direction in enumerate(DIRECTIONS):
        if direction in task.one_sided:
            found[:, k] = _both_ways(crumpled, direction)
    return {"stiffness_loading": found[0], "stiffness_unloading": found[1]}


def _both_ways(crumpled: Crumpled, direction: str) -> tuple[float, float]:
    """NaN where the tangent is singular: the other numbers need none of it."""
    try:
        secants = one_sided(crumpled, direction)
    except SolveError as error:
        print(f"no {direction} secants: {error}")
        return np.nan, np.nan
    return secants.loading, secants.unloading


def _on_contacts(
    kinds: Sequence[str],
    crumpled: Crumpled,
    opened: Values,
    options: DynamicsOptions,
    air: Air,
) -> Values:
    """Dynamics free of stress with closed contacts of some kinds, see `ContactBracket`.

    Where none is closed they are those with open ones, and NaN where they cannot be had.
    """
    closed = any(each.closed_at(crumpled.points) for each in crumpled.contacts())
    values: Values = {}
    for kind in kinds:
        found = {name: opened[name] for name in _OF_CONTACTS}
        if closed:
            try:
                found = _dynamic_stiffness(crumpled.vibration(options, air, kind))
            except SolveError as error:
                print(f"no dynamic stiffness with contacts that are {kind}: {error}")
                found = {name: np.full_like(value, np.nan) for name, value in found.items()}
        values |= {template.format(kind): found[name] for name, template in _OF_CONTACTS.items()}
    return values


def _bracket(crumpled: Crumpled) -> Values:
    bracket = crumpled.contact_bracket()
    return {f"stiffness_contacts_{kind}": getattr(bracket, kind) for kind in CONTACT_SPRINGS}


def _dynamic(structure: Structure, options: DynamicsOptions, patch: Patch) -> Values:
    vibration = vibration_of(structure, options)
    model = vibration.model
    values = _dynamic_stiffness(vibration) | {
        "frequency": vibration.frequencies,
        "reduced_coordinates": float(model.size),
        "reduction_error": model.error_estimate,
        "valid_to_frequency": model.valid_to_hz,
        "mode_count": vibration.mode_count,
        "first_eigenfrequency": vibration.eigenfrequencies[0],
    }
    if vibration.mode_shapes.shape[1]:
        shapes = surface_modes(patch, vibration.mode_shapes)
        values["mode_shape"] = shapes.astype(np.float32)
    return values


def _dynamic_stiffness(vibration: Vibration) -> Values:
    """By the names of `_OF_CONTACTS`."""
    return {
        "dynamic_stiffness_re": vibration.dynamic_stiffness.real,
        "dynamic_stiffness_im": vibration.dynamic_stiffness.imag,
        "eigenfrequency": vibration.eigenfrequencies,
    }
