"""Elastic-plastic foil: von Mises plasticity in layers through the thickness (plane stress).

The layers stand in the middle of each element and see its mean strains. Their plastic strains take
stress off the elastic shell; with them as the state, that is a term of the energy that is linear
in the strains. What the strains of one element differ by stays elastic.

Where the thickness varies, so do the heights of the layers. Where the modulus does, all stresses of
an element are in that proportion, its yield stress and hardening with them: parts of an element
that share their strains then yield together, and one that is covered in part needs no more state.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sparse

from foilstudy.model.shell.elements.mean_strains import Inelastic
from foilstudy.model.shell.elements.protocol import MeanStrains, Relief
from foilstudy.model.shell.elements.together import mean_strains_of, relief_of
from foilstudy.model.shell.material.elastic import Elastic
from foilstudy.model.shell.material.layers import Layers, Look, PlasticState, differing
from foilstudy.model.shell.material.return_map import Flow, cartesian_frame
from foilstudy.model.shell.tangent import block_matrix

LAYERS = 8
"""Moment over curvature within 0.022 of the elastic limit moment, to six times its curvature; with
5, 7 and 21 layers it is 0.056, 0.028 and 0.003."""
HARDENING = 1 / 20
"""Default slope of stress over plastic strain, of Young's modulus. Perfectly plastic elements may
fold flat and never settle; with this none did."""


def layer_heights(number: int, thickness: float) -> np.ndarray:
    """Of the layers above the middle surface, m.

    In the middle of their shares of the thickness, but all a little further out, which makes the
    elastic bending stiffness exact.
    """
    places = (np.arange(number) + 0.5) / number - 0.5
    return thickness * places / np.sqrt(1 - 1 / number**2)


@dataclass(frozen=True)
class Plastic(Elastic):
    """Linear elastic up to the yield stress of the material, with linear hardening beyond.

    Attributes
    ----------
    material : Material
        Or the name of a known one.
    hardening : float, optional
        Slope of stress over plastic strain, Pa; that of the material, or a twentieth of Young's
        modulus, if left out.
    kinematic_share : float
        Of the hardening: moves the yield surface, by which a bend that is bent back yields early;
        the rest widens it.
    layers : int
        Through the thickness.
    """

    hardening: float | None = None
    kinematic_share: float = 1.0
    layers: int = LAYERS

    def __post_init__(self):
        super().__post_init__()
        if self.hardening is None:
            made = self.material
            default = HARDENING * made.youngs_modulus if made.hardening is None else made.hardening
            object.__setattr__(self, "hardening", default)

    @property
    def flow(self) -> Flow:
        """Constants of the return map."""
        made, kinematic = self.material, self.kinematic_share * self.hardening
        isotropic = self.hardening - kinematic
        return Flow(
            made.youngs_modulus, made.poisson_ratio, made.yield_stress, isotropic, kinematic
        )

    def terms(self, shell: Any) -> tuple[PlasticTerm, ...]:
        """See `Law`: the stress that plastic strains take off."""
        return (PlasticTerm(shell, self),)


class PlasticTerm:
    """The share of the energy that plastic strains take off an elastic shell.

    A term of a `solve.problem.Problem` whose first term is that shell. With the shell's energy it
    adds up to what the foil would give back on unloading, which is never negative.

    Parameters
    ----------
    shell : Shell
    law : Plastic
    """

    energy_names = ("plastic_relief",)

    def __init__(self, shell: Any, law: Plastic):
        self.law, self.shell, self._section = law, shell, shell.section
        self.heights = layer_heights(law.layers, self._section.thickness)
        self._look = Look(self._section.forms[:, 0].shape)
        self._relieved: PlasticState | None = None  # what the relief is of

    # made when they are needed: who wants a tangent or what a state says asks for no force
    @cached_property
    def _strains(self) -> MeanStrains:
        return mean_strains_of(self.shell.element, self._section)

    @cached_property
    def _relief(self) -> Relief | None:
        return relief_of(self.shell.element, self._section)

    @cached_property
    def _frame(self) -> np.ndarray:
        volumes = self._section.volumes
        if self._section.variation is not None:  # all stresses, and so all energies, follow it
            volumes = volumes * self._section.variation.modulus
        return np.concatenate([cartesian_frame(self._section.forms), volumes[:, None]], axis=1)

    def start(self) -> PlasticState:
        """No plastic strain."""
        return self._layers().untouched()

    def _layers(self) -> Layers:
        return Layers(self._frame, self.heights, self.law.flow)

    def numbers(self, state: PlasticState) -> dict[str, float]:
        """See `solve.problem.Lasting`: what has yielded takes the place of what would have."""
        return {
            "beyond_yield_share": self.yielded_share(state),
            "plastic_share": self.plastic_share(state),
            "plastic_strain_max": float(state.accumulated.max()),
            "dissipated_work": self.dissipated(state),
        }

    def recorded(self, state: PlasticState) -> dict[str, np.ndarray]:
        """See `solve.problem.Lasting`."""
        return {"plastic_strain": state.layers}

    def split(self, state: PlasticState) -> dict[str, np.ndarray]:
        """See `solve.problem.Lasting`: each quarter has the plastic strains of the whole."""
        return {"plastic_strain": state.layers.repeat(2, axis=0).repeat(2, axis=3)}

    def restored(self, values: Mapping[str, np.ndarray]) -> PlasticState:
        """See `solve.problem.Lasting`."""
        return self._layers().filled(np.asarray(values["plastic_strain"]))

    def force(self, points: np.ndarray, out: np.ndarray, state: PlasticState) -> np.ndarray:
        """See `solve.problem.Term`."""
        work = self._strains.force(points, self._inelastic(state), out)
        return np.array([work + state.energy])

    def gradient_with_shell(self, points: np.ndarray, out: np.ndarray, state: PlasticState) -> None:
        """See `solve.problem.Joint`."""
        if self._relief is None:
            self.force_with_shell(points, out, state)
        else:
            self._relieved_force(points, out, state)

    def force_with_shell(
        self, points: np.ndarray, out: np.ndarray, state: PlasticState
    ) -> np.ndarray:
        """See `solve.problem.Joint`."""
        if self._relief is None:
            energies, share = self.shell.force(points, out), np.empty_like(out)
            own = self.force(points, share, state)
            out += share
            return np.concatenate([energies, own])
        energies = self._relieved_force(points, out, state)
        work = self._relief.work(self._strains.strains(points))
        return np.append(energies, state.energy - work)

    def _relieved_force(
        self, points: np.ndarray, out: np.ndarray, state: PlasticState
    ) -> np.ndarray:
        """Write the force of both; the energies of the shell."""
        stale = differing(state, self._relieved)
        if len(stale):
            self._relief.update(stale, self._strains_of(state, stale))
        self._relieved = state
        return self._relief.force(points, out)

    def tangent(self, points: np.ndarray, state: PlasticState) -> sparse.csr_matrix:
        """See `solve.problem.Term`: at fixed plastic strains."""
        return block_matrix(self._section.patch, self.tangent_blocks(points, state))

    def tangent_blocks(self, points: np.ndarray, state: PlasticState) -> np.ndarray:
        """The same by control point and neighbour, as `Shell.tangent_blocks`."""
        return self._strains.tangent_blocks(points, self._inelastic(state))

    def _inelastic(self, state: PlasticState) -> Inelastic:
        strains = state.strains
        if self._section.variation is not None:
            strains[:, 3:] /= self._section.variation.thickness[:, None]
        return Inelastic.of(self._section, strains)

    def _strains_of(self, state: PlasticState, elements: np.ndarray) -> np.ndarray:
        """Inelastic strains of some elements, shape (number, 6)."""
        strains = state.strains_of(elements)
        if self._section.variation is not None:
            strains[:, 3:] /= self._section.variation.thickness.reshape(-1, 1)[elements]
        return strains

    def _layer_strains(self, points: np.ndarray) -> np.ndarray:
        """Strains of a shape, curvatures as if all elements had the layers of `heights`.

        In a thicker element all layers are further out in the same proportion.
        """
        strains = self._strains.strains(points)
        if self._section.variation is not None:
            strains[:, 3:] *= self._section.variation.thickness[:, None]
        return strains

    def evolved(self, points: np.ndarray, state: PlasticState) -> PlasticState:
        """See `solve.problem.Term`: every layer back on its yield surface."""
        rows = None if self._section.variation is not None else self._strains.rows
        shape = np.ascontiguousarray(points) if rows else self._layer_strains(points)
        return state.foil.flowed(shape, rows, state, self._look)

    def stresses(self, points: np.ndarray, state: PlasticState) -> np.ndarray:
        """Cartesian stresses 11, 22, 12 of the layers, Pa.

        Shape (elements_along, layers, 3, elements_around).
        """
        strains = self._layer_strains(points)
        elastic = np.stack(
            [self._turned(strains[:, :3] + z * strains[:, 3:]) for z in self.heights]
        )
        elastic = elastic.transpose(1, 0, 2, 3) - state.layers[:, :, :3]
        made = self.law.material
        nu = made.poisson_ratio
        e1, e2, e6 = elastic.transpose(2, 0, 1, 3)
        plane = made.youngs_modulus / (1 - nu**2)
        if self._section.variation is not None:
            plane = plane * self._section.variation.modulus[:, None]
        return np.stack(
            [plane * (e1 + nu * e2), plane * (e2 + nu * e1), plane * 0.5 * (1 - nu) * e6], axis=2
        )

    def spent(self, state: PlasticState) -> float:
        """See `solve.problem.Following`: dissipated, or kept by the kinematic hardening, J."""
        return state.dissipated + state.kept

    def dissipated(self, state: PlasticState) -> float:
        """Work that plastic flow has used up, J: all but what kinematic hardening keeps."""
        return state.dissipated

    def plastic_share(self, state: PlasticState) -> float:
        """Share of the volume that has yielded."""
        yielded = (state.accumulated > 0).mean(axis=1)
        return float(np.average(yielded, weights=self._section.volumes))

    def yielded_share(self, state: PlasticState) -> float:
        """Share of the stress-free area under which any layer has yielded."""
        yielded = (state.accumulated > 0).any(axis=1)
        return float(np.average(yielded, weights=self._section.areas * self._section.thickness))

    def _turned(self, covariant: np.ndarray) -> np.ndarray:
        """Strains (elements_along, 3, elements_around) in Cartesian axes."""
        (e1, e2, e6), f = covariant.transpose(1, 0, 2), self._frame.transpose(1, 0, 2)
        return np.stack(
            [f[0] * e1, f[1] * e1 + f[2] * e2 + f[3] * e6, f[4] * e1 + f[5] * e6], axis=1
        )
