"""Crumple the foils of the amplitude study, sweep their rings, and let their modes go."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from foilstudy.measure.amplitude.curve import LINEAR_SHARE, ForceCurve, Side
from foilstudy.measure.amplitude.normal_form import NormalForm, condensed_force
from foilstudy.measure.amplitude.release import released
from foilstudy.model.foil import Imperfection
from foilstudy.pipeline.amplitude import SweepPlan, clamped_modes, ring_sweep
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.study.amplitude.plan import (
    AMPLITUDE_MM,
    MODES,
    PERIODS,
    RAMP_SLOWNESS,
    Letting,
    Shape,
    State,
    Sweep,
)
from foilstudy.study.kernel.plan import Record
from foilstudy.study.published import foil


def crumple_shape(case: Shape) -> dict:
    """Crumple a foil: its control points, and how they were reached.

    Raises
    ------
    RuntimeError
        If it does not come to a stable equilibrium.
    """
    sheet = foil(case.thickness_um, case.height_mm)
    mesh, imperfection = _scene(case)
    method = Method.following(sheet, RAMP_SLOWNESS)
    crumpled = crumple(sheet, mesh, imperfection, method)
    if crumpled.status != "converged":
        raise RuntimeError(f"{case} did not settle: {crumpled.message}")
    return {"message": crumpled.message, "points": crumpled.points}


def _scene(case: Shape) -> tuple[Mesh, Imperfection]:
    return Mesh(case.size_mm * 1e-3), Imperfection(seed=case.seed)


def _crumple_of(case: State, shapes: Mapping[Shape, Record]) -> Crumpled:
    start = uncrumpled(foil(case.thickness_um, case.height_mm), *_scene(case.shape))
    return replace(start, points=shapes[case.shape].result["points"])


def sweep(case: Sweep, shapes: Mapping[Shape, Record]) -> dict:
    """Force and stiffness along a motion, and how far they are linear.

    Returns
    -------
    dict
        ``stiffness`` at rest (N/m), ``message``, ``sides`` (`_side`), ``linear_amplitude`` of the
        secant, ``linear_of_tangent`` (m; None beyond the sweep or where it ended early) and
        ``even_share``: the mean force over the odd one at the largest amplitude of both sides.
    """
    plan = SweepPlan(AMPLITUDE_MM * 1e-3, stressed=case.prestressed)
    curve = ring_sweep(_crumple_of(case, shapes), case.motion, plan)
    return {
        "stiffness": curve.stiffness,
        "message": curve.message,
        "sides": [_side(side) for side in curve.sides],
        "linear_amplitude": curve.linear_amplitude(),
        "linear_of_tangent": curve.tangent_amplitude(),
        "even_share": _even_share(curve),
    }


def spread(case: Sweep, shapes: Mapping[Shape, Record]) -> dict:
    """How far one crumple of several is linear, swept no further than that.

    Returns
    -------
    dict
        ``stiffness`` at rest (N/m), ``linear_amplitude`` of the secant (m; None beyond the sweep
        or where it ended early), ``ended_early`` and ``message``.
    """
    plan = SweepPlan(AMPLITUDE_MM * 1e-3, stressed=case.prestressed, until=LINEAR_SHARE)
    curve = ring_sweep(_crumple_of(case, shapes), case.motion, plan)
    amplitude = curve.linear_amplitude()
    return {
        "stiffness": curve.stiffness,
        "linear_amplitude": amplitude,
        "ended_early": bool(np.isnan(amplitude)),
        "message": curve.message,
    }


def _side(side: Side) -> dict:
    columns = ("motion", "force", "tangent", "energy", "released", "secant")
    return {name: getattr(side, name).tolist() for name in columns} | {"status": list(side.status)}


def _even_share(curve: ForceCurve) -> float:
    if len(curve.sides) < 2:
        return np.nan
    amplitudes, odd, even = curve.parts()
    return float(abs(even[-1] / odd[-1])) if amplitudes.size else np.nan


def modes(case: State, shapes: Mapping[Shape, Record]) -> dict:
    """Normal forms of the lowest clamped modes, with their distance from the next frequency."""
    found = clamped_modes(_crumple_of(case, shapes), MODES + 1, case.prestressed)
    forms = found.normal_forms()[:MODES]
    frequencies = np.sqrt(found.eigenvalues)
    gaps = [
        float(np.abs(np.delete(frequencies, k) / frequencies[k] - 1).min()) for k in range(MODES)
    ]
    return {"modes": [_mode(form) | {"gap": gap} for form, gap in zip(forms, gaps, strict=True)]}


def _mode(form: NormalForm) -> dict:
    names = ("frequency", "eigenvalue", "quadratic", "cubic", "bend", "condensed_bend")
    names += ("condensation_error", "displacement", "doubt")
    values = {name: float(getattr(form, name)) for name in names}
    return values | {"shift_amplitude": form.shift_amplitude(LINEAR_SHARE)}


def release(case: Letting, shapes: Mapping[Shape, Record]) -> dict:
    """Shift of the frequency of a mode by time integration, normal form and condensed force."""
    found = clamped_modes(_crumple_of(case, shapes), MODES, case.prestressed)
    form, shape = found.normal_forms()[case.mode - 1], found.shapes[:, case.mode - 1]
    displacement = case.displacement_mm * 1e-3
    amplitude = displacement / form.displacement
    _, starts = condensed_force(found.foil, shape, amplitude * np.array([0.25, 0.5, 1.0]))
    if not np.isfinite(starts[-1]).all():
        return dict.fromkeys(("frequency", "integrated", "normal_form", "condensed"), np.nan)
    let = released(found.foil, shape, starts[-1], PERIODS / form.frequency)
    condensed, duffing = (
        each.period_frequency(amplitude) / each.frequency - 1
        for each in (form.oscillator, form.duffing)
    )
    return {
        "frequency": form.frequency,
        "integrated": let.frequency / form.frequency - 1,
        "normal_form": duffing,
        "condensed": condensed,
    }
