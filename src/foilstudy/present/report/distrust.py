"""What not to trust, said before anything else: which configurations, why, and what cures it."""

from __future__ import annotations

from dataclasses import dataclass

from foilstudy.base.numerals import number_range, percent, plural
from foilstudy.model.mesh_size import SLENDERNESS_MAX, energy_error_at
from foilstudy.model.shell.folding import FOLD_ANGLE_MAX_DEG
from foilstudy.present.configuration import configuration
from foilstudy.present.report.configurations import named
from foilstudy.present.report.cure import Cure, Need, cures
from foilstudy.present.report.spread import Spread
from foilstudy.present.statistics.trust import ERROR_MAX, Trust

_REFINEMENTS_OF_OLD = 1
"""Of cubes whose configuration does not say; the default."""


@dataclass(frozen=True)
class Banner:
    """What the first screen warns of.

    Attributes
    ----------
    verdict : str
        How much of the study is not trusted.
    partial : bool
        Whether the rest of it is.
    reasons : tuple of str
        Why, with the configurations named.
    consequence : str
        What that means for the rest of the page.
    cures : tuple of Cure
        Changes of the configuration; empty where none is known.
    """

    verdict: str
    partial: bool
    reasons: tuple[str, ...]
    consequence: str
    cures: tuple[Cure, ...]


def banner(cube, trust: Trust) -> Banner | None:
    """Say what is not trusted; None where everything is that the study knows."""
    doubted = trust.doubted.any("direction")
    count, known = int(doubted.sum()), int(trust.known.any("direction").sum())
    if not count:
        return None
    refinements = _refinements(cube)
    reasons = [
        *_unresolved(trust),
        *_folded(trust),
        *_flawed(trust),
        *_inaccurate(trust),
        *_unstated(trust, refinements),
    ]
    found = _cures(cube, trust)
    if trust.unresolved.any() and not found:
        reasons.append(
            "No mesh that a study of this package can carry resolves it as it is configured: take "
            "thicker foil, a smaller cylinder or fewer refinements."
        )
    verdict = "Do not trust any stiffness of this study yet."
    if count < known:
        configurations = plural(known, "configuration")
        verdict = f"Do not trust the stiffness of {count} of {configurations}."
    return Banner(verdict, count < known, tuple(reasons), _consequence(trust), found)


def _unresolved(trust: Trust):
    cells = trust.unresolved.any("direction")
    if cells.any():
        widths = Spread.of(trust.slenderness.where(cells))
        if widths is None:
            yield "Whether the crumples are resolved is not known: the cube tells no element size."
            return
        yield (
            f"The crumple is not resolved at {named(cells)}: its elements are "
            f"{number_range(widths.lowest, widths.highest)} times √(R t) wide, and folds need "
            f"{SLENDERNESS_MAX:g} at most. A finer mesh crumples to another shape, possibly "
            "several times as stiff or as soft; the stated mesh error, which is that of the given "
            "shape, does not tell."
        )


def _folded(trust: Trust):
    cells = (trust.folded & ~trust.unresolved).any("direction")
    if cells.any():
        angles = Spread.of(trust.fold_angle.where(cells))
        yield (
            f"The sharpest folds turn {number_range(angles.lowest, angles.highest)}° from one "
            f"element to the next at {named(cells)}; a mesh that follows them turns "
            f"{FOLD_ANGLE_MAX_DEG:g}° at most."
        )


def _flawed(trust: Trust):
    cells = (trust.flawed & ~trust.unresolved).any("direction")
    if cells.any():
        yield (
            "Elements lock or hourglass, or the ramp was too fast for the foil, in most "
            f"realisations at {named(cells)}: the verdicts, under health, say which, and what to "
            "do instead."
        )


def _inaccurate(trust: Trust):
    if not trust.inaccurate.any():
        return
    directions = trust.inaccurate["direction"].values
    cells = {
        str(direction): named(trust.inaccurate.sel(direction=direction))
        for direction in directions
        if trust.inaccurate.sel(direction=direction).any()
    }
    alike = len(cells) == len(directions) and len(set(cells.values())) == 1
    where = (
        f"{' and '.join(cells)} at {next(iter(cells.values()))}"
        if alike
        else "; ".join(f"{direction} at {text}" for direction, text in cells.items())
    )
    largest = float(trust.mesh_error.where(trust.inaccurate).max())
    yield (
        f"The stated mesh error is more than {percent(ERROR_MAX)} of a value, up to "
        f"{percent(largest, 3)}: {where}."
    )


def _unstated(trust: Trust, refinements: int):
    if not trust.unstated.any():
        return
    if refinements == 0:
        yield (
            "No mesh error is stated: the stiffness is that of the crumpled mesh alone "
            "(stiffness.refinements: 0), and nothing tells how far from the limit it is."
        )
    else:
        cells = named(trust.unstated.any("direction"))
        yield f"A mesh error is not stated for every realisation at {cells}."


def _consequence(trust: Trust) -> str:
    some = trust.trusted.any()
    law = "Laws are those of the trusted configurations alone." if some else "No law is stated."
    return (
        f"{law} Dynamic stiffness, eigenfrequencies and isolation rest on the same shapes and the "
        "same meshes."
    )


def _cures(cube, trust: Trust) -> tuple[Cure, ...]:
    refinements = _refinements(cube)
    needed = None
    if refinements == 0:
        needed = 1
    elif (trust.inaccurate & ~trust.unresolved).any():
        needed = max(2, refinements + 1)
    folded = trust.folded & ~trust.unresolved
    need = Need(bool(trust.unresolved.any()), needed, _error_of_folds(trust, folded))
    wanted = need.mesh or needed is not None or need.error is not None
    return tuple(cures(cube, need)) if wanted else ()


def _error_of_folds(trust: Trust, folded) -> float | None:
    """Energy error of the mesh on which the folds would turn no more than they may."""
    if not folded.any():
        return None
    narrower = trust.slenderness * FOLD_ANGLE_MAX_DEG / trust.fold_angle
    return float(energy_error_at(narrower.where(folded.any("direction"))).min())


def _refinements(cube) -> int:
    section = configuration(cube).get("stiffness") or {}
    return int(section.get("refinements", _REFINEMENTS_OF_OLD))
