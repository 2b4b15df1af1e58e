"""Write the numbers of the published study into the pages: docs/page_numbers.py [--check].

    .venv/bin/python docs/page_numbers.py           the pages, of results/thesis
    .venv/bin/python docs/page_numbers.py --check   only say whether they are as they should be

What stands between ``<!-- numbers: NAME -->`` and ``<!-- end -->`` is what the function NAME below
makes of cube and tables; everything else is left alone.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

import numpy as np
import pandas as pd

from foilstudy import open_cube
from foilstudy.base.reference import published
from foilstudy.present.comparison import studied_case
from foilstudy.present.configuration import configuration
from foilstudy.present.report.laws import Exponent, read_laws
from foilstudy.present.statistics.cells import good, relative_mesh_error
from foilstudy.present.statistics.powerlaw import LIMIT, PLAIN, TRUSTED
from foilstudy.present.statistics.trust import assess_trust

ROOT = Path(__file__).parents[1]
PAGES = ("README.md", "docs/comparison.md", "docs/method.md", "docs/tradeoff.md")
BLOCK = re.compile(r"(<!-- numbers: (\w+) -->\n)(.*?)(<!-- end -->)", re.DOTALL)
DIRECTIONS = ("axial", "radial")
PRESTRESSED = "simulation pre-stressed"
NAMES = {
    TRUSTED: "**mesh limit, trusted**",
    LIMIT: "mesh limit, all",
    PLAIN: "5 mm mesh, all",
    PRESTRESSED: "pre-stressed, 5 mm, all",
    "published simulation": "published simulation",
    "published experiment": "published experiment",
}


class Study:
    """Cube and tables of the published study."""

    def __init__(self, folder: Path = ROOT / "results/thesis") -> None:
        self.folder = folder

    @cached_property
    def cube(self):
        """The cube."""
        return open_cube(self.folder / "cube.nc")

    def table(self, name: str) -> pd.DataFrame:
        """A table by its name."""
        return pd.read_csv(self.folder / f"{name}.csv")

    @property
    def thicknesses(self) -> list[int]:
        """Of the sweep, um."""
        return [int(value) for value in self.cube["thickness"].values]

    @property
    def overlengths(self) -> np.ndarray:
        """Of the sweep, %."""
        return self.cube["overlength"].values


def block(name: str, study: Study) -> str:
    """The text of a block, ending with a line break."""
    return "\n".join(BLOCKS[name](study)) + "\n"


def rows(head: list[str], body: list[list[str]]) -> Iterator[str]:
    """A table in Markdown."""
    yield f"| {' | '.join(head)} |"
    yield "|" + "---|" * len(head)
    yield from (f"| {' | '.join(row)} |" for row in body)


def law(study: Study) -> Iterator[str]:
    """Coefficients of every law with their 95 % intervals."""
    body = []
    for direction in read_laws(study.table("powerlaw"), study.table("stiffness_summary")):
        for each in direction.laws:
            coefficients = [_coefficient(c) for c in (each.alpha, each.beta, each.gamma)]
            count = f"{each.n:.0f}" if np.isfinite(each.n) else ""
            name = f"{direction.direction}, {NAMES[each.source]}"
            body.append([name, *coefficients, f"{each.r2:.3f}", count])
    yield from rows(["", "α", "β, overlength", "γ, thickness", "R²", "n"], body)


def dimensionless(study: Study) -> Iterator[str]:
    """The trusted laws without units."""
    case = studied_case(study.cube)
    radius, modulus = case.diameter_mm / 2, case.youngs_modulus_mpa
    for direction in read_laws(study.table("powerlaw"), study.table("stiffness_summary")):
        one = direction.law(TRUSTED).law.dimensionless(radius, modulus)
        slender = case.gap_height_mm / case.diameter_mm
        yield (
            f"- {direction.direction}: k/(E t) = {one.constant:.2f} · (overlength/gap)^"
            f"{one.beta:.2f} · (t/R)^{one.gamma:.2f}, at a gap of {slender:.2f} diameters"
        )


def _coefficient(coefficient: Exponent) -> str:
    return f"{coefficient.value:.2f}{coefficient.margin}".replace("−", "-")


def trust(study: Study) -> Iterator[str]:
    """What is trusted, and how large the stated mesh error is at most."""
    verdict, error = assess_trust(study.cube), relative_mesh_error(study.cube)
    trusted = verdict.trusted.all("direction")
    largest = error.max(("overlength", "seed", "direction"))
    slenderness = verdict.slenderness.max("overlength")
    folds = [_ends(row) for row in verdict.fold_angle.values]
    yield from rows(
        ["", *(f"{t} µm" for t in study.thicknesses)],
        [
            [
                "element over √(R t) (folds need 1 at most)",
                *(f"{s:.2f}" for s in slenderness.values),
            ],
            ["sharpest folds, degrees an element (60 at most)", *folds],
            ["largest stated mesh error of a value", *(f"{100 * e:.2g} %" for e in largest.values)],
            [
                "overlengths of which the stiffness is trusted",
                *(f"{int(t.sum())} of {t.size}" for t in trusted.values),
            ],
        ],
    )


def _ends(values: np.ndarray) -> str:
    return f"{values.min():.0f} to {values.max():.0f}"


def means(study: Study) -> Iterator[str]:
    """Mean stiffness over the seeds in the mesh limit."""
    limit = good(study.cube, "static_stiffness_converged").mean("seed")
    yield from _by_overlength(study, lambda d, t: [_short(v) for v in _row(limit, d, t)])


def simulation(study: Study) -> Iterator[str]:
    """Our means, on the crumpled mesh and in the mesh limit, over the published simulation."""
    plain = good(study.cube, "static_stiffness").mean("seed")
    limit = good(study.cube, "static_stiffness_converged").mean("seed")
    yield from _over_published(study, "simulation", (plain, limit))


def experiment(study: Study) -> Iterator[str]:
    """Our mesh limit (mean) and pre-stressed values (median) over the published experiment."""
    limit = good(study.cube, "static_stiffness_converged").mean("seed")
    stressed = study.cube["prestressed_stiffness"].median("seed")
    yield from _over_published(study, "experiment", (limit, stressed))


def _over_published(study: Study, source: str, ours: tuple) -> Iterator[str]:
    """Values of ours, side by side, over a published fit."""

    def cells(direction: str, thickness: int) -> list[str]:
        fit = published().power_laws[direction][source].law
        theirs = fit.stiffness(study.overlengths, thickness)
        ratios = [_row(values, direction, thickness) / theirs for values in ours]
        return [", ".join(map(_short, each)) for each in zip(*ratios, strict=True)]

    yield from _by_overlength(study, cells)


def _row(values, direction: str, thickness: int) -> np.ndarray:
    return values.sel(direction=direction, thickness=thickness).values


def _by_overlength(study: Study, cells) -> Iterator[str]:
    heads = ["", *(f"{value:.2g} %" for value in study.overlengths)]
    body = [
        [f"{direction} {thickness} µm", *cells(direction, thickness)]
        for direction in DIRECTIONS
        for thickness in study.thicknesses
    ]
    yield from rows(heads, body)


def _short(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}"


def prestress(study: Study) -> Iterator[str]:
    """Medians of pre-stressed over stress-free stiffness."""
    stressed = study.cube["prestressed_stiffness"]
    for name, words in (
        ("static_stiffness", "of the stress-free value on the same mesh"),
        ("static_stiffness_converged", "of its mesh limit"),
    ):
        ratio = (stressed / good(study.cube, name)).median(("overlength", "seed"))
        for direction in DIRECTIONS:
            shares = ", ".join(f"{value:.2f}" for value in ratio.sel(direction=direction).values)
            yield f"- {direction}, {words}: {shares} ({_list(study.thicknesses)} µm)"
    negative = int((stressed <= 0).sum())
    yield f"- {negative} of {int(np.isfinite(stressed).sum())} values are negative"


def bound(study: Study) -> Iterator[str]:
    """The largest share of the uncrumpled cylinder's stiffness."""
    cylinder = study.cube["cylinder_stiffness"]
    share = good(study.cube, "static_stiffness_converged") / cylinder
    words = (f"{100 * float(share.sel(direction=d).max()):.0f} % ({d})" for d in DIRECTIONS)
    yield (
        f"No crumple of ours exceeds {' or '.join(words)} of the stiffness of the uncrumpled "
        "cylinder of the same foil and height."
    )


def variability(study: Study) -> Iterator[str]:
    """Coefficients of variation and their law."""
    table, fitted = study.table("variability"), study.table("variability_law")
    table = table[table["quantity"] == "static_stiffness"]
    fitted = fitted.set_index("direction")
    body = {
        "range, median": [],
        "slope per 10 % overlength, percentage points": [],
        "rank correlation with thickness": [],
    }
    for direction in DIRECTIONS:
        cv, one = 100 * table.loc[table["direction"] == direction, "cv"], fitted.loc[direction]
        slope = [1e3 * one[name] for name in ("slope", "slope_low", "slope_high")]
        first, second, third = body.values()
        first.append(f"{cv.min():.2g} to {cv.max():.2g} %, {cv.median():.2g} %")
        second.append(f"{slope[0]:.1f} [{slope[1]:.1f}, {slope[2]:.1f}]")
        rank = one["thickness_rank_correlation"], one["thickness_rank_correlation_p"]
        third.append(f"{rank[0]:.2f}, p = {rank[1]:.2g}")
    yield from rows(["", *DIRECTIONS], [[name, *cells] for name, cells in body.items()])


def dynamics(study: Study) -> Iterator[str]:
    """Start, first rise and spread of the relative dynamic stiffness, geometric over seeds."""
    relative = np.abs(study.cube["dynamic_stiffness"].sel(definition="relative"))
    frequency, static = study.cube["frequency"], study.cube["static_stiffness"]
    start = np.abs(relative.isel(frequency=0) / static - 1)
    yield (
        f"- *Equal to the static one at low frequency*: at {float(frequency[0]):g} Hz within "
        f"{100 * float(start.max()):.2f} % in all {int(np.isfinite(start[..., 0]).sum())}."
    )
    thick = np.exp(np.log(relative.sel(thickness=500)).mean("seed"))
    for direction in DIRECTIONS:
        curves = thick.sel(direction=direction)
        risen = curves > 1.5 * curves.isel(frequency=0)
        first = (
            frequency.values[int(np.argmax(risen.isel(overlength=k).values))] for k in range(5)
        )
        yield (
            f"- *Rises from the first resonance on*: at 500 µm the {direction} magnitude passes "
            f"1.5 times its value at 1 Hz at {', '.join(f'{f:.0f}' for f in first)} Hz (overlength "
            f"{study.overlengths[0]:.2g} to {study.overlengths[-1]:.2g} %)."
        )
    bands = ((0, 1.01), (200, 400), (400, 800))
    for direction in DIRECTIONS:
        spreads = []
        for low, high in bands:
            band = thick.sel(direction=direction, frequency=slice(max(low, 0.99), high))
            level = np.exp(np.log(band).mean("frequency"))
            spreads.append(f"{float(level.max() / level.min()):.2g}")
        yield (
            "- *Overlengths converge at high frequency*: largest over smallest of the five, "
            f"500 µm, {direction}, at 1 Hz, over 200 to 400 and over 400 to 800 Hz: "
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
    low = float(cube["radial_displacement_min"].min())
    high = float(cube["radial_displacement_max"].max())
    their_low, their_high = published().radial_displacement_range_mm
    yield (
        f"- radial displacement over all {cube['status'].size}: {low:.1f} to {high:.1f} mm "
        f"(published {their_low:g} to {their_high:g} mm)"
    )
    energy = cube["membrane_energy"] + cube["bending_energy"] + cube["stabilisation_energy"]
    mean = ", ".join(f"{e:.3g}" for e in energy.sel(thickness=500).mean("seed").values)
    yield f"- mean strain energy at 500 µm, in the order of overlength: {mean} J"
    crossing = (cube["self_crossing_share"] > 0).sum(("thickness", "seed")).values
    cells = cube.sizes["thickness"] * cube.sizes["seed"]
    yield (
        f"- realisations that cross themselves: {crossing[-1]} of {cells} at "
        f"{study.overlengths[-1]:.0f} % overlength, {crossing[:-1].sum()} of "
        f"{cells * (crossing.size - 1)} below"
    )
    share = cube["beyond_yield_share"].sel(thickness=500).mean("seed").values
    yield (
        "- mean share of the surface beyond yield at 500 µm, in the order of overlength: "
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
    cube, ramp = study.cube, int(configuration(study.cube)["relaxation"]["ramp_steps"])
    after, newton = cube["steps"] - ramp, cube["newton_steps"]
    body = []
    for thickness in study.thicknesses:
        here = after.sel(thickness=thickness)
        polish = newton.sel(thickness=thickness)
        body.append(
            [
                f"{thickness} µm",
                f"{float(here.median()):.0f}, {float(here.max()):.0f}",
                f"{float(polish.median()):g}, {float(polish.max()):g}",
                f"{float(cube['equilibrium_residual'].sel(thickness=thickness).max()):.1e}",
            ]
        )
    heads = ["", "steps after the ramp: median, most", "quasi-Newton steps", "residual: most"]
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
    """The tables of the charts of speed against accuracy, another study's."""
    yield from (ROOT / "results/tradeoff/tradeoff.md").read_text("utf-8").splitlines()


def _list(values: list[int]) -> str:
    return ", ".join(map(str, values))


BLOCKS = {
    each.__name__: each
    for each in (
        law, dimensionless, trust, means, simulation, experiment, prestress, bound, variability,
        dynamics, eigenfrequency, shapes, steps, costs, tradeoff,
    )
}  # fmt: skip


def written(text: str, study: Study) -> str:
    """A page with its blocks made anew."""
    return BLOCK.sub(lambda found: found[1] + block(found[2], study) + found[4], text)


def main() -> None:
    """Write the pages, or say which differ."""
    study, differ = Study(), []
    for name in PAGES:
        path = ROOT / name
        before = path.read_text("utf-8")
        after = written(before, study)
        if before != after:
            differ.append(name)
            if "--check" not in sys.argv[1:]:
                path.write_text(after, "utf-8")
    if differ:
        print(f"{'differs' if '--check' in sys.argv[1:] else 'wrote'}: {', '.join(differ)}")
    sys.exit(bool(differ) and "--check" in sys.argv[1:])


if __name__ == "__main__":
    main()
