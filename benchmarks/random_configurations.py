"""Random valid configurations, crumpled and measured; prints every failure and what took long.

    python benchmarks/random_configurations.py 100 [first]

Draws foils from the whole range of a study's configuration, extreme corners included: diameters of
1 to 10 000 mm, any thickness down to 0.1 um, soft and stiff, Poisson's ratios of -0.9 to 0.5, every
imperfection, element, reduction and damping. Meshes are coarse and ramps short; the band is laid
around the frequency at which sound crosses the foil in bending. Each runs in a process of its own,
so that one that dies in native code is told by its signal.
"""

from __future__ import annotations

import json
import multiprocessing
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

CORNERS = {
    "diameter_mm": (1.0, 1.5, 5.0, 200.0, 10_000.0),
    "thickness_um": (0.1, 1.0, 50.0),
    "poisson_ratio": (-0.9, 0.0, 0.5),
    "youngs_modulus_mpa": (0.01, 650.0, 1e6),
}
SECONDS_MAX = 120
_TRUE_OF_SLENDER = "too thin for its mesh"
_REDUCTIONS = ("rational_krylov", "rational_krylov", "hintz_herting", "craig_bampton", "guyan")


def drawn(seed: int) -> dict:
    """A valid configuration of one small cell."""
    rng = np.random.default_rng([7, seed])

    def pick(values):
        return values[rng.integers(len(values))]

    def spread(low, high):
        return float(f"{np.exp(rng.uniform(np.log(low), np.log(high))):.4g}")

    corner = rng.random() < 0.5
    diameter = pick(CORNERS["diameter_mm"]) if corner else spread(1, 10_000)
    thickest = min(1e3 * diameter / 2 / 20, 10_000.0)
    thickness = spread(max(0.1, 1e-6 * diameter), thickest)
    if corner:
        thickness = min(pick((*CORNERS["thickness_um"], thickest)), thickest)
    modulus = pick(CORNERS["youngs_modulus_mpa"]) if corner else spread(0.01, 2e6)
    poisson = pick(CORNERS["poisson_ratio"]) if corner else float(rng.uniform(-0.9, 0.5))
    density = spread(10, 20_000)
    gap = float(np.clip(diameter * rng.uniform(0.4, 1.2), 1, 10_000))
    height = min(gap * (1 + spread(1, 60) / 100), 10_000.0)
    if not height > gap:
        gap = height / 1.1
    around = int(rng.integers(24, 48))
    size = min(np.pi * diameter / around, height / 8.01, 1000.0)
    first = thickness * 1e-6 / (diameter * 1e-3) ** 2 * np.sqrt(modulus * 1e6 / density)
    highest = float(np.clip(first * spread(0.3, 30), 0.02, 1e6))
    kind = pick(("gaussian", "gaussian", "smoothed", "buckling_modes"))
    amplitude = spread(0.05, 2) * min(thickness, 0.1 * size * 1e3)
    imperfection = {"kind": kind, "amplitude_um": amplitude}
    if kind == "smoothed":
        imperfection["correlation_length_mm"] = 2 * size
    damping = pick(("modal", "structural", "rayleigh"))
    dynamics = {
        "reduction": pick(_REDUCTIONS),
        "shown_min_hz": max(0.01, highest / 10 ** rng.uniform(0.5, 3)),
        "shown_max_hz": highest,
        "frequencies": 12,
        "eigenfrequencies": 5,
        "mode_shapes": 2,
        "damping": damping,
        "tolerance": float(10 ** rng.uniform(-4, -1)),
    }
    if damping == "rayleigh":
        dynamics["rayleigh_hz"] = [highest / 10, highest]
    return {
        "sheet": {"diameter_mm": diameter, "gap_height_mm": gap},
        "material": {
            "name": "drawn",
            "youngs_modulus_mpa": modulus,
            "poisson_ratio": poisson,
            "density_kg_m3": density,
            "yield_stress_mpa": min(1e5, 0.02 * modulus),
        },
        "sweep": {
            "thickness_um": [thickness],
            "reference_height_mm": [height],
            "realisations": 1,
        },
        "imperfection": imperfection,
        "mesh": {"element_size_mm": size, "element": pick(("corner", "corner", "one_point"))},
        "relaxation": {
            "ramp_steps": int(pick((10, 100, 300))),
            "relaxation_steps_max": int(pick((0, 20, 2000, 4000))),
        },
        "stiffness": {"refinements": int(pick((0, 1)))},
        "dynamics": dynamics,
    }


def outcome(content: dict, folder: Path) -> dict:
    """Status, message and numbers of both jobs."""
    from foilstudy.base.record import read_record
    from foilstudy.config import load_config
    from foilstudy.study.sweep.crumple import crumple_job
    from foilstudy.study.sweep.respond import respond_job

    study = load_config(content)
    (cell,) = study.cells()
    crumple_job(study.crumple_task(cell), folder / "crumple.nc")
    respond_job(study.response_task(cell), folder / "crumple.nc", folder / "response.nc")
    _, crumpled = read_record(folder / "crumple.nc")
    values, attributes = read_record(folder / "response.nc")
    found = problems(values, attributes, content["dynamics"])
    slenderness = 1e3 * content["mesh"]["element_size_mm"] / content["sweep"]["thickness_um"][0]
    if _TRUE_OF_SLENDER in attributes["message"] and slenderness**2 > 1e12:
        found = []  # what it says is so: a double holds 16 digits
    return {
        "crumple": crumpled["status"],
        "status": attributes["status"],
        "message": attributes["message"],
        "problems": found,
    }


def problems(values: dict, attributes: dict, dynamics: dict) -> list[str]:
    """What is wrong of a response that says nothing of it."""
    if attributes["status"] not in ("converged", "not_converged"):
        return [] if attributes["status"] == "diverged" else [attributes["message"]]
    found = []
    static, dynamic = values["static_stiffness"], values["dynamic_stiffness_re"][0, :, 0]
    if not (np.isfinite(static).all() and np.isfinite(values["eigenfrequency"][0])):
        found.append("static stiffness or first eigenfrequency is no number, unsaid")
    valid = np.isfinite(values["dynamic_stiffness_re"][0, 0])
    if not valid.all() and "dynamic stiffness" not in attributes["message"]:
        found.append("dynamic stiffness is missing, unsaid")
    slow = values["frequency"][0] < 1e-3 * values["eigenfrequency"][0]
    if slow and valid[0] and dynamics["damping"] != "rayleigh":
        off = np.abs(dynamic / static - 1).max()
        if off > dynamics["tolerance"] + 1e-4:
            found.append(f"the first frequency is {off:.1e} off the static stiffness")
    return found


def _run(content: dict, sender) -> None:
    with tempfile.TemporaryDirectory() as folder:
        try:
            sender.send(outcome(content, Path(folder)))
        except Exception as error:  # whatever a job lets through is what is looked for
            sender.send({"status": "exception", "problems": [f"{type(error).__name__}: {error}"]})


def judged(seed: int) -> dict:
    """The outcome of one draw, in a process of its own, with its time."""
    content = drawn(seed)
    receiver, sender = multiprocessing.Pipe(duplex=False)
    start = time.perf_counter()
    process = multiprocessing.get_context("fork").Process(target=_run, args=(content, sender))
    process.start()
    sender.close()
    try:
        result = receiver.recv() if receiver.poll(2 * SECONDS_MAX) else {"problems": ["no end"]}
    except EOFError:
        result = {"problems": []}
    process.join(1)
    if process.is_alive():
        process.kill()
    elif process.exitcode:
        result["problems"].append(f"died with exit code {process.exitcode}")
    result["seconds"] = time.perf_counter() - start
    if result["seconds"] > SECONDS_MAX:
        result["problems"].append(f"took {result['seconds']:.0f} s")
    return result | {"seed": seed, "content": content}


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 0
    import foilstudy.config
    import foilstudy.study.sweep.respond  # noqa: F401  loaded once, for all children

    statuses, wrong, longest = {}, 0, 0.0
    for seed in range(first, first + count):
        result = judged(seed)
        key = f"{result.get('crumple')}/{result.get('status')}"
        statuses[key] = statuses.get(key, 0) + 1
        longest = max(longest, result["seconds"])
        if result["problems"]:
            wrong += 1
            print(f"{seed}: {'; '.join(result['problems'])}\n   {json.dumps(result['content'])}")
            sys.stdout.flush()
    print(f"{count} drawn, {wrong} with problems, longest {longest:.1f} s: {statuses}")


if __name__ == "__main__":
    main()
