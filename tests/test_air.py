"""The air about a foil: closed forms, invariants, and what it does in the dynamics."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.sparse as sparse
from scipy.linalg import eigh
from scipy.special import jn_zeros, jv
from small_study import sections_with

from foilstudy.base.errors import ConfigError, Refusal
from foilstudy.config.load import load_config
from foilstudy.config.scene import air_of
from foilstudy.linalg import Updated, combined, factorise, lowest_modes, modes_below, updated
from foilstudy.measure.air.added_mass import AddedMass
from foilstudy.measure.air.cylinder import cylinder_thickness
from foilstudy.measure.air.enclosures import SealedAdiabatic, SealedIsothermal, Vented
from foilstudy.measure.air.panels import influence
from foilstudy.measure.air.potential import inside, outside
from foilstudy.measure.air.surface import WettedSurface
from foilstudy.measure.air.true_surface import TrueSurface
from foilstudy.measure.air.vacuum import Vacuum
from foilstudy.measure.air.waves import AirOfWaves, Wall, Waves
from foilstudy.measure.choices import AIRS, ENCLOSURES, REDUCTIONS
from foilstudy.measure.dynamics import DynamicsOptions
from foilstudy.measure.dynamics.damping import StructuralDamping
from foilstudy.measure.dynamics.response import interface_dynamic_stiffness
from foilstudy.measure.dynamics.structure import bordered
from foilstudy.measure.dynamics.truth import full_order
from foilstudy.measure.stiffness import Rings
from foilstudy.measure.stiffness.rings import interface_rigid_modes, rigid_motion
from foilstudy.model.patch import RING_ROWS, cylinder_control_points
from foilstudy.pipeline.method import Mesh
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.structures import in_air, stress_free_structure
from foilstudy.study.published import foil
from foilstudy.study.sweep.crumple import crumple_job
from foilstudy.study.sweep.cube import gather
from foilstudy.study.sweep.cylinder import cylinder_bounds
from foilstudy.study.sweep.export import contents_of
from foilstudy.study.sweep.origins import cell_folder
from foilstudy.study.sweep.respond import respond_job

OPTIONS = DynamicsOptions(highest_hz=120.0, frequencies=12, eigenfrequencies=4, mode_shapes=1)
SEALED = AddedMass(1.2, SealedIsothermal())


@pytest.fixture(scope="module")
def rough():
    """A foil of 50 um on a coarse mesh, with folds of a few millimetres that ring rows lack."""
    thin, mesh = foil(50), Mesh(0.016)
    patch = mesh.patch(thin)
    rng = np.random.default_rng(1)
    points = cylinder_control_points(patch, thin.diameter)
    points[2] *= thin.gap_height / thin.reference_height
    points[:, RING_ROWS:-RING_ROWS] += 2e-3 * rng.standard_normal(
        (3, patch.rows - 2 * RING_ROWS, patch.columns)
    )
    reference = cylinder_control_points(patch, thin.diameter)
    return Shape(thin, patch, points, reference, mesh.element_at_work())


@pytest.fixture(scope="module")
def structure(rough):
    return stress_free_structure(rough)


@pytest.fixture(scope="module")
def wet(rough, structure):
    return in_air(rough, structure, SEALED)


def surface_of(shape):
    return WettedSurface(shape.patch, shape.points)


# the air of a wave


def test_a_short_wave_sees_a_plane():
    n, k = np.array([0, 30, 60]), np.array([800.0, 700.0, 500.0])
    plane = 1 / np.hypot(n / 0.1, k)
    np.testing.assert_allclose(inside(n, k, 0.1), plane, rtol=0.012)
    np.testing.assert_allclose(outside(n, k, 0.1), plane, rtol=0.012)
    # curvature adds inside what it takes outside
    np.testing.assert_allclose(inside(n, k, 0.1) + outside(n, k, 0.1), 2 * plane, rtol=2e-4)


def test_a_long_cylinder_carries_the_mass_that_it_displaces():
    """Moving sideways, rho pi a2 a length, outside and inside: d = a at one wave around."""
    assert outside(1, np.array([0.0, 1e-4]), 0.1) == pytest.approx(0.1, rel=1e-6)
    assert inside(1, np.array([0.0, 1e-4]), 0.1) == pytest.approx(0.1, rel=1e-6)


def test_a_long_breathing_wave_moves_the_air_along_the_tube():
    k = 0.5
    assert inside(0, np.array([k]), 0.1) == pytest.approx(2 / (k**2 * 0.1), rel=1e-3)


def test_very_many_waves_around_are_finite():
    n = np.arange(1, 3000, 37)
    k = np.full(n.shape, 1e-3)
    np.testing.assert_allclose(outside(n, k, 0.1), 0.1 / n, rtol=1e-3)
    np.testing.assert_allclose(inside(n, k, 0.1), 0.1 / n, rtol=1e-3)


def test_lambs_clamped_circular_plate():
    """0.6689 rho a / (rho_p h) for one side of a baffled plate that moves as (1 - r2/a2)2.

    H. Lamb, On the vibrations of an elastic plate in contact with water, Proc. R. Soc. A 98 (1920)
    205-216.
    """
    k = 0.01 * (np.arange(20_000) + 0.5)
    transform = 8 * jv(3, k) / k**3  # int_0^1 (1 - r2)2 J0(k r) r dr
    mean_square = 0.1  # int_0^1 (1 - r2)4 r dr
    thickness = outside(0, k, 1e4)
    factor = 0.01 * (transform**2 * thickness * k).sum() / mean_square
    assert factor == pytest.approx(0.6689, rel=2e-4)


# the air of a wall


def test_waves_are_orthonormal_and_their_air_is_positive():
    wall = Wall(64, 20, 0.1, 0.17)
    waves = Waves.on(wall)
    air = AirOfWaves.of(waves, cylinder_thickness(waves))
    gram = air.shapes.T @ air.shapes * wall.area / (wall.around * wall.along)
    np.testing.assert_allclose(gram, np.eye(len(gram)), atol=1e-12)
    assert air.weights.min() > 0 and air.local > 0


def test_a_wave_far_from_the_ends_has_the_air_of_an_endless_cylinder():
    wall = Wall(48, 240, 0.1, 1.6)
    n, m = 5, 24
    angle = 2 * np.pi * (np.arange(48) + 1) / 48
    height = np.arange(240) + 0.5
    wave = np.outer(np.cos(np.pi * m * height / 240), np.cos(n * angle)).ravel()
    waves = Waves.on(wall, 450)
    air = AirOfWaves.of(waves, cylinder_thickness(waves))
    # no mean over elements here, so their shortening of waves is taken back
    mean = np.sinc(n / 48) * np.sinc(0.5 * m / 240)
    part = air.shapes.T @ (wave * mean) * wall.area / wave.size
    found = air.local * (wave * mean) @ wave * mean + air.weights @ part**2 / wall.area * wave.size
    k = np.array([np.pi * m / 1.6])
    known = inside(n, k, 0.1) + outside(n, k, 0.1)
    assert found / (wave @ wave) == pytest.approx(float(known[0]), rel=0.01)


def test_more_waves_change_little(rough, structure):
    first = [
        lowest_modes(
            structure.stiffness.interior,
            in_air(rough, structure, AddedMass(waves=waves)).mass.interior,
            structure.static.factor, 1,
        ).eigenvalues[0]
        for waves in (40, 80)
    ]  # fmt: skip
    assert first[0] == pytest.approx(first[1], rel=0.01)


# flux and volume


def test_the_volume_is_that_of_the_cylinder():
    thin = foil(50)
    patch = Mesh(0.005).patch(thin)
    points = cylinder_control_points(patch, thin.diameter)
    expected = np.pi * 0.1**2 * thin.reference_height
    assert WettedSurface(patch, points).volume == pytest.approx(expected, rel=3e-4)


def test_swept_volume_is_the_derivative_of_the_volume(rough):
    rng = np.random.default_rng(2)
    rings = Rings.of(rough.patch, rough.points)
    interior, ends = surface_of(rough).swept(rings)
    moved, motion = rng.standard_normal(interior.size), rng.standard_normal(12)
    step = 1e-5

    def volume(amount):
        flat = rough.points.transpose(1, 2, 0).ravel().copy()
        flat[rings.interior] += amount * moved
        flat[rings.boundary] += amount * (rings.motion @ motion)
        points = flat.reshape(rough.patch.rows, rough.patch.columns, 3).transpose(2, 0, 1)
        return WettedSurface(rough.patch, points).volume

    slope = (volume(step) - volume(-step)) / (2 * step)
    assert slope == pytest.approx(interior @ moved + ends @ motion, rel=1e-6)


def test_rigid_motion_sweeps_no_volume(rough):
    rings = Rings.of(rough.patch, rough.points)
    interior, ends = surface_of(rough).swept(rings)
    heights = rough.points[2]
    low, high = heights[:RING_ROWS].mean(), heights[-RING_ROWS:].mean()
    arms = rough.points.reshape(3, -1).T - [0, 0, low]
    whole = interior @ rigid_motion(arms)[rings.interior] + ends @ interface_rigid_modes(high - low)
    assert np.abs(whole).max() < 1e-12 * np.abs(ends).max() + 1e-14
    assert ends[8] > 0.9 * np.pi * 0.1**2 / 2  # the upper plate alone


# in a structure


def test_vacuum_and_no_density_are_the_structure_itself(rough, structure):
    assert in_air(rough, structure, Vacuum()) is structure
    assert in_air(rough, structure, AddedMass(0.0)) is structure
    assert in_air(rough, structure, AddedMass(0.0, SealedIsothermal(0.0))) is structure


def test_added_mass_is_positive_and_proportional_to_density(rough, structure):
    def added(density):
        mass = in_air(rough, structure, AddedMass(density)).mass
        return bordered(mass).toarray() - bordered(structure.mass).toarray()

    one = added(1.0)
    np.testing.assert_allclose(added(3.0), 3 * one, atol=1e-9 * np.abs(one).max())
    values = np.linalg.eigvalsh(one)
    assert values.min() > -1e-12 * values.max() and values.max() > 0


def test_a_foil_that_moves_sideways_carries_less_than_it_displaces_outside(rough, structure):
    """Inside all of the air, outside the part that does not flow past the ends of the foil."""
    thin = rough.foil
    patch = Mesh(0.01).patch(thin)
    straight = cylinder_control_points(patch, thin.diameter)
    smooth = Shape(thin, patch, straight, straight, rough.element)
    mass = in_air(smooth, stress_free_structure(smooth), AddedMass(1.0)).mass
    bare = stress_free_structure(smooth).mass
    shift = np.zeros((mass.interior.shape[0] + 12, 2))
    shift[:-12][0::3, 0] = shift[:-12][1::3, 1] = 1.0
    shift[[-12, -6], 0] = shift[[-11, -5], 1] = 1.0
    carried = np.diag(shift.T @ ((bordered(mass) @ shift) - (bordered(bare) @ shift)))
    enclosed = WettedSurface(patch, straight).volume
    assert carried[0] == pytest.approx(carried[1], rel=1e-6)
    assert 1.4 * enclosed < carried[0] < 1.8 * enclosed
    spin = np.zeros((mass.interior.shape[0] + 12, 1))
    motion = rigid_motion(straight.reshape(3, -1).T)[:, 5]
    rings = Rings.of(patch, straight)
    spin[:-12, 0], spin[[-7, -1], 0] = motion[rings.interior], 1.0
    assert np.abs(spin.T @ (bordered(mass) @ spin - bordered(bare) @ spin)) < 1e-12 * enclosed


def test_a_straight_sealed_cylinder_is_an_air_spring():
    """gamma p A2 / V, of a thick wall that does not grow wider when it is pressed."""
    thick = foil(5000)
    thick = replace(thick, material=replace(thick.material, poisson_ratio=0.0))
    patch = Mesh(0.016).patch(thick)
    straight = cylinder_control_points(patch, thick.diameter)
    shape = Shape(thick, patch, straight, straight, Mesh(0.016).element_at_work())
    dry = stress_free_structure(shape)
    surface = WettedSurface(patch, straight)
    area = surface.plates[8]
    for enclosure, exponent in ((SealedIsothermal(), 1.0), (SealedAdiabatic(), 1.4)):
        stiffer = in_air(shape, dry, AddedMass(0.0, enclosure)).static.stiffness
        spring = exponent * 101_325 * area**2 / surface.volume
        assert stiffer[8, 8] - dry.static.stiffness[8, 8] == pytest.approx(spring, rel=0.01)
        sideways = stiffer[6, 6] - dry.static.stiffness[6, 6]
        assert abs(sideways) < 1e-6 * spring


def test_the_sealed_term_is_the_second_derivative_of_the_energy_of_the_air(rough, structure):
    rng = np.random.default_rng(3)
    rings = Rings.of(rough.patch, rough.points)
    surface = surface_of(rough)
    interior, ends = surface.swept(rings)
    stiff = in_air(rough, structure, AddedMass(0.0, SealedAdiabatic(9e4))).stiffness
    moved = rng.standard_normal((interior.size + 12, 1))
    gain = moved.T @ (bordered(stiff) @ moved - bordered(structure.stiffness) @ moved)
    swept = np.concatenate([interior, ends]) @ moved[:, 0]
    assert gain[0, 0] == pytest.approx(1.4 * 9e4 / surface.volume * swept**2, rel=1e-6)


def test_every_reduction_knows_the_air(wet):
    """Against the whole structure, solved directly."""
    damping = StructuralDamping(0.1)
    frequencies = np.array([3.0, 60.0, 110.0])
    exact = full_order(wet, frequencies, damping)
    for name in REDUCTIONS:
        options = replace(OPTIONS, damping=damping, reduction=name, tolerance=0.01)
        model = options.reduced(wet)
        valid = frequencies[frequencies <= model.valid_to_hz]
        assert valid.size >= (1 if name == "guyan" else 2)
        reduced = interface_dynamic_stiffness(model, valid, damping)
        for axis in (2, 8):
            found, known = reduced[:, axis, 8], exact[: valid.size, axis, 8]
            np.testing.assert_allclose(found, known, rtol=0.02)


def test_modes_in_air_are_those_of_dense_matrices(wet, structure):
    stiffness, mass = wet.stiffness.interior, wet.mass.interior
    assert isinstance(mass, Updated) and isinstance(stiffness, Updated)
    values = eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)
    first = lowest_modes(stiffness, mass, wet.static.factor, 5)
    np.testing.assert_allclose(first.eigenvalues, values[:5], rtol=1e-8)
    below = modes_below(stiffness, mass, 0.5 * (values[11] + values[12]))
    np.testing.assert_allclose(below.eigenvalues, values[:12], rtol=1e-6)
    dry = lowest_modes(
        structure.stiffness.interior, structure.mass.interior, structure.static.factor, 1
    )
    assert first.eigenvalues[0] < dry.eigenvalues[0]


# configuration


def config(**air):
    return load_config(
        {"sweep": {"thickness_um": [50.0], "overlength_percent": [30.0]}, "air": air}
    )


def test_a_configuration_chooses_the_air():
    assert isinstance(air_of(config().air), Vacuum)
    chosen = config(
        kind="added_mass", density_kg_m3=1.0, enclosed="sealed_adiabatic", pressure_kpa=90
    )
    assert air_of(chosen.air) == AddedMass(1.0, SealedAdiabatic(90e3))
    assert air_of(config(kind="added_mass").air) == AddedMass(1.2, Vented())
    assert len(AIRS) == 3 and len(ENCLOSURES) == 3
    with pytest.raises(ConfigError, match="no air to enclose; set air.kind"):
        config(enclosed="sealed_isothermal")
    with pytest.raises(ConfigError, match="whose ends are open; set air.kind"):
        config(kind="added_mass_true_surface", enclosed="sealed_adiabatic")


# matrices with a term of low rank


def test_a_term_of_low_rank_is_factored_as_the_dense_sum():
    rng = np.random.default_rng(4)
    plain = sparse.diags([np.full(59, -1.0), np.linspace(-1, 4, 60), np.full(59, -1.0)], [-1, 0, 1])
    factors = rng.standard_normal((60, 5))
    matrix = updated(plain.tocsr(), factors, np.array([3.0, -2.0, 1e-3, -7.0, 0.5]))
    factor = factorise(matrix)
    dense = matrix.toarray()
    block = rng.standard_normal((60, 3))
    np.testing.assert_allclose(factor.solve(block), np.linalg.solve(dense, block), rtol=1e-8)
    np.testing.assert_allclose(factor.solve(block[:, 0]), factor.solve(block)[:, 0], rtol=1e-12)
    assert factor.negative_eigenvalues == (np.linalg.eigvalsh(dense) < 0).sum()
    both = combined(2.0, plain.tocsr(), -0.5, matrix)
    np.testing.assert_allclose(both.toarray(), 2 * plain.toarray() - 0.5 * dense, atol=1e-12)
    np.testing.assert_allclose(both @ block, both.toarray() @ block, atol=1e-12)


# panels on any surface


def disc(radius, rings, around):
    """Quadrilaterals of a plane disc, those in the middle with two corners in one place."""
    r = radius * np.linspace(0, 1, rings + 1)
    angle = 2 * np.pi * np.arange(around + 1) / around
    place = np.stack([np.outer(r, np.cos(angle)), np.outer(r, np.sin(angle))], axis=-1)
    place = np.concatenate([place, np.zeros((*place.shape[:2], 1))], axis=-1)
    corners = [place[:-1, :-1], place[1:, :-1], place[1:, 1:], place[:-1, 1:]]
    return np.stack(corners, axis=2).reshape(-1, 4, 3)


def areas(corners):
    diagonals = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    return 0.5 * np.linalg.norm(np.cross(*diagonals), axis=1)


def test_a_disc_that_moves_broadside():
    """8/3 rho a3: H. Lamb, Hydrodynamics, section 102."""
    found = []
    for rings in (8, 16):
        corners = disc(1.0, rings, 3 * rings)
        found.append(areas(corners) @ np.linalg.solve(influence(corners), np.ones(len(corners))))
    assert 2 * found[1] - found[0] == pytest.approx(8 / 3, rel=0.02)


def test_a_drumhead_in_air():
    """Frequencies of a timpani membrane without its kettle, over that of mode (1,1), measured.

    Mylar of 0.19 mm, 0.656 m across: T. D. Rossing, Acoustics of timpani, Percussionist 19 (1982)
    18-31. The real head lies in its rim, between one in the open and one in a wall.
    """
    measured = np.array([0.53, 1.0, 1.48, 1.92, 2.36, 2.78])
    radius, areal, rings = 0.328, 1390 * 0.19e-3, 12
    corners = disc(radius, rings, 3 * rings)
    area, middle = areas(corners), corners.mean(axis=1)
    r, angle = np.hypot(*middle.T[:2]) / radius, np.arctan2(middle[:, 1], middle[:, 0])
    inverse = np.linalg.inv(influence(corners))
    k = 0.02 * (np.arange(5_000) + 0.5)
    plane = outside(0, k, 1e6)
    in_the_open, in_a_wall, vacuum = [], [], []
    for n in range(6):
        roots = jn_zeros(n, 3)
        shapes = jv(n, np.outer(r, roots)) * np.cos(n * angle)[:, None]
        gram = np.diag(shapes.T @ (area[:, None] * shapes))
        carried = shapes.T @ (area[:, None] * (inverse @ shapes))
        transforms = [-x * jv(n - 1, x) * jv(n, k) / (x**2 - k**2) for x in roots]
        waves = 2 * radius * 0.02 * np.array(transforms) * plane * k @ np.transpose(transforms)
        squares = 0.5 * jv(n + 1, roots) ** 2
        for found, square, air in (
            (in_the_open, gram, 0.5 * (carried + carried.T)), (in_a_wall, squares, waves),
        ):  # fmt: skip
            heavy = np.diag(areal * square) + 1.2 * air
            found.append(np.sqrt(eigh(np.diag(roots**2 * square), heavy, eigvals_only=True)[0]))
        vacuum.append(roots[0])
    vacuum, in_the_open, in_a_wall = (
        np.array(each) / each[1] for each in (vacuum, in_the_open, in_a_wall)
    )
    assert (np.abs(vacuum / measured - 1)[[0, 2, 3, 4, 5]] > 0.09).all()
    np.testing.assert_allclose(in_the_open, measured, rtol=0.04)
    np.testing.assert_allclose(in_a_wall[1:], measured[1:], rtol=0.02)
    # the whole of the head moves one way: here the wall matters most
    assert in_a_wall[0] < measured[0] < in_the_open[0]


def test_panels_and_waves_agree_about_a_straight_cylinder():
    """Where its ends are far in waves, and open or not makes little difference."""
    thin = foil(50)
    patch = Mesh(0.014).patch(thin)
    surface = WettedSurface(patch, cylinder_control_points(patch, thin.diameter))
    waves = Waves.on(surface.wall)
    short = np.flatnonzero((waves.n >= 6) & (waves.m >= 2))
    closed, opened = AddedMass().thickness(waves, surface), TrueSurface().thickness(waves, surface)
    ratio = np.diag(opened)[short] / np.diag(closed)[short]
    assert short.size > 20 and 0.9 < ratio.min() and ratio.max() < 1.1


def test_a_surface_of_too_many_panels_is_refused(structure, rough):
    fine = rough.refined().refined().refined()
    with pytest.raises(Refusal, match="use air.kind: added_mass, or larger"):
        in_air(fine, structure, TrueSurface())


def test_the_crumpled_surface_has_about_the_air_of_the_cylinder(rough, structure):
    first = [
        lowest_modes(
            structure.stiffness.interior,
            in_air(rough, structure, kind()).mass.interior,
            structure.static.factor, 1,
        ).eigenvalues[0]
        for kind in (AddedMass, TrueSurface)
    ]  # fmt: skip
    assert first[0] == pytest.approx(first[1], rel=0.1)


# a study


def test_a_study_in_air(tmp_path):
    changes = {
        "sweep": {"thickness_um": [100], "reference_height_mm": [143], "realisations": 1},
        "air": {"kind": "added_mass", "enclosed": "sealed_adiabatic"},
    }
    study = load_config(sections_with(**changes))
    (cell,) = study.cells()
    place = cell_folder(tmp_path, cell)
    crumple_job(study.crumple_task(cell), place / "crumple.nc")
    task = study.response_task(cell)
    respond_job(task, place / "crumple.nc", place / "response.nc")
    cylinder_bounds(study, tmp_path / "cylinder.nc")
    cube = gather(study, tmp_path, tmp_path / "cube.nc").isel(thickness=0, overlength=0, seed=0)
    assert cube.status.item() == "converged"
    ratio = cube.first_eigenfrequency.item() / cube.vacuum_first_eigenfrequency.item()
    assert 0.8 < ratio < 0.99
    assert cube.enclosed_volume.units == "l"
    assert cube.enclosed_volume.item() == pytest.approx(np.pi * 1.3, rel=0.1)
    # the static stiffness is the foil's; what the enclosed air adds shows at the lowest frequency
    low = cube.dynamic_stiffness_re.sel(direction="axial", definition="relative")[0].item()
    assert low > cube.static_stiffness.sel(direction="axial").item() + 1e3
    model = contents_of(task, place / "crumple.nc").model
    assert model.clamped_eigenfrequencies()[0] == pytest.approx(
        cube.first_eigenfrequency.item(), rel=1e-3
    )
