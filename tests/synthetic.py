"""Synthetic cubes and crumples with known answers, for the tests of statistics and figures.

Nothing here is physics: the stiffness follows a prescribed power law with prescribed scatter,
and the crumple is an analytic wavy cylinder.
"""

from __future__ import annotations

import netCDF4
import numpy as np
import xarray as xr

DIRECTIONS = ["axial", "radial"]
DEFINITIONS = ["transfer", "driving", "relative"]
LAW = {"axial": (3.6, -0.9, 1.35), "radial": (3.1, -0.5, 1.45)}
EXPONENT = -2.2
MODES_PER_HZ = 0.3
GAP_HEIGHT_MM = 130.0
DIAMETER_MM = 200.0


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
    failed=(),
    rng_seed=1,
    relaxed_again=False,
):
    """A cube that obeys `LAW` and `EXPONENT`, with scatter `cv`, and `failed` cells (i, j, s).

    From the first eigenfrequency on there are `MODES_PER_HZ`.

    Pre-stressed values after relaxing again on refined meshes are there when asked for.
    """
    rng = np.random.default_rng(rng_seed)
    t = np.asarray(thickness_um, float)
    h = np.asarray(reference_height_mm, float)
    o = 100 * (h - GAP_HEIGHT_MM) / GAP_HEIGHT_MM
    f = np.geomspace(1, 800, 60)
    shape = (t.size, o.size, seeds)
    static = np.empty((*shape, 2))
    for d, direction in enumerate(DIRECTIONS):
        alpha, beta, gamma = LAW[direction]
        for i, j in np.ndindex(shape[:2]):
            mean = np.exp(alpha + beta * np.log(o[j]) + gamma * np.log(t[i]))
            static[i, j, :, d] = mean * exact_scatter(rng, seeds, cv(o[j], direction))
    f1 = 2e5 * t[:, None, None] ** 0.6 * h[None, :, None] ** EXPONENT
    f1 = f1 * (1 + 0.03 * rng.standard_normal(shape) * (cv(50.0, "axial") > 0))
    cylinder = 2.4e3 * t[:, None, None] * np.array([1.0, 0.16]) * (130 / h)[None, :, None]

    ratio = f / f1[..., None]
    resonance = np.abs(1 - ratio**2 + 0.1j * ratio)
    magnitude = static[..., None] * resonance[..., None, :] ** 0.7
    scale = np.array([1.0, 1.1, 0.9])
    dynamic = magnitude[:, :, :, None] * scale[:, None, None]

    count = np.maximum(0, np.floor(MODES_PER_HZ * (f - f1[..., None]) + 1))

    status = np.full(shape, "converged", dtype=object)
    message = np.full(shape, "", dtype=object)
    if seeds > 1:
        status[..., 1] = "not_converged"
    energy = 5e-3 * (t[:, None, None] / 50) ** 1.5 * o[None, :, None] * np.ones(shape)
    cells = {
        "first_eigenfrequency": (f1, "Hz"),
        "membrane_energy": (0.3 * energy, "J"),
        "bending_energy": (0.6 * energy, "J"),
        "stabilisation_energy": (energy * 2 / (t[:, None, None] ** 0.75), "J"),
    }
    cell_dims = ("thickness", "overlength", "seed")
    for i, j, s in failed:
        status[i, j, s] = "failed"
        message[i, j, s] = "the ring force is not finite at step 12: lower mesh.element_size_mm"
        static[i, j, s] = np.nan
        dynamic[i, j, s] = count[i, j, s] = np.nan
        for values, _ in cells.values():
            values[i, j, s] = np.nan

    def variable(dims, values, units, name):
        return xr.Variable(dims, values, {"units": units, "long_name": name.replace("_", " ")})

    data = {name: variable(cell_dims, v, u, name) for name, (v, u) in cells.items()}
    directed = (*cell_dims, "direction")
    data["static_stiffness"] = variable(directed, static, "N/m", "static_stiffness")
    refinement = (t / 500)[:, None, None, None] ** 0.3
    # The stress takes more from thick foils: its law has a smaller thickness exponent.
    stressed = 0.5 * (t / 50)[:, None, None, None] ** -0.2 * static
    relaxed = {
        "prestressed_stiffness_converged": 0.7 * stressed,
        "prestressed_stiffness_mesh_error": 0.3 * stressed,
    }
    for name, values in {
        "static_stiffness_free": 0.8 * static,
        "prestressed_stiffness": stressed,
        **(relaxed if relaxed_again else {}),
        "static_stiffness_converged": refinement * static,
        "static_stiffness_mesh_error": (1 - refinement) * static,
    }.items():
        data[name] = variable(directed, values, "N/m", name)
    data["cylinder_stiffness"] = variable(
        ("thickness", "overlength", "direction"), cylinder, "N/m", "cylinder_stiffness"
    )
    dynamic_dims = (*cell_dims, "definition", "direction", "frequency")
    data["dynamic_stiffness_re"] = variable(dynamic_dims, 0.8 * dynamic, "N/m", "dynamic re")
    data["dynamic_stiffness_im"] = variable(dynamic_dims, 0.6 * dynamic, "N/m", "dynamic im")
    data["mode_count"] = variable((*cell_dims, "frequency"), count, "1", "mode_count")
    data["status"] = variable(cell_dims, status, "1", "status")
    data["message"] = variable(cell_dims, message, "1", "message")
    return xr.Dataset(
        data,
        coords={
            "thickness": ("thickness", t, {"units": "um"}),
            "overlength": ("overlength", o, {"units": "%"}),
            "reference_height": ("overlength", h, {"units": "mm"}),
            "seed": np.arange(seeds),
            "direction": DIRECTIONS,
            "definition": DEFINITIONS,
            "frequency": ("frequency", f, {"units": "Hz"}),
        },
    )


def write_crumple(
    path, thickness_um, reference_height_mm, seed, status="converged", element_mm=5.0
):
    """Write a crumple.nc with an analytic wavy surface, or a failed one without arrays."""
    rng = np.random.default_rng([seed, int(thickness_um), int(reference_height_mm)])
    overlength = 100 * (reference_height_mm - GAP_HEIGHT_MM) / GAP_HEIGHT_MM
    with netCDF4.Dataset(path, "w") as file:
        file.setncatts(
            {
                "status": status,
                "message": "" if status == "converged" else "the ring force is not finite",
                "thickness_um": float(thickness_um),
                "overlength_percent": overlength,
                "reference_height_mm": float(reference_height_mm),
                "seed": seed,
            }
        )
        if status in ("failed", "diverged"):
            return path
        _write_shape(file, rng, thickness_um, overlength, reference_height_mm, element_mm)
        _write_history(file, overlength, reference_height_mm, thickness_um)
    return path


def write_response(crumple_path, shapes=None, first_hz=50.0):
    """Write the response.nc beside a crumple, with mode shapes (mode, 3, rows, columns) or none."""
    path = crumple_path.with_name("response.nc")
    with netCDF4.Dataset(path, "w") as file:
        file.setncatts({"status": "converged", "message": ""})
        if shapes is None:
            return path
        for name, size in zip(("shape_mode", "component", "node_row", "node_column"), shapes.shape):
            file.createDimension(name, size)
        variable = file.createVariable("mode_shape", "f4", tuple(file.dimensions))
        variable[:] = shapes
        file.createDimension("mode", 20)
        frequencies = np.full(20, np.nan)
        frequencies[: len(shapes)] = first_hz + 10.0 * np.arange(len(shapes))
        file.createVariable("eigenfrequency", "f8", ("mode",))[:] = frequencies
    return path


def _write_shape(file, rng, thickness_um, overlength, reference_height_mm, element):
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

    def put(name, dims, values, units):
        variable = file.createVariable(name, "f8", dims)
        variable.units, variable.long_name = units, name.replace("_", " ")
        variable[:] = values

    file.createDimension("component", 3)
    file.createDimension("row", rows)
    file.createDimension("column", columns)
    points = np.stack([r * np.cos(T), r * np.sin(T), Z * GAP_HEIGHT_MM]) * 1e-3
    reference = np.stack([r0 * np.cos(T), r0 * np.sin(T), Z * reference_height_mm]) * 1e-3
    put("control_points", ("component", "row", "column"), points, "m")
    put("reference_control_points", ("component", "row", "column"), reference, "m")


def _write_history(file, overlength, reference_height_mm, thickness_um):
    step = np.arange(0, 6001, 20)
    tau = np.clip(step / 2000, 0, 1)
    path = 10 * tau**3 - 15 * tau**4 + 6 * tau**5
    height = (reference_height_mm + (GAP_HEIGHT_MM - reference_height_mm) * path) * 1e-3
    energy = (thickness_um / 500) ** 1.5 * 0.05 * overlength * path
    settle = np.where(step > 2000, 0.8 + 0.2 * np.exp(-(step - 2000) / 400), 1.0)
    columns = {
        "step": (step, "1"),
        "height": (height, "m"),
        "reaction_force": (400 * np.sin(np.pi * path) + 60 * path * settle, "N"),
        "membrane_energy": (0.35 * energy * settle, "J"),
        "bending_energy": (0.6 * energy * settle, "J"),
        "stabilisation_energy": (0.05 * energy * settle, "J"),
        "kinetic_energy": (1e-2 * energy * np.exp(-np.maximum(step - 1000, 0) / 250), "J"),
        "residual": (np.where(step > 2000, 10 ** (-(step - 2000) / 700.0), np.nan), "1"),
    }
    file.createDimension("history", step.size)
    for name, (values, units) in columns.items():
        variable = file.createVariable(f"history_{name}", "f8", ("history",))
        variable.units, variable.long_name = units, name.replace("_", " ")
        variable[:] = values
