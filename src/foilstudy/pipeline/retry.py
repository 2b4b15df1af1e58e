"""Another attempt, with safer settings, where a crumple has failed; on record, never silently.

What a second attempt finds is a crumple of another method than the one that was chosen, so that
nobody gets one without asking.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from foilstudy.linalg import SolveError
from foilstudy.measure.verdicts import verdicts
from foilstudy.model.foil import Foil
from foilstudy.model.mesh_size import SLENDERNESS_MAX
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.crumpled import Crumpled, Recipe
from foilstudy.pipeline.evidence import seen_in
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.pace import ramp_steps
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.paths.ring_alone import RingAlonePath
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling
from foilstudy.solve.relaxation.scheme import Scheme

__all__ = ["Attempts", "attempted", "safer"]

SLOWER = 4
"""Factor of the steps of the ramp from one attempt to the next; twice as many of the relaxation."""
_CURABLE = ("not_converged", "diverged", "saddle", "folded_globally", "rate_dependent")
"""Verdicts that come of how a foil is pushed."""
_OF_HASTE = ("hourglassed", "locked")
"""Those that come of too fast a ramp, unless the mesh is too wide or its element made for it."""
_SOUND_ELEMENT = "corner"


@dataclass(frozen=True, eq=False)
class Attempts:
    """What came of the attempts at one foil.

    Attributes
    ----------
    crumpled : Crumpled
        Of the first attempt that nothing speaks against; of the very first if all failed.
    number : int
        Which attempt that was, from 1.
    message : str
        One sentence on its status, and why there was more than one attempt.
    """

    crumpled: Crumpled
    number: int
    message: str


def attempted(foil: Foil, recipe: Recipe, retries: int) -> Attempts:
    """Crumple a foil, again and more safely while the crumple fails.

    Parameters
    ----------
    foil : Foil
    recipe : Recipe
    retries : int
        Attempts at most, beyond the first.

    Raises
    ------
    Exception
        What `crumple` raises, of the first attempt, where no other is sound.
    """
    if not retries:
        crumpled = crumple(foil, recipe.mesh, recipe.imperfection, recipe.method)
        return Attempts(crumpled, 1, crumpled.message)
    first: Crumpled | Exception | None = None
    failures: list[str] = []
    for number in range(1, 2 + retries):
        method = safer(recipe.method, foil, number)
        crumpled, failed = _attempt(foil, replace(recipe, method=method))
        if first is None:
            first = crumpled
        if not failed:
            return Attempts(crumpled, number, _with(crumpled.message, failures))
        failures.append(f"attempt {number}: {failed}")
    if isinstance(first, Exception):
        raise first
    return Attempts(first, 1, _with(first.message, failures[1:], "no safer attempt was sound"))


def _attempt(foil: Foil, recipe: Recipe) -> tuple[Crumpled | Exception, str]:
    """The crumple, and what of it a safer setting may cure; the failure of the computation."""
    try:
        crumpled = crumple(foil, recipe.mesh, recipe.imperfection, recipe.method)
    except (SolveError, ArithmeticError) as error:
        return error, f"{type(error).__name__}: {error}"
    found = [each.name for each in verdicts(seen_in(crumpled, crumpled.arrival))]
    curable = [name for name in found if name in _curable(foil, recipe.mesh)]
    return crumpled, f"{' and '.join(curable)} ({crumpled.message})" if curable else ""


def _curable(foil: Foil, mesh: Mesh) -> tuple[str, ...]:
    widest = SLENDERNESS_MAX * math.sqrt(foil.diameter / 2 * foil.thickness)
    sound = mesh.element == _SOUND_ELEMENT and mesh.element_size <= widest
    return (*_CURABLE, *_OF_HASTE) if sound else _CURABLE


def _with(message: str, failures: list[str], words: str = "safer settings") -> str:
    return f"{message}; {words}, after {'; '.join(failures)}" if failures else message


def safer(method: Method, foil: Foil, attempt: int) -> Method:
    """The settings of an attempt: of the first those that were chosen.

    Every further one has the spectral mass, with a safety that grows by 1.5, averaged adaptive
    damping, and a ramp that is spread over the height and takes four times the steps of the one
    before, if there was one, at least those of standard accuracy; stops of the ring are kept.
    """
    if attempt == 1:
        return method
    path, steps = method.path, ramp_steps(foil.diameter / 2 / foil.thickness)
    if isinstance(path, RelaxationPath):
        steps = max(steps, SLOWER * path.ramp_steps)
    else:
        path = RelaxationPath(settling=path.settling)
    if isinstance(path, RingAlonePath):
        path = RelaxationPath(path.ramp_steps, path.scheme, path.settling, path.check_interval)
    steps *= SLOWER ** (attempt - 2)
    most = max(path.settling.relaxation_steps_max, SettleOptions().relaxation_steps_max)
    settling = replace(path.settling, relaxation_steps_max=most * 2 ** (attempt - 1))
    scheme = Scheme(mass=SpectralMassScaling(safety=SpectralMassScaling().safety * attempt))
    return replace(method, path=replace(path, ramp_steps=steps, scheme=scheme, settling=settling))
