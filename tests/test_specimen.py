"""Seam, uneven thickness, rings out of true and weight of a specimen."""

from dataclasses import replace

import numpy as np
import pytest

from foilstudy.base.errors import Refusal
from foilstudy.base.spec import dumped, loaded
from foilstudy.config import StudyConfig
from foilstudy.config.foils import foil_of
from foilstudy.export.energies import element_energies
from foilstudy.model.foil import Foil, Imperfection
from foilstudy.model.materials import material
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.specimen import Clamps, Seam, Specimen, Unevenness
from foilstudy.model.specimen.clamps import clamped_shape
from foilstudy.model.specimen.variation import seam_share, thickness_field, variation_of
from foilstudy.pipeline.crumple import crumple, uncrumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.structures import mass
from foilstudy.solve.paths.newton import NewtonPath
from foilstudy.solve.paths.relaxation import RelaxationPath

FEP = material("FEP")
MESH = Mesh(18e-3)
IDEAL = Specimen()
BOTH = Specimen(seam=Seam(0.02, 2.0, 1.5), unevenness=Unevenness(0.1, 0.03, seed=3))
ELEMENTS = ("corner", "one_point")


def foil(specimen=IDEAL):
    return Foil(0.2, 0.17, 0.13, 500e-6, FEP, specimen)


def start(specimen, element="corner"):
    return uncrumpled(foil(specimen), replace(MESH, element=element))


def moved(shape, size=4e-3):
    rng = np.random.default_rng(1)
    return shape.reference + size * rng.normal(size=shape.reference.shape)


@pytest.mark.parametrize("element", ELEMENTS)
def test_force_of_an_uneven_foil_is_the_derivative_of_its_energy(element):
    shape = start(BOTH, element)
    points, way = moved(shape), moved(shape) - shape.reference
    force = np.empty_like(points)
    shape.stressed.force(points, force)
    h = 1e-4
    high, low = (shape.stressed.energies(points + s * h * way).total for s in (1, -1))
    assert (high - low) / (2 * h) == pytest.approx(np.sum(force * way), rel=1e-6)


@pytest.mark.parametrize("element", ELEMENTS)
def test_tangent_of_an_uneven_foil_is_the_derivative_of_its_force(element):
    shape = start(BOTH, element)
    points, way = moved(shape), moved(shape) - shape.reference
    high, low = np.empty_like(points), np.empty_like(points)
    h = 1e-5
    shape.stressed.force(points + h * way, high)
    shape.stressed.force(points - h * way, low)
    expected = np.moveaxis(high - low, 0, -1).ravel() / (2 * h)
    found = shape.stressed.tangent(points) @ np.moveaxis(way, 0, -1).ravel()
    assert np.abs(found - expected).max() < 1e-6 * np.abs(expected).max()


def test_a_rigid_motion_of_an_uneven_foil_costs_nothing():
    shape = start(BOTH)
    c, s = np.cos(0.7), np.sin(0.7)
    turn = np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    turned = np.einsum("ab,bji->aji", turn, shape.reference) + 0.3
    scale = shape.stressed.energies(moved(shape)).total
    assert shape.stressed.energies(turned).total < 1e-15 * scale


@pytest.mark.parametrize("element", ELEMENTS)
def test_an_element_is_as_stiff_as_its_own_thickness_makes_it(element):
    """Each element of the mixture has the energies of an even foil of its thickness."""
    shape = start(BOTH, element)
    points = moved(shape, 1e-3)
    mixed = element_energies(shape.stressed, points)
    varied = shape.stressed.section.variation
    for place in ((4, 0), (2, 7), (6, 12)):
        own = replace(
            shape.foil,
            thickness=shape.foil.thickness * varied.thickness[place],
            material=replace(FEP, youngs_modulus=FEP.youngs_modulus * varied.modulus[place]),
            specimen=Specimen(),
        )
        even = element_energies(replace(shape, foil=own).stressed, points)
        assert mixed[(slice(None), *place)] == pytest.approx(even[(slice(None), *place)], rel=1e-9)


def test_the_energies_of_elements_add_up():
    shape = start(BOTH)
    points = moved(shape)
    parts = shape.stressed.energies(points)
    assert element_energies(shape.stressed, points).sum(axis=(1, 2)) == pytest.approx(
        [parts.membrane, parts.bending, parts.stabilisation], rel=1e-9
    )


def test_a_seam_like_the_foil_changes_no_bit():
    plain, seamed = start(IDEAL), start(Specimen(seam=Seam(0.02)))
    points, forces = moved(plain), []
    for shape in (plain, seamed):
        forces.append(np.empty_like(points))
        shape.stressed.force(points, forces[-1])
    assert np.array_equal(*forces)


def test_an_uneven_foil_crumples_with_the_stability_of_its_thickest_part():
    method = Method(RelaxationPath(ramp_steps=300))
    heavy = foil(Specimen(seam=Seam(0.03, 4.0), clamps=Clamps(2e-3, 0.01), gravity=9.81))
    crumpled = crumple(heavy, MESH, Imperfection(seed=1), method)
    assert crumpled.status == "converged"
    axial, radial = crumpled.stiffness()
    assert min(axial, radial) > 0
    again = loaded(Foil, dumped(heavy))
    assert again == heavy


def test_the_seam_covers_its_width():
    patch = start(IDEAL).patch
    for width in (0.001, 0.02, 0.05):
        covered = seam_share(Seam(width), patch)
        assert covered.sum() * patch.size_around == pytest.approx(width)
        assert covered[0] == pytest.approx(covered[-2])  # the same to both sides of the x axis
    assert covered[-1] == 1.0


def test_thickness_is_one_field_on_all_meshes_and_bounded():
    uneven = Unevenness(0.2, 0.03, seed=5)
    shape = uncrumpled(foil(Specimen(Seam(0.02, 1.5), uneven)), Mesh(6e-3))
    fields = [each.stressed.section.variation.thickness for each in (shape, shape.refined())]
    along, around = fields[0].shape
    mean = fields[1].reshape(along, 2, around, 2).mean(axis=(1, 3))
    assert np.abs(mean - fields[0]).max() < 0.02
    assert np.abs(np.roll(mean, 1, axis=1) - fields[0]).max() > 0.1
    coarse = shape.patch
    on_coarse = thickness_field(uneven, coarse)
    assert 0.6 - 1e-12 <= on_coarse.min() and on_coarse.max() <= 1.4 + 1e-12
    assert 0.1 < on_coarse.std() < 0.3
    assert not np.allclose(thickness_field(replace(uneven, seed=6), coarse), on_coarse)


def test_mass_follows_thickness_and_weight_is_mass_times_gravity():
    seamed = start(Specimen(seam=Seam(0.05, 3.0), gravity=9.81))
    areas = seamed.stressed.section.areas
    expected = FEP.density * 500e-6 * areas.sum() * (1 + 2 * 0.05 / (np.pi * 0.2))
    masses = seamed.stressed.section.masses
    assert masses.sum() == pytest.approx(expected, rel=1e-4)
    expected = masses.sum()
    whole = mass(seamed)
    assert whole.interface[2, 2] > 0
    problem = seamed.problem()
    points, force = moved(seamed), np.empty_like(seamed.points)
    bare = np.empty_like(force)
    problem.force(points, force)
    seamed.stressed.force(points, bare)
    weight = force - bare  # the gradient of the potential
    assert weight.sum(axis=(1, 2)) == pytest.approx([0, 0, 9.81 * expected], rel=1e-9, abs=1e-9)
    lifted = points + np.array([0.0, 0.0, 0.01])[:, None, None]
    rise = problem.value(lifted) - problem.value(points)
    assert rise == pytest.approx(9.81 * expected * 0.01, rel=1e-6)


def test_rings_out_of_true_keep_what_their_rows_have_to_each_other():
    cylinder = start(IDEAL).reference
    shape = clamped_shape(Clamps(3e-3, 0.02), cylinder)
    oval = clamped_shape(Clamps(3e-3), cylinder)
    for rows in (slice(0, RING_ROWS), slice(-RING_ROWS, None)):
        assert np.ptp(np.hypot(*oval[:2, rows]), axis=0).max() < 1e-15  # alike
        apart, before = (
            np.linalg.norm(each[:, rows] - each[:, rows][:, :1, :1], axis=0)
            for each in (shape, oval)
        )
        assert np.abs(apart - before).max() < 1e-12  # a rigid motion
    assert np.array_equal(shape[:, :RING_ROWS], oval[:, :RING_ROWS])  # tilted is the top alone
    top = shape[2, -RING_ROWS:].mean(axis=0)
    assert np.ptp(top) == pytest.approx(2 * np.sin(0.02) * 0.103, rel=0.01)
    wide, narrow = np.ptp(oval[0, 4]), np.ptp(oval[1, 4])
    assert wide - narrow == pytest.approx(4 * 3e-3, rel=0.05)
    arcs = [
        np.linalg.norm(each[:, 4] - np.roll(each[:, 4], 1, axis=1), axis=0)
        for each in (oval, cylinder)
    ]
    assert np.abs(arcs[0] / arcs[1] - 1).max() < 2e-3  # bent, not stretched, to first order
    assert clamped_shape(Clamps(), cylinder) is cylinder


@pytest.mark.parametrize(
    "specimen, method, words",
    [
        (Specimen(clamps=Clamps(tilt=0.01)), Method(NewtonPath()), "true rings"),
        (Specimen(clamps=Clamps(ellipticity=0.05)), None, "bends rings"),
    ],
)
def test_what_does_not_go_together_is_refused(specimen, method, words):
    with pytest.raises(Refusal, match=words):
        uncrumpled(foil(specimen), MESH, None, method)


@pytest.mark.parametrize(
    "make",
    [
        lambda: Seam(-1e-3),
        lambda: Seam(1e-3, 0.0),
        lambda: Unevenness(0.5),
        lambda: Clamps(tilt=1.0),
        lambda: Specimen(gravity=np.nan),
    ],
)
def test_what_no_specimen_has_is_refused(make):
    with pytest.raises(Refusal):
        make()


def test_an_even_foil_has_no_variation():
    patch = start(IDEAL).patch
    assert variation_of(Specimen(seam=Seam(0.0, 3.0)), patch, None) is None


def study(**sections):
    sweep = {"thickness_um": [500], "reference_height_mm": [170], "realisations": 2}
    return StudyConfig.model_validate({"sweep": sweep, **sections})


def test_a_configuration_says_it_in_millimetres():
    keys = {
        "seam_width_mm": 5.0,
        "seam_thickness_factor": 2.0,
        "seam_modulus_factor": 1.5,
        "thickness_deviation_percent": 10.0,
        "thickness_correlation_mm": 20.0,
        "ring_ellipticity_mm": 2.0,
        "ring_tilt_deg": 1.0,
        "gravity_m_s2": 9.81,
    }
    configured = study(specimen=keys)
    for k, cell in enumerate(configured.cells()):
        for task in (configured.crumple_task(cell), configured.response_task(cell)):
            assert foil_of(task).specimen == Specimen(
                Seam(5e-3, 2.0, 1.5),
                Unevenness(0.1, 0.02, seed=k),
                Clamps(2e-3, np.radians(1.0)),
                9.81,
            )
    assert foil_of(study().crumple_task(study().cells()[0])).specimen == IDEAL


def test_constants_are_drawn_from_their_range_for_each_realisation():
    drawn = study(specimen={"youngs_modulus_range_mpa": [400, 600]})
    moduli = [foil_of(drawn.crumple_task(cell)).material.youngs_modulus for cell in drawn.cells()]
    again = [foil_of(drawn.response_task(cell)).material.youngs_modulus for cell in drawn.cells()]
    assert moduli == again and moduli[0] != moduli[1]
    assert all(400e6 <= modulus <= 600e6 for modulus in moduli)
    cell = drawn.cells()[0]
    assert foil_of(drawn.crumple_task(cell)).material.yield_stress == FEP.yield_stress


@pytest.mark.parametrize(
    "sections, words",
    [
        ({"specimen": {"seam_thickness_factor": 2.0}}, "no seam"),
        ({"specimen": {"seam_width_mm": 700.0}}, "narrower"),
        ({"specimen": {"youngs_modulus_range_mpa": [600, 400]}}, "rising"),
        ({"specimen": {"ring_tilt_deg": 1.0}, "method": {"path": "newton"}}, "true rings"),
        ({"specimen": {"ring_ellipticity_mm": -60}}, "ring_ellipticity_mm bends rings"),
        (
            {"specimen": {"ring_tilt_deg": 10}, "sheet": {"gap_height_mm": 20}},
            "ring_tilt_deg brings the rings",
        ),
        ({"specimen": {"seam_width_mm": 5.0}, "export": {"formats": ["calculix"]}}, "calculix"),
    ],
)
def test_a_configuration_that_does_not_fit_is_refused(sections, words):
    with pytest.raises(ValueError, match=words):
        study(**sections)
