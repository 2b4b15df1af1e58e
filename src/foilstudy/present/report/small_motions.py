"""What decides a small motion besides the shape: contacts that are closed, and what yields."""

from __future__ import annotations

import io
from dataclasses import dataclass

import numpy as np
import xarray as xr

from foilstudy.base.numerals import fixed, nominal, number_range, plural
from foilstudy.measure.stiffness.contacts import CONTACT_SPRINGS
from foilstudy.plot import style
from foilstudy.present.report.spread import Spread
from foilstudy.present.statistics.cells import closed_contacts, measured
from foilstudy.present.statistics.powerlaw import AS_IT_STANDS, SIMULATED

__all__ = [
    "BracketRow",
    "SecantRow",
    "bracket_findings",
    "bracket_picture",
    "bracket_rows",
    "secant_findings",
    "secant_rows",
]

_OPEN, _STUCK = CONTACT_SPRINGS[0], CONTACT_SPRINGS[-1]
_LOADING, _UNLOADING = "stiffness_loading", "stiffness_unloading"
_WAYS = {
    "axial": "axially {} times pushed together and {} times pulled apart",
    "radial": "radially {} times along x and y and {} times the other way",
}
WORDS = {
    "ignored": "contacts open",
    "normal": "closed as springs",
    "rigid": "closed, rigid",
    "stuck": "closed, stuck",
}
"""What contacts do in a small motion, by the names of `CONTACT_SPRINGS`."""


@dataclass(frozen=True)
class BracketRow:
    """One configuration some realisations of which have closed contacts.

    Attributes
    ----------
    touching, n : int
        Realisations that have any, and all that count.
    contacts : float
        Closed pairs and knots at the rings, mean over those that have any, as all that follows.
    stiffness : mapping of direction and kind to float
        N/m.
    factor : mapping of direction to float
        Stuck over open, the mean of their ratios.
    first_hz : mapping of kind to float
        First eigenfrequency, rings clamped, Hz; of what the study measured.
    """

    thickness_um: float
    overlength_percent: float
    touching: int
    n: int
    contacts: float
    stiffness: dict[tuple[str, str], float]
    factor: dict[str, float]
    first_hz: dict[str, float]


@dataclass(frozen=True)
class SecantRow:
    """One configuration in one direction, means in N/m over realisations that have all three.

    Loading is down axially, along x and y radially; unloading the other way.
    """

    thickness_um: float
    overlength_percent: float
    direction: str
    loading: float
    unloading: float
    as_it_stands: float
    n: int


def bracket_rows(cube: xr.Dataset) -> list[BracketRow]:
    """Read the bracket of closed contacts; empty where nothing touches, or may."""
    if "contact_pairs" not in cube:
        return []
    closed, first = closed_contacts(cube), _first_hz(cube)
    touching = closed > 0
    values = {
        kind: measured(cube, f"stiffness_contacts_{kind}").where(touching)
        for kind in CONTACT_SPRINGS
    }
    factors = values[_STUCK] / values[_OPEN]
    rows = []
    for place in _places(cube):
        if not touching.sel(place).any():
            continue
        directions = {str(d): place | {"direction": d} for d in cube["direction"].values}
        rows.append(
            BracketRow(
                *place.values(),
                int(touching.sel(place).sum()),
                int(np.isfinite(closed.sel(place)).sum()),
                float(closed.where(touching).sel(place).mean()),
                {
                    (name, kind): float(values[kind].sel(at).mean())
                    for name, at in directions.items()
                    for kind in CONTACT_SPRINGS
                },
                {name: float(factors.sel(at).mean()) for name, at in directions.items()},
                {k: float(hz.where(touching).sel(place).mean()) for k, hz in first.items()},
            )
        )
    return rows


def bracket_findings(cube: xr.Dataset) -> list[str]:
    """Say where parts of the foil touch, and what that may do to the stiffness, in sentences."""
    if "contact_pairs" not in cube:
        return []
    rows, all_of_them = bracket_rows(cube), len(_places(cube))
    if not rows:
        return ["Parts of the foil may touch, but in none of the shapes that are measured any do."]
    parts = []
    for direction in map(str, cube["direction"].values):
        factor = Spread.of([row.factor[direction] for row in rows])
        if factor:
            parts.append(f"{number_range(factor.lowest, factor.highest)} times {direction}ly")
    sentences = [
        f"In {len(rows)} of {plural(all_of_them, 'configuration')} parts of the foil touch in the "
        "shape that is measured: they are within the reach of the barrier.",
        "What a closed contact does in a small motion is not known: it opens, presses or sticks.",
    ]
    if parts:
        sentences.append(
            f"Stuck, contacts make the stress-free foil {' and '.join(parts)} as stiff as open "
            "ones: give the bracket, never one number."
        )
    return sentences


def bracket_picture(cube: xr.Dataset) -> tuple[str, bytes]:
    """Dynamic stiffness by what contacts do, where most are closed: a title, and an SVG.

    Empty where the study measured none, or nothing touches.
    """
    kinds = [kind for kind in CONTACT_SPRINGS if _dynamic(kind) in cube]
    rows = bracket_rows(cube)
    if kinds == [_OPEN] or not rows:
        return "", b""
    most = max(rows, key=lambda row: row.touching * row.contacts)
    title = f"{nominal(most.thickness_um)} µm, {nominal(most.overlength_percent)} %"
    place = {"thickness": most.thickness_um, "overlength": most.overlength_percent}
    picture = io.BytesIO()
    figure = _drawn(cube.sel(place), kinds)
    style.styled(figure.savefig)(picture, format="svg", metadata={"Date": None})
    return title, picture.getvalue()


@style.styled
def _drawn(cell: xr.Dataset, kinds: list[str]):
    directions = list(map(str, cell["direction"].values))
    figure, axes = style.panel_grid(1, len(directions), (3.4, 2.9), (1.2, 0.9), sharex=True)
    frequency, touching = cell["frequency"].to_numpy(), closed_contacts(cell) > 0
    for ax, direction in zip(axes[0], directions):
        for j, (kind, colour) in enumerate(zip(kinds, style.ordered_colours(len(kinds)))):
            curves = np.abs(cell[_dynamic(kind)].sel(direction=direction, definition="relative"))
            curves = curves.where(touching).transpose("seed", "frequency").to_numpy()
            if np.isfinite(curves).any():
                look = {"lw": 1.4, "ls": style.line_style(j), "label": WORDS[kind]}
                style.median_band(ax, frequency, curves, colour, **look)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_title(direction)
        ax.set_xlabel("frequency (Hz)")
    axes[0, 0].set_ylabel("|k| (N/m)")
    style.legend_below(figure, axes)
    return figure


def secant_rows(cube: xr.Dataset) -> list[SecantRow]:
    """Read the stiffness of both ways; empty where the study did not measure it."""
    if _LOADING not in cube:
        return []
    names = _LOADING, _UNLOADING, SIMULATED[AS_IT_STANDS]
    rows = []
    for place in _places(cube):
        for direction in cube["direction"].values:
            at = place | {"direction": direction}
            values = np.array([measured(cube, name, **at).values for name in names])
            known = values[:, np.isfinite(values).all(axis=0)]
            if known.size:
                means = map(float, known.mean(axis=1))
                rows.append(SecantRow(*place.values(), str(direction), *means, known.shape[1]))
    return rows


def secant_findings(cube: xr.Dataset) -> list[str]:
    """Say how far the two ways differ, in sentences."""
    if _LOADING not in cube:
        return []
    rows, parts = secant_rows(cube), []
    if not rows:
        return ["No foil found an equilibrium near where it stands both ways."]
    for direction in map(str, cube["direction"].values):
        here = [row for row in rows if row.direction == direction and row.as_it_stands > 0]
        spreads = [
            Spread.of([getattr(row, way) / row.as_it_stands for row in here])
            for way in ("loading", "unloading")
        ]
        if all(spreads):
            parts.append(_WAYS[direction].format(*map(_ratios, spreads)))
    sentences = [
        "What yields or touches may resist one way less than the other. The foil is moved by a "
        "fiftieth of its thickness from where it stands, one way and the other; flow, contacts and "
        "friction follow, clamps hold."
    ]
    if parts:
        sentences.append(
            f"Of its tangent stiffness there it then has {'; '.join(parts)} (means of "
            "configurations whose tangent is positive)."
        )
    return sentences


def _ratios(spread: Spread) -> str:
    """Near one, of which two decimals tell."""
    return " to ".join(dict.fromkeys(fixed(each) for each in (spread.lowest, spread.highest)))


def _places(cube: xr.Dataset) -> list[dict[str, float]]:
    return [
        {"thickness": float(thickness), "overlength": float(overlength)}
        for thickness in cube["thickness"].values
        for overlength in cube["overlength"].values
    ]


def _dynamic(kind: str) -> str:
    return "dynamic_stiffness" + ("" if kind == _OPEN else f"_contacts_{kind}")


def _first_hz(cube: xr.Dataset) -> dict[str, xr.DataArray]:
    """First eigenfrequency by what contacts do; nothing where the study asked for one alone."""
    names = {kind: f"eigenfrequency_contacts_{kind}" for kind in CONTACT_SPRINGS[1:]}
    found = {
        kind: measured(cube, name).isel(mode=0) for kind, name in names.items() if name in cube
    }
    return {_OPEN: measured(cube, "first_eigenfrequency"), **found} if found else {}
