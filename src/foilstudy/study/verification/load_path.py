"""Load paths of a sheet held against published load-displacement tables."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from foilstudy.linalg import SolveError
from foilstudy.model.patch import knot_points, refine
from foilstudy.model.supports.interpolation import along_weights, around_weights
from foilstudy.solve.loading.loaded_sheet import LoadedSheet
from foilstudy.solve.loading.path import follow_load
from foilstudy.study.verification.candidates import Candidate
from foilstudy.study.verification.records import (
    TOLERANCE,
    Benchmark,
    Checked,
    Curve,
    Picture,
    Plot,
)


@dataclass(frozen=True)
class Probe:
    """A displacement that is published.

    Attributes
    ----------
    at : tuple of float
        Place around and along, as shares of the patch.
    direction : tuple of float
        Unit vector along which the displacement is counted.
    published : tuple of float
        At the load factors of the case.
    source : str
        Where `published` comes from, in words fit for a table.
    compared : tuple of float
        Load factors at which it is held against the publication.
    smooth : bool
        Whether the solution is smooth enough for theory to promise an order.
    free_edge : bool
        Whether a free edge decides, see `Candidate.order`.
    tolerance, monotone
        As in `Checked`.
    """

    name: str
    at: tuple[float, float]
    direction: tuple[float, float, float]
    published: tuple[float, ...]
    source: str
    compared: tuple[float, ...] = (0.5, 1.0)
    smooth: bool = True
    free_edge: bool = False
    tolerance: float = TOLERANCE
    monotone: bool = True

    def read(self, loaded: LoadedSheet, points: np.ndarray) -> float:
        """The displacement at a shape."""
        patch = loaded.sheet.patch
        around = self.at[0] * patch.elements_around * patch.size_around
        along = self.at[1] * patch.elements_along * patch.size_along
        return float(
            np.einsum(
                "c,j,cji,i->",
                self.direction,
                along_weights(patch, np.array([along]))[0],
                points - loaded.sheet.reference,
                around_weights(patch, np.array([around]))[0],
            )
        )


@dataclass(frozen=True)
class NonlinearCase:
    """A benchmark on a sequence of meshes, each with half the element size of the one before.

    Attributes
    ----------
    side : str
        Along what the elements are counted.
    build : callable
        From the element under test and a number of elements to the sheet under its full load.
    factors : tuple of float
        Load factors, ascending.
    """

    name: str
    title: str
    side: str
    meshes: tuple[int, ...]
    build: Callable[[Candidate, int], LoadedSheet]
    factors: tuple[float, ...]
    probes: tuple[Probe, ...]

    def run(self, candidate: Candidate, meshes: tuple[int, ...] | None = None) -> Benchmark:
        """Compute a benchmark.

        The load grows on the coarsest mesh; on the finer ones every equilibrium is sought from that
        of the mesh before, refined.

        Parameters
        ----------
        meshes : tuple of int, optional
            Other meshes than those of the case; each the double of the one before.

        Raises
        ------
        SolveError
            If an equilibrium is not found.
        """
        meshes = meshes or self.meshes
        loaded, shapes, readings = None, [], []
        for elements in meshes:
            finer = self.build(candidate, elements)
            shapes = (
                _grown(self, finer) if loaded is None else _resettled(self, loaded, shapes, finer)
            )
            loaded = finer
            readings.append([[probe.read(loaded, p) for p in shapes] for probe in self.probes])
        values = np.array(readings)
        quantities = tuple(
            Checked(
                f"{probe.name} at {factor:g} of the load",
                "",
                probe.published[self.factors.index(factor)],
                probe.source,
                self.side,
                meshes,
                tuple(values[:, k, self.factors.index(factor)].tolist()),
                expected_rate=candidate.order(probe.free_edge) if probe.smooth else None,
                tolerance=probe.tolerance,
                monotone=probe.monotone,
            )
            for k, probe in enumerate(self.probes)
            for factor in probe.compared
        )
        curves = tuple(
            Curve(
                probe.name, (0.0, *values[-1, k].tolist()), (0.0, *self.factors),
                probe.published, self.factors,
            )
            for k, probe in enumerate(self.probes)
        )  # fmt: skip
        plot = Plot("displacement", "load / full load", curves)
        picture = _picture(self, loaded, shapes[-1])
        return Benchmark(self.name, self.title, candidate.name, quantities, plot, (picture,))


def _grown(case: NonlinearCase, loaded: LoadedSheet) -> list[np.ndarray]:
    path = follow_load(loaded, case.factors)
    if path.status != "converged":
        raise SolveError(f"{case.name}: {path.message}")
    return [e.points for e in path.equilibria if e.factor in case.factors]


def _resettled(case, coarse: LoadedSheet, shapes, fine: LoadedSheet) -> list[np.ndarray]:
    """Equilibria on the finer mesh, sought from those of the coarser one.

    What the refinement changed at one load factor is a good guess of what it changes at the next.
    """
    settled, change = [], 0.0
    for factor, points in zip(case.factors, shapes):
        displacement = refine(points - coarse.sheet.reference, periodic=False)
        start = fine.sheet.reference + displacement
        path = follow_load(fine, [factor], start + change)
        if path.status != "converged":
            raise SolveError(f"{case.name}, refined, at load factor {factor:g}: {path.message}")
        settled.append(path.equilibria[-1].points)
        change = settled[-1] - start
    return settled


def _picture(case: NonlinearCase, loaded: LoadedSheet, points: np.ndarray) -> Picture:
    displacement = points - loaded.sheet.reference
    along = np.einsum("c,cji->ji", case.probes[0].direction, displacement)
    return Picture.of(
        f"{case.title}, full load",
        knot_points(points, periodic=False),
        knot_points(along[None], periodic=False)[0],
    )
