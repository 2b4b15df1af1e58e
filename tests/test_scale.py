"""The same foil at another size: lengths times s give stiffness times s, frequencies over s.

And what rounding takes from foils that are small, large or thin, which must neither be refused for
no reason nor pass for a result.
"""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from conftest import FEP

from foilstudy.base.record import read_record
from foilstudy.config import load_config
from foilstudy.linalg import SolveError, TooManyModes, factorise, modes_below, shifted
from foilstudy.measure.dynamics import (
    DynamicsOptions,
    ModalDamping,
    RayleighDamping,
    StructuralDamping,
    Structure,
    Wanted,
)
from foilstudy.measure.dynamics.reductions import by_need
from foilstudy.measure.dynamics.reductions.craig_bampton import CraigBampton
from foilstudy.measure.stiffness import fixed_stiffness
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.patch import Patch
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.structures import stress_free_structure
from foilstudy.pipeline.vibration import vibration_of
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.respond import respond_job


def crumpled(diameter, thickness, *, material=FEP, seed=0, settling=None):
    """A coarse crumple with the proportions of the published case."""
    foil = Foil(diameter, 0.85 * diameter, 0.65 * diameter, thickness, material)
    path = RelaxationPath(ramp_steps=300, settling=settling or SettleOptions())
    imperfection = Imperfection(amplitude=5e-5 * diameter, seed=seed)
    return crumple(foil, Mesh(0.1 * diameter), imperfection, Method(path))


def scaled(shape, s):
    """The same crumple with all lengths times s."""
    foil, patch = shape.foil, shape.patch
    sizes = (foil.diameter, foil.reference_height, foil.gap_height, foil.thickness)
    return replace(
        shape,
        foil=Foil(*(s * size for size in sizes), foil.material),
        patch=Patch(
            patch.elements_around,
            patch.elements_along,
            s * patch.size_around,
            s * patch.size_along,
        ),
        points=s * shape.points,
        reference=s * shape.reference,
    )


@pytest.fixture(scope="module")
def shape():
    return crumpled(0.2, 500e-6)


@pytest.fixture(scope="module")
def thin():
    return crumpled(0.2, 5e-6)


@pytest.mark.parametrize("diameter_mm", [1, 1.5, 5, 200, 10_000])
@pytest.mark.parametrize("reduction", ["hintz_herting", "craig_bampton", "rational_krylov"])
def test_stiffness_and_frequencies_scale_with_the_size(diameter_mm, reduction, shape):
    s = diameter_mm / 200
    base, other = (stress_free_structure(x) for x in (shape, scaled(shape, s)))
    np.testing.assert_allclose(
        fixed_stiffness(other.static.stiffness),
        s * fixed_stiffness(base.static.stiffness),
        rtol=1e-10,
    )
    options = DynamicsOptions(reduction, 0.1, None, 1.0, 300.0, 9, eigenfrequencies=3)
    other_options = replace(options, lowest_hz=1.0 / s, highest_hz=300.0 / s)
    first, second = vibration_of(base, options), vibration_of(other, other_options)
    np.testing.assert_allclose(second.eigenfrequencies * s, first.eigenfrequencies, rtol=1e-6)
    np.testing.assert_allclose(second.dynamic_stiffness / s, first.dynamic_stiffness, rtol=1e-6)


@pytest.mark.parametrize("diameter_mm", [1, 1.5, 5, 200])
@pytest.mark.parametrize("highest_hz", [50.0, 800.0])
def test_a_band_far_below_the_first_mode_suits_every_reduction(diameter_mm, highest_hz, shape):
    structure = stress_free_structure(scaled(shape, diameter_mm / 200))
    every = {}
    for name in ("rational_krylov", "hintz_herting", "craig_bampton"):
        options = DynamicsOptions(name, 1e-2, highest_hz=highest_hz, frequencies=4)
        every[name] = vibration_of(structure, options)
        assert every[name].model.error_estimate <= 1e-2
    exact = every.pop("rational_krylov").dynamic_stiffness
    for vibration in every.values():
        assert np.abs(vibration.dynamic_stiffness / exact - 1).max() < 1e-2


DAMPINGS = [
    ModalDamping(0.05),
    StructuralDamping(0.1),
    RayleighDamping.between(0.05, 20.0, 800.0),
]


@pytest.mark.parametrize("damping", DAMPINGS, ids=lambda damping: damping.kind)
@pytest.mark.parametrize("diameter_mm", [1, 5, 200, 10_000])
@pytest.mark.parametrize("which", ["shape", "thin"])
def test_the_first_frequency_tells_the_static_stiffness(which, diameter_mm, damping, request):
    """With the undamped stiffness as its real part; the terms of inertia and damping are small."""
    structure = stress_free_structure(scaled(request.getfixturevalue(which), diameter_mm / 200))
    static = fixed_stiffness(structure.static.stiffness)
    probe = vibration_of(structure, DynamicsOptions(frequencies=2, eigenfrequencies=1))
    lowest = 1e-4 * probe.eigenfrequencies[0]
    options = DynamicsOptions(
        lowest_hz=lowest, highest_hz=10 * lowest, frequencies=3, damping=damping
    )
    for band in (options, replace(options, lowest_hz=lowest / 100, highest_hz=lowest / 10)):
        vibration = vibration_of(structure, band)
        assert vibration.model.error_estimate <= band.tolerance
        ratio = np.abs(vibration.dynamic_stiffness[:2, :, 0].real) / static
        near = 0.05 if damping.kind == "rayleigh" else band.tolerance
        np.testing.assert_allclose(ratio, 1, atol=near)


@pytest.fixture(scope="module")
def far():
    """A foil of 0.02 um, stopped far from equilibrium: membrane forces 1e11 times its stiffness."""
    foil = Foil(0.2, 0.17, 0.15, 2e-8, FEP)
    settling = SettleOptions(relaxation_steps_max=0, hessians_last=2)
    method = Method(RelaxationPath(ramp_steps=100, settling=settling))
    shape = crumple(foil, Mesh(0.02), Imperfection(amplitude=4e-9), method)
    assert shape.status == "not_converged"
    return stress_free_structure(shape)


def test_a_thin_foil_far_from_equilibrium_keeps_its_values(far):
    """Rounding of membrane forces meets the rigid motions; it is no support."""
    motions, stiffness = far.rigid_motions, far.static.stiffness
    resistance = np.abs(np.einsum("im,ij,jm->m", motions, stiffness, motions))
    terms = np.einsum("im,ij,jm->m", np.abs(motions), np.abs(stiffness), np.abs(motions))
    assert 1e-6 < (resistance / terms).max() < 1e-2
    assert (fixed_stiffness(stiffness) > 0).all()


def held_by(structure, spring):
    """The structure with the bottom ring on a spring to the ground, over its own stiffness."""
    interface = structure.stiffness.interface.copy()
    interface[2, 2] *= 1 + spring
    stiffness = replace(structure.stiffness, interface=interface)
    return Structure.assembled(stiffness, structure.mass, structure.rigid_motions)


@pytest.mark.parametrize("which", ["shape", "thin"])
def test_a_support_beside_the_rings_is_noticed(which, request):
    structure = stress_free_structure(request.getfixturevalue(which))
    with pytest.raises(ValueError, match="held by something else"):
        held_by(structure, 1e-8)


def test_a_stiffness_that_is_lost_in_rounding_is_refused(far):
    with pytest.raises(SolveError, match="lost in rounding: .* use a finer mesh"):
        held_by(far, 1e-13)


def test_a_limit_on_an_eigenvalue_is_moved_aside():
    values = np.arange(1.0, 121.0)
    stiffness, mass = sparse.diags_array(values).tocsr(), sparse.eye_array(120).tocsr()
    factor, shift = shifted(stiffness, mass, 7.0)
    assert factor.negative_eigenvalues in (6, 7)
    assert shift == pytest.approx(7.0, rel=1e-5) and shift != 7.0
    assert modes_below(stiffness, mass, 7.0).eigenvalues.size in (6, 7)
    singular = sparse.csr_array((120, 120))
    with pytest.raises(SolveError):
        shifted(singular, 0 * mass, 1.0)


def test_a_search_for_too_many_modes_is_refused_before_it_begins(shape):
    structure = stress_free_structure(shape)
    k, m = structure.stiffness.interior, structure.mass.interior
    limit = (2 * np.pi * 1000.0) ** 2
    count = factorise((k - limit * m).tocsr()).negative_eigenvalues
    with pytest.raises(TooManyModes, match=f"{count} modes lie below 1000 Hz, of which at most 5"):
        CraigBampton(1000.0, None, 5).reduce(structure)


def test_an_automatic_cutoff_seeks_no_more_modes_than_stated(shape, monkeypatch):
    structure = stress_free_structure(shape)
    monkeypatch.setattr(by_need, "_MODES_MAX", 12)
    sought = []
    reduce = CraigBampton.reduce

    def counted(self, structure):
        sought.append(self.cutoff_hz)
        return reduce(self, structure)

    monkeypatch.setattr(CraigBampton, "reduce", counted)
    model = by_need.with_enough_modes(structure, CraigBampton, Wanted(1e-6, 1.0, 400.0))
    assert model.size <= 12 + 12
    assert model.valid_to_hz < 400.0 and model.error_estimate > 1e-6  # and it says so
    assert len(sought) <= 18


def small_study(**dynamics):
    return load_config(
        {
            "sweep": {"thickness_um": [500], "reference_height_mm": [170], "realisations": 1},
            "mesh": {"element_size_mm": 20},
            "relaxation": {"ramp_steps": 300},
            "stiffness": {"refinements": 0},
            "dynamics": dynamics,
        }
    )


def test_a_cell_without_any_valid_frequency_says_so(tmp_path):
    study = small_study(reduction="guyan", shown_min_hz=300, shown_max_hz=400, frequencies=4)
    (cell,) = study.cells()
    crumple_job(study.crumple_task(cell), tmp_path / "crumple.nc")
    respond_job(study.response_task(cell), tmp_path / "crumple.nc", tmp_path / "response.nc")
    values, attributes = read_record(tmp_path / "response.nc")
    assert "dynamic stiffness at no frequency of the shown band" in attributes["message"]
    assert np.isnan(values["dynamic_stiffness_re"]).all() and values["valid_to_frequency"] == 0
    assert (values["static_stiffness"] > 0).all()


def test_a_singular_tangent_costs_no_other_number(tmp_path, monkeypatch):
    def singular(*_):
        raise SolveError("the matrix is singular")

    monkeypatch.setattr("foilstudy.pipeline.crumpled.prestressed_stiffness", singular)
    study = small_study(shown_max_hz=100, frequencies=3)
    (cell,) = study.cells()
    crumple_job(study.crumple_task(cell), tmp_path / "crumple.nc")
    respond_job(study.response_task(cell), tmp_path / "crumple.nc", tmp_path / "response.nc")
    values, attributes = read_record(tmp_path / "response.nc")
    assert attributes["status"] == "converged"
    assert "no pre-stressed stiffness" in attributes["message"]
    assert np.isnan(values["prestressed_stiffness"]).all()
    assert (values["static_stiffness"] > 0).all()
