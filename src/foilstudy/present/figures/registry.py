"""Which figures a study has, and what each needs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

from foilstudy.plot.save import PNG_DPI, save
from foilstudy.present.files import StudyFiles


@dataclass(frozen=True)
class FigureSpec:
    """One figure of the study.

    Attributes
    ----------
    title, caption : str
        Plain text; the caption says what bands and lines mean.
    module : str
        Module of this package whose ``draw`` makes the figure.
    needs : tuple of str
        Inputs of ``draw``, which are attributes of `StudyFiles`: ``cube``, ``crumple_paths``,
        ``response_paths``.
    options : mapping
        Further keyword arguments of ``draw``.
    png_dpi : int
        Dots per inch of the PNG.
    """

    title: str
    caption: str
    module: str
    needs: tuple[str, ...]
    options: Mapping[str, str] = field(default_factory=dict)
    png_dpi: int = PNG_DPI

    def draw(self, **inputs):
        """Return the figure; `inputs` are the ones listed in `needs`."""
        module = import_module(f"foilstudy.present.figures.{self.module}")
        return module.draw(**inputs, **self.options)


_STIFFNESS_CAPTION = (
    "{} stiffness of the stress-free crumpled shape, other ring motions held, against overlength; "
    "one panel per thickness. Squares with bar: mean in the mesh limit (same shapes at element "
    "size zero, on the finest mesh where it is not extrapolated) and the stated mesh error, open "
    "where it is not trusted; dots with band: mean, smallest and largest of the realisations on "
    "the mesh that was crumpled; diamonds with bar, where foil yields, touches, waits or "
    "weighs: the same of the foil as it stands; line: the law of the trusted configurations "
    "(± 95 %), dotted a fit to all where none is trusted; black and grey, for the published case "
    "alone: the published fits; light grey: the uncrumpled cylinder, an upper bound."
)

FIGURES: dict[str, FigureSpec] = {
    "morphology": FigureSpec(
        "Crumpled shapes",
        "First realisation of every configuration, all to one scale, seen from slightly above. "
        "Colour: radial displacement from the cylinder, up to 24 % of the radius.",
        "morphology",
        ("crumple_paths",),
        png_dpi=100,  # shaded pictures are large
    ),
    "stiffness_axial": FigureSpec(
        "Axial stiffness against overlength",
        _STIFFNESS_CAPTION.format("Axial"),
        "stiffness",
        ("cube",),
        {"direction": "axial"},
    ),
    "stiffness_radial": FigureSpec(
        "Radial stiffness against overlength",
        _STIFFNESS_CAPTION.format("Radial"),
        "stiffness",
        ("cube",),
        {"direction": "radial"},
    ),
    "prestressed": FigureSpec(
        "Stiffness with the stress left in",
        "Stiffness against overlength, one panel per direction and thickness; middle, smallest and "
        "largest positive value of the realisations. Squares: stress-free shape, mesh limit; "
        "circles: at the stressed equilibrium on the mesh that was crumpled; triangles: the same "
        "after relaxing again on refined meshes, where the study did. Held rings allow values that "
        "are not positive (≤ 0): their number stands at the bottom, by the mark of their series. "
        "Line, for the published case alone: published experiment (fit).",
        "prestressed",
        ("cube",),
    ),
    "mesh_error": FigureSpec(
        "Stated mesh error of the stiffness",
        "Estimated error of the stress-free stiffness of the same shape in the mesh limit, over "
        "that stiffness, against overlength; one line per thickness: median of the realisations, "
        "bar up to the largest. It says nothing about how the shape itself depends on the mesh.",
        "mesh_error",
        ("cube",),
    ),
    "stiffness_map": FigureSpec(
        "Stiffness over overlength and thickness",
        "Filled contours: mean stiffness in the mesh limit (on the crumpled mesh where no mesh "
        "error is stated), interpolated between the simulated configurations (dots; ?: not "
        "trusted). Dashed lines: the power law of the trusted ones, or of all where none is "
        "trusted; it is straight on logarithmic axes.",
        "stiffness_map",
        ("cube",),
    ),
    "fit_quality": FigureSpec(
        "How well the power law holds",
        "Top: stiffness of every realisation that the law is fitted to (mesh limit, trusted, where "
        "there is any) against the value of the law. Bottom: their "
        "ratio against overlength; the band holds 95 % of a normal scatter about the law. Dots "
        "that leave the band together show where the law bends.",
        "fit_quality",
        ("cube",),
    ),
    "variability": FigureSpec(
        "Scatter over random imperfections",
        "Coefficient of variation of the stiffness on the crumpled mesh, with its 95 % confidence "
        "interval (modified McKay), against overlength. Line and band: linear regression and its "
        "95 % confidence band.",
        "variability",
        ("cube",),
    ),
    "dynamic_stiffness": FigureSpec(
        "Dynamic stiffness",
        "Magnitude of the relative stiffness (a pair of opposite forces on the two rings per "
        "relative motion, as published; other ring motions held) against frequency. Line and "
        "band: median, smallest and largest of the realisations. Triangles at the left: mean "
        "static stiffness.",
        "dynamic_stiffness",
        ("cube",),
        {"definition": "relative"},
    ),
    "design_chart": FigureSpec(
        "Which foil stays soft beside the mount",
        "Thickness against overlength. Number and colour: highest frequency up to which the "
        "transfer stiffness of all links is within the allowed share of the mount's, median of "
        "the realisations, in brackets the least favourable one; ≥: to the end of the computed "
        "band. Hatched: exceeded at rest already, with the static share. Frame: every realisation "
        "keeps the share as far up as asked for. Left: mount without mass; right: mount with a "
        "resonance of its own, above which it is soft itself.",
        "design_chart",
        ("cube",),
    ),
    "transmissibility": FigureSpec(
        "Transmissibility of a payload on its mounts",
        "Motion of the payload per motion of the floor, without links and with links of several "
        "thicknesses at the middle overlength of the study. Line and band: median, smallest and "
        "largest of the realisations. Left: mount without mass; right: mount with a resonance of "
        "its own.",
        "transmissibility",
        ("cube",),
    ),
    "convergence_high_frequency": FigureSpec(
        "Overlengths at high frequency",
        "Top: magnitude of the relative stiffness of each overlength (mean over seeds of its "
        "logarithm) over the mean of all overlengths. Dark band: one standard deviation of the "
        "seeds of an overlength to either side. Bottom: standard deviation over overlengths, less "
        "what few seeds add to their means, over that of the seeds, variances averaged over an "
        "octave. Where that stays at most 1 (dotted) up to the end, a vertical line marks the "
        "beginning. Shaded light: fewer than four elements in a bending wave of the flat foil.",
        "convergence_high_frequency",
        ("cube",),
    ),
    "eigenfrequency_law": FigureSpec(
        "First eigenfrequency against reference height",
        "First eigenfrequency with both rings clamped. Small dots: realisations; large: mean; "
        "line and band: fitted power law and its 95 % band; dashed, for the published case alone: "
        "the published exponent, drawn through the middle of the data. Brackets: 95 % interval, "
        "clustered by height where the heights depart from the law.",
        "eigenfrequency_law",
        ("cube",),
    ),
    "modal_density": FigureSpec(
        "Modal density",
        "Modes per Hz with both rings held, counted over half an octave about each frequency. Line "
        "and band: median, smallest and largest of the realisations; where one of them has no mode "
        "there is a gap. Between the dashed lines: a flat plate of the same foil, smallest to "
        "largest area, (area / 2) √(ρt / D) with D = Et³ / 12(1 − ν²). Shaded: fewer than four "
        "elements in a bending wave of that plate, so that the mesh decides how many modes there "
        "are.",
        "modal_density",
        ("cube",),
    ),
    "mac_seeds": FigureSpec(
        "First modes of two realisations compared",
        "Modal assurance criterion between the first modes of two seeds of one configuration: 1 "
        "for the same motion of the material points, 0 for unrelated ones. The folds of the seeds "
        "lie at different angles about the axis; neither is turned to match the other. Above: the "
        "highest criterion of each mode with any of the other seed's, over all pairs of seeds.",
        "mac_seeds",
        ("crumple_paths", "response_paths"),
    ),
    "seeds": FigureSpec(
        "One configuration, different imperfections",
        "The same thickness and overlength, crumpled from different random imperfections. "
        "Colour: radial displacement from the cylinder.",
        "seeds",
        ("crumple_paths",),
    ),
    "history": FigureSpec(
        "One crumpling history",
        "Height, reaction force of the ring, energies and relative residual of one realisation "
        "against step. The grey line marks the end of the ramp.",
        "history",
        ("crumple_paths",),
    ),
    "energy": FigureSpec(
        "Strain energy of the crumpled sheets",
        "Share of membrane, bending and stabilisation energy, mean of the realisations; above "
        "each bar the strain energy. With the one-point element a large stabilisation share says "
        "that the mesh does not resolve the ridges; with the corner-sampled one it is the control "
        "of the checkerboard alone.",
        "energy",
        ("cube",),
    ),
}
"""Figures of the study by id, in the order in which a report shows them."""


def draw_figure(figure_id: str, files: StudyFiles, stem) -> tuple[Path, Path]:
    """Draw and save one figure.

    Parameters
    ----------
    figure_id
        A key of `FIGURES`.
    stem : path without suffix

    Raises
    ------
    KeyError
        If there is no such figure.
    """
    if figure_id not in FIGURES:
        raise KeyError(f"no figure {figure_id!r}: choose one of {', '.join(FIGURES)}")
    spec = FIGURES[figure_id]
    figure = spec.draw(**{name: getattr(files, name) for name in spec.needs})
    return save(figure, stem, spec.png_dpi)


def draw_figures(figure_ids: Iterable[str], files: StudyFiles, out_dir) -> list[Path]:
    """Draw and save figures as ``<out_dir>/<id>.png`` and ``.svg``; return the paths.

    Parameters
    ----------
    figure_ids
        Keys of `FIGURES`.
    out_dir : path of the folder
    """
    return [
        path
        for figure_id in figure_ids
        for path in draw_figure(figure_id, files, Path(out_dir) / figure_id)
    ]
