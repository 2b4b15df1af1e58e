"""Random valid configurations, crumpled and measured; tells every failure and what took long.

    python benchmarks/random_configurations.py 500 [table.csv]

The table (`results/limits/random.csv` if left out) has a row for each, seeds 0, 1, 2, ...; what it
has already is not done again, so that a run may be stopped and gone on with.

Draws foils from the whole range of a study's configuration, extreme corners included: diameters of
1 to 10 000 mm, any thickness down to 0.1 um, soft and stiff, Poisson's ratios of -0.9 to 0.5, every
imperfection, element, reduction and damping. Meshes are coarse and ramps short; the band is laid
around the frequency at which sound crosses the foil in bending. Each runs in a process of its own,
so that one that dies in native code is told by its signal.
"""

from __future__ import annotations

import csv
import json
import multiprocessing
import os
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

CORNERS = {
    "diameter_mm": (1.0, 1.5, 5.0, 200.0, 10_000.0),
    "thickness_um": (0.1, 1.0, 50.0),
    "poisson_ratio": (-0.9, 0.0, 0.5),
    "youngs_modulus_mpa": (0.01, 650.0, 1e6),
}
SECONDS_MAX = 120
"""Of the processor; a run that takes ten times as long by the clock is ended."""
TABLE = Path(__file__).parents[1] / "results/limits/random.csv"
COLUMNS = (
    "seed",
    "crumple",
    "status",
    "verdicts",
    "problems",
    "diameter_mm",
    "thickness_um",
    "overlength_percent",
    "ramp_steps",
    "seconds",
    "message",
)
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
    from foilstudy.measure.verdicts import names_of
    from foilstudy.study.sweep.crumple import crumple_job
    from foilstudy.study.sweep.respond import respond_job

    study = load_config(content)
    (cell,) = study.cells()
    crumple_job(study.crumple_task(cell), folder / "crumple.nc")
    respond_job(study.response_task(cell), folder / "crumple.nc", folder / "response.nc")
    shape, crumpled = read_record(folder / "crumple.nc")
    values, attributes = read_record(folder / "response.nc")
    found = problems(values, attributes, content["dynamics"])
    found += astray(shape, crumpled["status"], content)
    slenderness = 1e3 * content["mesh"]["element_size_mm"] / content["sweep"]["thickness_um"][0]
    if _TRUE_OF_SLENDER in attributes["message"] and slenderness**2 > 1e11:
        found = []  # what it says is so: a double holds 16 digits, and bending needs five itself
    return {
        "crumple": crumpled["status"],
        "status": attributes["status"],
        "verdicts": " ".join(names_of(values["verdict"])),
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


_MAY_BE_UNKNOWN = ("negative_eigenvalues", "broad_wave_share", "calmer_half", "alternation")
"""Not counted before a relaxation settles, or not defined of a foil that is hardly displaced."""
_FAR = 1.5
"""Distance from the middle of the gap at which no foil is, over half the diagonal of the cylinder
that it was: a motion that has diverged."""


def astray(values: dict, status: str, content: dict) -> list[str]:
    """What is wrong of a shape that is said to be one."""
    if status not in ("converged", "not_converged"):
        return []
    found = [
        f"{name} is no number, unsaid"
        for name, value in values.items()
        if name not in _MAY_BE_UNKNOWN and not np.isfinite(value).all()
    ]
    gap = content["sheet"]["gap_height_mm"] * 1e-3
    (height,) = content["sweep"]["reference_height_mm"]
    half = 0.5e-3 * np.hypot(content["sheet"]["diameter_mm"], height)
    x, y, z = values["surface"]
    far = np.sqrt(x**2 + y**2 + (z - gap / 2) ** 2).max() / half
    if not far < _FAR:
        found.append(f"the foil is {far:.1e} times as far off as its cylinder was, unsaid")
    tolerance = 1e-8  # the default
    if status == "converged" and not values["equilibrium_residual"] <= tolerance:
        found.append(f"called converged at a residual of {values['equilibrium_residual']:.1e}")
    return found


def _run(content: dict, sender) -> None:
    with tempfile.TemporaryDirectory() as folder:
        try:
            sender.send(outcome(content, Path(folder)))
        except Exception as error:  # whatever a job lets through is what is looked for
            sender.send({"status": "exception", "problems": [f"{type(error).__name__}: {error}"]})


def judged(seed: int) -> dict:
    """The outcome of one draw, in a process of its own, with its processor time."""
    content = drawn(seed)
    receiver, sender = multiprocessing.Pipe(duplex=False)
    before = _children_seconds()
    process = multiprocessing.get_context("fork").Process(target=_run, args=(content, sender))
    process.start()
    sender.close()
    try:
        result = receiver.recv() if receiver.poll(10 * SECONDS_MAX) else {"problems": ["no end"]}
    except EOFError:
        result = {"problems": []}
    process.join(1)
    if process.is_alive():
        process.kill()
        process.join()
    elif process.exitcode:
        result["problems"].append(f"died with exit code {process.exitcode}")
    result["seconds"] = _children_seconds() - before
    if result["seconds"] > SECONDS_MAX:
        result["problems"].append(f"took {result['seconds']:.0f} s")
    return result | {"seed": seed, "content": content}


def _children_seconds() -> float:
    times = os.times()
    return times.children_user + times.children_system


def row_of(result: dict) -> dict:
    """What the table says of an outcome."""
    content = result["content"]
    gap, (height,) = content["sheet"]["gap_height_mm"], content["sweep"]["reference_height_mm"]
    return {
        **{name: result.get(name, "") for name in ("seed", "crumple", "status", "verdicts")},
        "problems": "; ".join(result["problems"]),
        "diameter_mm": f"{content['sheet']['diameter_mm']:.4g}",
        "thickness_um": f"{content['sweep']['thickness_um'][0]:.4g}",
        "overlength_percent": f"{100 * (height / gap - 1):.3g}",
        "ramp_steps": content["relaxation"]["ramp_steps"],
        "seconds": f"{result['seconds']:.1f}",
        "message": result.get("message", ""),
    }


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    path = Path(sys.argv[2]) if len(sys.argv) > 2 else TABLE
    import foilstudy.config
    import foilstudy.study.sweep.respond  # noqa: F401  loaded once, for all children

    done = set()
    if path.is_file():
        with path.open(newline="") as file:
            done = {int(row["seed"]) for row in csv.DictReader(file)}
    with path.open("a", newline="", buffering=1) as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        if not done:
            writer.writeheader()
        for seed in sorted(set(range(count)) - done):
            result = judged(seed)
            writer.writerow(row_of(result))
            if result["problems"]:
                print(
                    f"{seed}: {'; '.join(result['problems'])}\n   {json.dumps(result['content'])}"
                )
                sys.stdout.flush()
    print(_summary(path))


def _summary(path: Path) -> str:
    """Of all rows, in two sentences."""
    with path.open(newline="") as file:
        rows = list(csv.DictReader(file))
    ends = Counter(f"{row['crumple']}/{row['status']}" for row in rows)
    verdicts = Counter(name for row in rows for name in row["verdicts"].split())
    wrong = sum(bool(row["problems"]) for row in rows)
    longest = max(float(row["seconds"]) for row in rows)
    return (
        f"{len(rows)} drawn, {wrong} with problems, longest {longest:.1f} s: {dict(ends)}.\n"
        f"Verdicts: {dict(verdicts)}."
    )


if __name__ == "__main__":
    main()
