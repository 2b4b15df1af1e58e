"""Write the numbers of the studies into the pages: docs/page_numbers.py [--check].

    .venv/bin/python docs/page_numbers.py           the pages, of the studies below results/
    .venv/bin/python docs/page_numbers.py --check   only say whether they are as they should be

What stands between ``<!-- numbers: NAME of STUDY, STUDY -->`` and ``<!-- end -->`` is what the
function NAME below makes of cube and tables of these studies, folders of results/; a block that
names no study is of the one that it is called as. Everything else is left alone.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Container, Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import pandas as pd

from foilstudy import open_cube
from foilstudy.base.errors import Refusal
from foilstudy.base.reference import published
from foilstudy.present.comparison import studied_case
from foilstudy.present.configuration import configuration
from foilstudy.present.report.equilibrium import ramp_steps
from foilstudy.present.report.laws import SOURCES, DirectionLaws, Exponent, Law, read_laws
from foilstudy.present.statistics.cells import good, relative_mesh_error
from foilstudy.present.statistics.powerlaw import LIMIT, PLAIN, TRUSTED, powerlaw_table
from foilstudy.present.statistics.summary import best_mean, stiffness_summary
from foilstudy.present.statistics.trust import assess_trust
from foilstudy.study.registry import STUDIES

ROOT = Path(__file__).parents[1]
RESULTS = ROOT / "results"
PAGES = ("README.md", "docs/comparison.md", "docs/method.md", "docs/tradeoff.md")
BLOCK = re.compile(
    r"(?P<head><!-- numbers: (?P<name>\w+)(?: of (?P<studies>[\w, -]+?))? -->\n)"
    r"(?P<text>.*?)(?P<end><!-- end -->)",
    re.DOTALL,
)
DIRECTIONS = ("axial", "radial")
NAMES = {
    TRUSTED: "mesh limit, trusted",
    LIMIT: "mesh limit, all",
    PLAIN: "mesh of the crumple, all",
    "simulation pre-stressed": "pre-stressed, mesh of the crumple, all",
    "simulation pre-stressed refined": "pre-stressed, relaxed again, all",
}
"""Sources of a law of a study."""


@dataclass(frozen=True)
class Study:
    """Cube and tables of a study.

    Attributes
    ----------
    folder : Path
        Named as its configuration is.
    """

    folder: Path

    def file(self, name: str) -> Path:
        """A file of the study.

        Raises
        ------
        Refusal
            If the study has not been made, naming the command that makes it.
        """
        path = self.folder / name
        if not path.exists():
            study = self.folder.name
            command = f"make study CONFIG=config/{study}.yaml"
            if study in STUDIES:
                command = f".venv/bin/snakemake -j1 {study}"
            raise Refusal(f"results/{study}/{name} is missing; `{command}` makes it.")
        return path

    @cached_property
    def cube(self):
        """The cube."""
        return open_cube(self.file("cube.nc"))

    def table(self, name: str) -> pd.DataFrame:
        """A table by its name."""
        return pd.read_csv(self.file(f"{name}.csv"))

    @property
    def laws(self) -> tuple[DirectionLaws, ...]:
        """Its power laws."""
        case = studied_case(self.cube)
        scale = case.diameter_mm / 2, case.youngs_modulus_mpa
        return read_laws(self.table("powerlaw"), self.table("stiffness_summary"), scale)

    def laws_from(self, thicknesses: list[int]) -> tuple[DirectionLaws, ...]:
        """Its power laws, were these thicknesses (um) all."""
        part = self.cube.sel(thickness=thicknesses)
        return read_laws(powerlaw_table(part), stiffness_summary(part))

    @property
    def mesh(self) -> str:
        """What it was crumpled on."""
        section = configuration(self.cube)["mesh"]
        if section["element_size_mm"] == "auto":
            return f"resolved to {section['energy_error_percent']:g} %"
        return f"{section['element_size_mm']:g} mm"

    @property
    def thicknesses(self) -> list[int]:
        """Of the sweep, um."""
        return [int(value) for value in self.cube["thickness"].values]

    @property
    def thickest(self) -> int:
        """Of the sweep, um."""
        return max(self.thicknesses)

    @property
    def overlengths(self) -> np.ndarray:
        """Of the sweep, %."""
        return self.cube["overlength"].values


def block(name: str, *studies: Study) -> str:
    """The text of a block, ending with a line break."""
    return "\n".join(BLOCKS[name](*studies)) + "\n"


def rows(head: list[str], body: list[list[str]]) -> Iterator[str]:
    """A table in Markdown."""
    yield f"| {' | '.join(head)} |"
    yield "|" + "---|" * len(head)
    yield from (f"| {' | '.join(row)} |" for row in body)


def headline(*studies: Study) -> Iterator[str]:
    """The law of the first study, those of the others and the published ones beside it."""
    yield from _laws(studies, (TRUSTED, LIMIT))


def law(*studies: Study) -> Iterator[str]:
    """Every law of the studies and the published ones, with their 95 % intervals."""
    yield from _laws(studies, SOURCES)


def _laws(studies: tuple[Study, ...], sources: Container[str]) -> Iterator[str]:
    """Coefficients of laws of some sources; that of the first study which answers is bold."""
    first, *others = studies
    body = []
    for k, direction in enumerate(first.laws):
        listed = [
            (f"{study.mesh}, {NAMES[each.source]}", each)
            for study in studies
            for each in study.laws[k].laws
            if each.source in NAMES and each.source in sources
        ]
        if direction.answer:
            listed[0] = f"**{listed[0][0]}**", listed[0][1]
        listed += _same_thicknesses(first, others, k)
        listed += [
            (each.source, each) for each in direction.laws if each.source.startswith("published")
        ]
        body += [_law_row(direction.direction, *each) for each in listed]
    heads = ["", "law", "α", "β, overlength", "γ, thickness", "R²", "n"]
    yield from rows(heads, body)


def _same_thicknesses(first: Study, others: list[Study], k: int) -> Iterator[tuple[str, Law]]:
    """Laws of other studies over the thicknesses that the first one has, where they have more."""
    for study in others:
        shared = [t for t in study.thicknesses if t in first.thicknesses]
        if 1 < len(shared) < len(study.thicknesses):
            limit = study.laws_from(shared)[k].law(LIMIT)
            if limit is not None:
                yield f"{study.mesh}, mesh limit, {_list(shared)} µm", limit


def _law_row(direction: str, words: str, each: Law) -> list[str]:
    coefficients = [_coefficient(c) for c in (each.alpha, each.beta, each.gamma)]
    count = f"{each.n:.0f}" if np.isfinite(each.n) else ""
    return [direction, words, *coefficients, f"{each.r2:.3f}", count]


def differences(study: Study) -> Iterator[str]:
    """How each published law differs from the one that answers."""
    for direction in study.laws:
        for each in direction.laws:
            if each.source.startswith("published"):
                words = each.differences or "not compared, as no configuration is trusted"
                yield f"- {direction.direction}, {each.source}: {words}"


def dimensionless(study: Study) -> Iterator[str]:
    """The laws that answer without units."""
    case = studied_case(study.cube)
    slender = case.gap_height_mm / case.diameter_mm
    for direction in study.laws:
        one = direction.dimensionless
        if one is None:
            yield f"- {direction.direction}: no law, as no configuration is trusted"
            continue
        yield (
            f"- {direction.direction}: k/(E t) = {one.constant:.2f} · (overlength/gap)^"
            f"{one.beta:.2f} · (t/R)^{one.gamma:.2f}, at a gap of {slender:.2f} diameters"
        )


def beside(first: Study, second: Study) -> Iterator[str]:
    """Means of the first study over those of the second, with the interval of the ratio."""
    keys = ["direction", "thickness_um", "reference_height_mm"]
    shared = _means(first).merge(_means(second), on=keys, suffixes=("_a", "_b"))
    heights = shared["reference_height_mm"].unique()
    names = shared.drop_duplicates("reference_height_mm")["overlength_percent_a"]
    body = []
    for (direction, thickness), some in shared.groupby(["direction", "thickness_um"]):
        cells = some.set_index("reference_height_mm").reindex(heights)
        ratios = (_ratio(cell) for _, cell in cells.iterrows())
        body.append([f"{direction} {thickness:.0f} µm", *ratios])
    yield from rows(["", *(f"{value:.2g} %" for value in names)], body)


def _means(study: Study) -> pd.DataFrame:
    summary = study.table("stiffness_summary")
    names = ["direction", "thickness_um", "reference_height_mm", "overlength_percent"]
    return summary[[*names, "best_low", "best_high"]].assign(mean=best_mean(summary))


def _ratio(cell: pd.Series) -> str:
    """A ratio of means; its interval recovers the variances of their logarithms from theirs."""
    mean, low, high = (
        np.log([cell[f"{name}_{side}"] for side in "ab"])
        for name in ("mean", "best_low", "best_high")
    )
    below, above = mean - low, high - mean
    middle = mean[0] - mean[1]
    ends = middle - np.hypot(below[0], above[1]), middle + np.hypot(above[0], below[1])
    return f"{_short(np.exp(middle))} [{', '.join(_short(np.exp(end)) for end in ends)}]"


def _coefficient(coefficient: Exponent) -> str:
    return f"{coefficient.value:.2f}{coefficient.margin}".replace("−", "-")


def summary(*studies: Study) -> Iterator[str]:
    """What was published in a number, and ours."""
    theirs = published()
    laws = [theirs.power_laws[direction]["simulation"] for direction in DIRECTIONS]
    lines = {
        f"power law of the simulation, R² {_pair([each.r2 for each in laws], '.3f')}": _fits,
        f"its exponent of the overlength {_pair([each.beta.value for each in laws])}": (
            lambda study: _answers(study, "beta")
        ),
        f"its exponent of the thickness {_pair([each.gamma.value for each in laws])}": (
            lambda study: _answers(study, "gamma")
        ),
        "axial softer than radial": _softer,
        "axial scatters more": _scatter,
        "radial displacement {:g} to {:g} mm".format(*theirs.radial_displacement_range_mm): (
            lambda study: "{:.0f} to {:.0f} mm".format(*_displacement(study))
        ),
    }
    body = [[words, *map(value, studies)] for words, value in lines.items()]
    yield from rows(["published (axial, radial)", *(study.mesh for study in studies)], body)


def _pair(values: list[float], form: str = ".2f") -> str:
    return ", ".join(f"{value:{form}}" for value in values)


def _fits(study: Study) -> str:
    return _pair([direction.best.r2 for direction in study.laws], ".3f")


def _answers(study: Study, name: str) -> str:
    return ", ".join(_coefficient(getattr(direction.best, name)) for direction in study.laws)


def _softer(study: Study) -> str:
    mean = good(study.cube, "static_stiffness_converged").mean("seed")
    axial, radial = (mean.sel(direction=direction) for direction in DIRECTIONS)
    return f"in {int((axial < radial).sum())} of {axial.size} configurations"


def _scatter(study: Study) -> str:
    table = study.table("variability")
    cv = table[table["quantity"] == "static_stiffness"].groupby("direction")["cv"].median()
    medians = " against ".join(f"{100 * cv[direction]:.2g} %" for direction in DIRECTIONS)
    return f"median coefficient of variation {medians}"


def _displacement(study: Study) -> tuple[float, float]:
    low, high = (study.cube[f"radial_displacement_{end}"] for end in ("min", "max"))
    return float(low.min()), float(high.max())


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
        f"No crumple ({study.mesh}) exceeds {' or '.join(words)} of the stiffness of the "
        "uncrumpled cylinder of the same foil and height."
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
    thick = np.exp(np.log(relative.sel(thickness=study.thickest)).mean("seed"))
    for direction in DIRECTIONS:
        curves = thick.sel(direction=direction)
        risen = curves > 1.5 * curves.isel(frequency=0)
        first = (
            frequency.values[int(np.argmax(risen.isel(overlength=k).values))]
            for k in range(study.overlengths.size)
        )
        yield (
            f"- *Rises from the first resonance on*: at {study.thickest} µm the {direction} "
            "magnitude passes 1.5 times its value at 1 Hz at "
            f"{', '.join(f'{f:.0f}' for f in first)} Hz (overlength {study.overlengths[0]:.2g} "
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
    low, high = _displacement(study)
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


def _list(values: list[int]) -> str:
    return ", ".join(map(str, values))


BLOCKS = {
    each.__name__: each
    for each in (
        headline, law, differences, dimensionless, beside, summary, trust, simulation,
        experiment, prestress, bound, variability, dynamics, eigenfrequency, shapes, steps, costs,
        tradeoff,
    )
}  # fmt: skip


def written(text: str, results: Path) -> str:
    """A page with its blocks made anew of the studies below a folder."""
    studies: dict[str, Study] = {}

    def remade(found: re.Match[str]) -> str:
        names = (found["studies"] or found["name"]).split(",")
        named = [studies.setdefault(n, Study(results / n)) for n in map(str.strip, names)]
        return found["head"] + block(found["name"], *named) + found["end"]

    return BLOCK.sub(remade, text)


def main() -> None:
    """Write the pages, or say which differ, and what is missing for which."""
    only_check, differ, missing = "--check" in sys.argv[1:], [], []
    for name in PAGES:
        path = ROOT / name
        before = path.read_text("utf-8")
        try:
            after = written(before, RESULTS)
        except Refusal as refusal:
            missing.append(f"{name} is left as it is: {refusal}")
            continue
        if before != after:
            differ.append(name)
            if not only_check:
                path.write_text(after, "utf-8")
    if differ:
        print(f"{'differs' if only_check else 'wrote'}: {', '.join(differ)}")
    for sentence in missing:
        print(sentence, file=sys.stderr)
    sys.exit(bool(missing or (differ and only_check)))


if __name__ == "__main__":
    main()
