"""Blocks of what realisations are and took: dynamics, shapes, steps, costs."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from foilstudy.base.reference import published
from foilstudy.present.configuration import configuration
from foilstudy.present.ramp import ramp_steps
from page_blocks.study import DIRECTIONS, Study, displacement, rows


def dynamics(study: Study) -> Iterator[str]:
    """Start, first rise and spread of the relative dynamic stiffness, geometric over seeds."""
    relative = np.abs(study.cube["dynamic_stiffness"].sel(definition="relative"))
    frequency, static = study.cube["frequency"], study.cube["static_stiffness"]
    start = np.abs(relative.isel(frequency=0) / static - 1)
    yield (
        f"- *Equal to the static one at low frequency*: at {float(frequency[0]):g} Hz within "
        f"{100 * float(start.max()):.2f} % in all {int(np.isfinite(start[..., 0]).sum())}."
    )
    thick = np.exp(np.log(relative.sel(thickness=study.thickest)).mean("seed"))
    for direction in DIRECTIONS:
        curves = thick.sel(direction=direction)
        risen = curves > 1.5 * curves.isel(frequency=0)
        first = [
            f"{frequency.values[at.argmax()]:.0f}"
            if (at := risen.isel(overlength=k).values).any()
            else "no"
            for k in range(study.overlengths.size)
        ]
        yield (
            f"- *Rises from the first resonance on*: at {study.thickest} µm the {direction} "
            f"magnitude passes 1.5 times its value at {float(frequency[0]):g} Hz at "
            f"{', '.join(first)} Hz (overlength {study.overlengths[0]:.2g} "
            f"to {study.overlengths[-1]:.2g} %)."
        )
    bands = ((0, 1.01), (200, 400), (400, 800))
    for direction in DIRECTIONS:
        spreads = []
        for low, high in bands:
            band = thick.sel(direction=direction, frequency=slice(max(low, 0.99), high))
            level = np.exp(np.log(band).mean("frequency"))
            spreads.append(f"{float(level.max() / level.min()):.2g}")
        yield (
            "- *Overlengths converge at high frequency*: largest over smallest of all overlengths, "
            f"{study.thickest} µm, {direction}, at 1 Hz, over 200 to 400 and over 400 to 800 Hz: "
            f"{', '.join(spreads)}."
        )


def eigenfrequency(study: Study) -> Iterator[str]:
    """First eigenfrequencies and their exponents."""
    first, table = (
        study.cube["first_eigenfrequency"].mean("seed"),
        study.table("eigenfrequency_law"),
    )
    table = table.set_index("thickness_um")
    heights = ", ".join(f"{h / 1e3:g}" for h in study.cube["reference_height"].values)
    mean = [", ".join(f"{f:.0f}" for f in first.sel(thickness=t).values) for t in study.thicknesses]
    ours, theirs = [], []
    for thickness in study.thicknesses:
        row = table.loc[thickness]
        ours.append(
            f"{row['exponent']:.2f} [{row['exponent_low']:.2f}, {row['exponent_high']:.2f}]"
        )
        known = np.isfinite(row["published_exponent"])
        theirs.append(f"{row['published_exponent']:.2f}" if known else "")
    yield from rows(
        ["", *(f"{t} µm" for t in study.thicknesses)],
        [[f"mean at {heights} m, Hz", *mean], ["exponent", *ours], ["published", *theirs]],
    )


def shapes(study: Study) -> Iterator[str]:
    """Extremes of the radial displacement, energies, crossings and yielding."""
    cube = study.cube
    low, high = displacement(study)
    their_low, their_high = published().radial_displacement_range_mm
    yield (
        f"- radial displacement over all {cube['status'].size}: {low:.1f} to {high:.1f} mm "
        f"(published {their_low:g} to {their_high:g} mm)"
    )
    energy = cube["membrane_energy"] + cube["bending_energy"] + cube["stabilisation_energy"]
    mean = ", ".join(f"{e:.3g}" for e in energy.sel(thickness=study.thickest).mean("seed").values)
    yield f"- mean strain energy at {study.thickest} µm, in the order of overlength: {mean} J"
    crossing = (cube["self_crossing_share"] > 0).sum(("thickness", "seed")).values
    cells = cube.sizes["thickness"] * cube.sizes["seed"]
    yield (
        f"- realisations that cross themselves: {crossing[-1]} of {cells} at "
        f"{study.overlengths[-1]:.0f} % overlength, {crossing[:-1].sum()} of "
        f"{cells * (crossing.size - 1)} below"
    )
    share = cube["beyond_yield_share"].sel(thickness=study.thickest).mean("seed").values
    yield (
        f"- mean share of the surface beyond yield at {study.thickest} µm, in the order of "
        "overlength: "
        f"{', '.join(f'{100 * s:.0f}' for s in share)} %"
    )
    converged = int((cube["status"] == "converged").sum())
    worst = float(cube["equilibrium_residual"].max())
    unstable = int((cube["negative_eigenvalues"] > 0).sum())
    yield (
        f"- {converged} of {cube['status'].size} converged, residual at most {worst:.1e}, "
        f"{unstable} with a negative eigenvalue"
    )


def steps(study: Study) -> Iterator[str]:
    """Steps to the equilibrium, and what else it took."""
    cube, config = study.cube, configuration(study.cube)
    body = []
    for thickness in study.thicknesses:
        ramp = int(ramp_steps(config, thickness))
        here = cube["steps"].sel(thickness=thickness) - ramp
        polish = cube["newton_steps"].sel(thickness=thickness)
        body.append(
            [
                f"{thickness} µm",
                f"{ramp}",
                f"{float(here.median()):.0f}, {float(here.max()):.0f}",
                f"{float(polish.median()):g}, {float(polish.max()):g}",
                f"{float(cube['equilibrium_residual'].sel(thickness=thickness).max()):.1e}",
            ]
        )
    heads = [
        "",
        "steps of the ramp",
        "after it: median, most",
        "quasi-Newton steps",
        "residual: most",
    ]
    yield from rows(heads, body)


def costs(study: Study) -> Iterator[str]:
    """What a realisation took."""
    cube, parts = study.cube, {"crumple": "crumple", "static": "static", "dynamic": "dynamic"}
    medians = [f"{float(cube[f'seconds_{name}'].median()):.2g}" for name in parts]
    total = sum(float(cube[f"seconds_{name}"].sum()) for name in parts)
    yield (
        f"Crumple, static and dynamic stiffness took {medians[0]}, {medians[1]} and {medians[2]} "
        f"s a realisation (medians), {total / 60:.0f} minutes of one core in all, at most "
        f"{float(cube['peak_memory'].max()) / 1e3:.1f} GB a job ({cube.attrs['machine']})."
    )


def tradeoff(study: Study) -> Iterator[str]:
    """The tables of the charts of speed against accuracy."""
    yield from study.file("tradeoff.md").read_text("utf-8").splitlines()


def explanation(study: Study) -> Iterator[str]:
    """Laws of the models of the real foil, and the bounds."""
    yield from study.file("laws.md").read_text("utf-8").splitlines()


def accuracy(study: Study) -> Iterator[str]:
    """What the words of accuracy cost, and how far off they are."""
    yield from study.file("accuracy.md").read_text("utf-8").splitlines()


def influences(study: Study) -> Iterator[str]:
    """How far the true stiffness depends on the method."""
    yield from study.file("influences.md").read_text("utf-8").splitlines()
