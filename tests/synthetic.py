"""Synthetic cubes and records with known answers, for the tests of statistics, figures and page.

Nothing here is physics: the stiffness follows a prescribed power law with prescribed scatter,
and the crumple is an analytic wavy cylinder.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import xarray as xr

from foilstudy.base.outcome import USABLE
from foilstudy.base.record import read_attributes, write_record
from foilstudy.config.model import overlength_id, thickness_id
from foilstudy.model.patch import knot_points
from foilstudy.study.sweep.cube import CONVENTION
from foilstudy.study.sweep.quantities import QUANTITIES, quantities

DIRECTIONS = ["axial", "radial"]
DEFINITIONS = ["transfer", "driving", "relative"]
LAW = {"axial": (3.6, -0.9, 1.4), "radial": (3.1, -0.5, 1.42)}
LIMIT_SHIFT = 0.3
"""What the mesh limit adds to the exponent of the thickness."""
EXPONENT = -2.2
MODES_PER_HZ = 0.3
GAP_HEIGHT_MM = 130.0
DIAMETER_MM = 200.0
FAILED = ("failed", "the ring force is not finite at step 12: lower mesh.element_size_mm")
FEP = """{name: FEP, youngs_modulus_mpa: 650, poisson_ratio: 0.4, density_kg_m3: 2150,
  yield_stress_mpa: 12}"""
PET = """{name: PET, youngs_modulus_mpa: 4000, poisson_ratio: 0.38, density_kg_m3: 1390,
  yield_stress_mpa: 100}"""


@dataclass(frozen=True)
class SyntheticCase:
    """Foil, gap and mesh of a synthetic study; the published foil on a mesh that resolves it.

    Attributes
    ----------
    mesh_error : callable
        Stated error over the mesh limit, from thickness (um) and overlength (%), which broadcast.
    """

    diameter_mm: float = DIAMETER_MM
    gap_height_mm: float = GAP_HEIGHT_MM
    material: str = FEP
    element_size_mm: float = 2.0
    refinements: int = 2
    mesh_error: Callable = lambda thickness, overlength: 0.05

    @property
    def config(self) -> str:
        """The configuration in the cube; its sweep is that of the cube."""
        return f"""\
sheet: {{diameter_mm: {self.diameter_mm:g}, gap_height_mm: {self.gap_height_mm:g}}}
material: {self.material}
mesh: {{element_size_mm: {self.element_size_mm:g}, element: corner}}
relaxation: {{residual_tolerance: 1.0e-6, ramp_steps: 2000}}
stiffness: {{refinements: {self.refinements}}}
report: {{title: Synthetic study}}
"""


CONFIG = SyntheticCase().config
COARSE = SyntheticCase(element_size_mm=5.0)
"""The published foil on 5 mm, which does not resolve it below 250 um."""
CELL = ("thickness", "overlength", "seed")


def ten_percent(overlength, direction):
    """A coefficient of variation for `make_cube`."""
    return 0.1


def exact_scatter(rng, n, cv):
    """`n` positive factors of mean 1 whose sample coefficient of variation is `cv`."""
    if n == 1:
        return np.ones(1)
    x = rng.standard_normal(n)
    x = (x - x.mean()) / x.std(ddof=1)
    return 1 + cv * x


def make_cube(
    thickness_um=(50.0, 130.0, 250.0, 500.0),
    reference_height_mm=(135.0, 150.0, 170.0, 200.0, 250.0),
    seeds=6,
    cv=lambda overlength, direction: 0.0,
    verdicts: Mapping[tuple[int, int, int], tuple[str, str]] | None = None,
    relaxed_again=False,
    case: SyntheticCase = SyntheticCase(),
):
    """A cube, as `open_cube` gives it, that obeys `LAW` and `EXPONENT`.

    The stiffness scatters with `cv`, a function of overlength and direction; from the first
    eigenfrequency on there are `MODES_PER_HZ`. All realisations converged, but for cells (i, j, s)
    whose status and message `verdicts` holds. Pre-stressed values after relaxing again on refined
    meshes are there when asked for.
    """
    rng = np.random.default_rng(1)
    t, h = np.asarray(thickness_um, float), np.asarray(reference_height_mm, float)
    o = 100 * (h - case.gap_height_mm) / case.gap_height_mm
    f = np.geomspace(1, 800, 60)
    shape = (t.size, o.size, seeds)
    static = np.empty((*shape, 2))
    for d, direction in enumerate(DIRECTIONS):
        law = _power_law(direction, o[None, :], t[:, None])
        for i, j in np.ndindex(shape[:2]):
            static[i, j, :, d] = law[i, j] * exact_scatter(rng, seeds, cv(o[j], direction))
    f1 = 2e5 * t[:, None, None] ** 0.6 * h[None, :, None] ** EXPONENT
    f1 = f1 * (1 + 0.03 * rng.standard_normal(shape) * (cv(50.0, "axial") > 0))
    ratio = f / f1[..., None]
    magnitude = static[..., None] * np.abs(1 - ratio**2 + 0.1j * ratio)[..., None, :] ** 0.7
    dynamic = magnitude[:, :, :, None] * np.array([1.0, 1.1, 0.9])[:, None, None] * (0.8 + 0.6j)
    values = {
        **_cell_quantities(t[:, None, None], o[None, :, None], shape),
        "element_size": np.full(shape, case.element_size_mm),
        "first_eigenfrequency": f1,
        "mode_count": np.maximum(0, np.floor(MODES_PER_HZ * (f - f1[..., None]) + 1)),
        **_stiffnesses(t[:, None, None, None], static, relaxed_again),
        "static_stiffness_mesh_error": np.broadcast_to(
            np.asarray(case.mesh_error(t[:, None], o[None, :]), float), shape[:2]
        )[..., None, None]
        * (t[:, None, None, None] / 600) ** LIMIT_SHIFT
        * static,
        "dynamic_stiffness": dynamic,
    }
    if case.refinements == 0:
        for name in ("static_stiffness_converged", "static_stiffness_mesh_error"):
            values[name] = np.full_like(static, np.nan)
    status, message = np.full(shape, "converged", object), np.full(shape, "", object)
    for cell, (outcome, words) in (verdicts or {}).items():
        status[cell], message[cell] = outcome, words
        if outcome not in USABLE:
            for array in values.values():
                array[cell] = np.nan
    cylinder = 2.4e3 * t[:, None, None] * np.array([1.0, 0.16]) * (130 / h)[None, :, None]
    dims = ("thickness", "overlength", "direction")
    return xr.Dataset(
        {
            **{name: _declared(name, array) for name, array in values.items()},
            "cylinder_stiffness": (dims, cylinder, {"units": "N/m"}),
            "status": (CELL, status),
            "message": (CELL, message),
        },
        {
            "thickness": ("thickness", t, {"units": "um"}),
            "overlength": ("overlength", o, {"units": "%"}),
            "reference_height": ("overlength", h, {"units": "mm"}),
            "seed": np.arange(seeds),
            "direction": DIRECTIONS,
            "definition": DEFINITIONS,
            "frequency": ("frequency", f, {"units": "Hz"}),
        },
        {
            "Conventions": CONVENTION,
            "study": "synthetic",
            "config": case.config,
            "git_commit": "0123abc",
            "created": "2026-01-01T00:00:00Z",
        },
    )


def _declared(name, values):
    """Dimensions, values and attributes as in the cube of a study."""
    known = QUANTITIES[name if name in QUANTITIES else f"{name}_re"]
    attributes = {"units": known.cube_units or known.units, "long_name": known.words}
    return (*CELL, *known.dims), values, attributes


def _power_law(direction, overlength, thickness):
    alpha, beta, gamma = LAW[direction]
    return np.exp(alpha + beta * np.log(overlength) + gamma * np.log(thickness))


def _cell_quantities(t, o, shape):
    """Numbers of a sound study whose thickest foils are no stable equilibria and whose tallest
    yield."""
    ones = np.ones(shape)
    energy = 5e-3 * (t / 50) ** 1.5 * o * ones
    return {
        "membrane_energy": 0.3 * energy,
        "bending_energy": 0.6 * energy,
        "stabilisation_energy": 0.1 * energy * 50 / t,
        "equilibrium_residual": 1e-7 * ones,
        "negative_eigenvalues": np.where(t > 400, 2.0, 0.0) * ones,
        "steps": 2000 + 1e6 / t * ones,
        "newton_steps": 12 * ones,
        "radial_displacement_min": -20 * ones,
        "radial_displacement_max": 30.4 * ones,
        "beyond_yield_share": np.where(o > 60, 0.2, 0.0) * ones,
        "self_crossing_share": 0 * ones,
        "seconds_crumple": 3 * ones,
        "seconds_static": 0.5 * ones,
        "seconds_dynamic": 1.5 * ones,
        "peak_memory": 400 * ones,
    }


def _stiffnesses(t, static, relaxed_again):
    refinement = (t / 600) ** LIMIT_SHIFT
    # The stress takes more from thick foils: its law has a smaller thickness exponent.
    stressed = 0.5 * (t / 50) ** -0.2 * static
    values = {
        "static_stiffness": static,
        "static_stiffness_free": 0.8 * static,
        "prestressed_stiffness": stressed,
        "static_stiffness_converged": refinement * static,
    }
    if relaxed_again:
        values["prestressed_stiffness_converged"] = 0.7 * stressed
        values["prestressed_stiffness_mesh_error"] = 0.3 * stressed
    return values


def write_cube(cube, path):
    """Write a cube as a study does, for `open_cube` to read."""
    path.parent.mkdir(parents=True, exist_ok=True)
    dynamic = cube["dynamic_stiffness"]
    cube.drop_vars("dynamic_stiffness").assign(
        dynamic_stiffness_re=dynamic.real, dynamic_stiffness_im=dynamic.imag
    ).to_netcdf(path)
    return path


def write_records(cube, folder, element_mm=10.0):
    """Write crumple.nc and response.nc of every realisation of a cube below a study's folder."""
    crumples = []
    for i, j, s in np.ndindex(cube["status"].shape):
        cell = cube.isel(thickness=i, overlength=j, seed=s)
        thickness, height = float(cell["thickness"]), float(cell["reference_height"])
        place = folder / "realisations" / thickness_id(thickness) / overlength_id(height) / str(s)
        crumple = write_crumple(
            place / "crumple.nc", thickness, height, s, str(cell["status"].values), element_mm
        )
        shapes = np.random.default_rng(s).standard_normal((3, 3, 6, 12))
        write_response(crumple, shapes)
        crumples.append(crumple)
    return crumples


def write_study(cube, folder):
    """Write a cube and the records that it might have been gathered from."""
    crumples = write_records(cube, folder)
    for part in ("crumple", "response"):
        digests = [read_attributes(path.with_name(f"{part}.nc"))["digest"] for path in crumples]
        shape = cube["status"].shape
        cube[f"{part}_digest"] = cube["status"].dims, np.reshape(digests, shape).astype(object)
    write_cube(cube, folder / "cube.nc")
    return crumples


def write_crumple(
    path, thickness_um=500.0, reference_height_mm=170.0, seed=0, status="converged", element_mm=5.0
):
    """Write a crumple.nc with an analytic wavy surface, or a failed one without arrays."""
    overlength = 100 * (reference_height_mm - GAP_HEIGHT_MM) / GAP_HEIGHT_MM
    attributes = {
        "status": status,
        "message": "" if status == "converged" else "the ring force is not finite",
        "thickness_um": float(thickness_um),
        "overlength_percent": overlength,
        "reference_height_mm": float(reference_height_mm),
        "seed": seed,
    }
    values = {}
    if status in USABLE:
        rng = np.random.default_rng([seed, int(thickness_um), int(reference_height_mm)])
        values = _shape(rng, thickness_um, overlength, reference_height_mm, element_mm)
        values |= _history(overlength, reference_height_mm, thickness_um)
    write_record(path, quantities(values), attributes)
    return path


def write_response(crumple_path, shapes=None, frequencies=None):
    """Write the response.nc beside a crumple, with mode shapes (mode, 3, rows, columns) or none."""
    path = Path(crumple_path).with_name("response.nc")
    values = {}
    if shapes is not None:
        known = 50.0 + 10.0 * np.arange(len(shapes)) if frequencies is None else frequencies
        eigenfrequencies = np.full(20, np.nan)
        eigenfrequencies[: len(known)] = known
        values = {"mode_shape": shapes.astype("f4"), "eigenfrequency": eigenfrequencies}
    write_record(path, quantities(values), {"status": "converged", "message": ""})
    return path


def _shape(rng, thickness_um, overlength, reference_height_mm, element):
    rows = int(round(reference_height_mm / element)) + 2
    columns = int(round(np.pi * DIAMETER_MM / element))
    theta = 2 * np.pi * np.arange(columns) / columns
    zeta = (np.arange(rows) - 0.5) / (rows - 2)
    T, Z = np.meshgrid(theta, zeta)
    window = np.sin(np.pi * np.clip(Z, 0, 1)) ** 0.5
    wave = np.zeros_like(T)
    waves = 4 + 24 / np.sqrt(thickness_um / 10)
    for _ in range(40):
        m = rng.integers(2, 2 + int(2 * waves))
        n = rng.uniform(0, waves)
        wave += np.cos(m * T + 2 * np.pi * n * Z + rng.uniform(0, 2 * np.pi)) / waves
    amplitude = 2.0 * overlength**0.5
    r = DIAMETER_MM / 2 + amplitude * window * (np.abs(wave) - np.abs(wave).mean())
    r0 = DIAMETER_MM / 2
    points = np.stack([r * np.cos(T), r * np.sin(T), Z * GAP_HEIGHT_MM]) * 1e-3
    reference = np.stack([r0 * np.cos(T), r0 * np.sin(T), Z * reference_height_mm]) * 1e-3
    return {
        "control_points": points,
        "reference_control_points": reference,
        "surface": knot_points(points),
        "reference_surface": knot_points(reference),
    }


def _history(overlength, reference_height_mm, thickness_um):
    step = np.arange(0, 6001, 20)
    tau = np.clip(step / 2000, 0, 1)
    path = 10 * tau**3 - 15 * tau**4 + 6 * tau**5
    height = (reference_height_mm + (GAP_HEIGHT_MM - reference_height_mm) * path) * 1e-3
    energy = (thickness_um / 500) ** 1.5 * 0.05 * overlength * path
    settle = np.where(step > 2000, 0.8 + 0.2 * np.exp(-(step - 2000) / 400), 1.0)
    return {
        "history_step": step,
        "history_height": height,
        "history_reaction_force": 400 * np.sin(np.pi * path) + 60 * path * settle,
        "history_membrane_energy": 0.35 * energy * settle,
        "history_bending_energy": 0.6 * energy * settle,
        "history_stabilisation_energy": 0.05 * energy * settle,
        "history_kinetic_energy": 1e-2 * energy * np.exp(-np.maximum(step - 1000, 0) / 250),
        "history_residual": np.where(step > 2000, 10 ** (-(step - 2000) / 700.0), np.nan),
    }
