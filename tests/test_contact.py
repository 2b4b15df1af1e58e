"""Self-contact: a barrier between parts of a sheet that come near each other."""

from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from conftest import DIAMETER, FEP, GAP_HEIGHT, imperfect_sheet, rotation

from foilstudy.base.errors import Refusal
from foilstudy.linalg import SolveError
from foilstudy.model.contact.barrier import PARALLEL, pair_energy, pair_hessian
from foilstudy.model.contact.candidates import Balls, candidates
from foilstudy.model.contact.distance import closest
from foilstudy.model.contact.followed import FollowedPairs
from foilstudy.model.contact.options import BarrierContact
from foilstudy.model.contact.pairs import distances
from foilstudy.model.contact.planes import RingPlanes
from foilstudy.model.contact.surface import triangulation
from foilstudy.model.contact.term import SelfContact
from foilstudy.model.contact.windows import Windows
from foilstudy.model.foil import Foil
from foilstudy.model.patch import Patch, knot_points
from foilstudy.model.shell.intersection import self_crossing_share
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.solve.paths.newton import NewtonPath
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.solve.problem import Problem
from foilstudy.solve.relaxation.mass.spectral import SpectralMassScaling
from foilstudy.solve.relaxation.mass.touching import minding_contact
from foilstudy.solve.relaxation.scheme import Scheme
from foilstudy.study.sweep import warmup

THICKNESS, REACH = 1e-4, 1e-3
SPAN = (THICKNESS + REACH) ** 2 - THICKNESS**2

# ------------------------------------------------------------------ one pair


def energy_of(x, edges, full):
    gradient = np.empty((4, 3))
    scratch = np.empty(4), np.empty((2, 4)), np.empty(3)
    return pair_energy(x, edges, full, THICKNESS, SPAN, *scratch, gradient), gradient


def hessian_of(x, edges, full):
    out = np.empty((12, 12))
    pair_hessian(x, edges, full, THICKNESS, SPAN, np.empty(4), np.empty((2, 4)), np.empty(3), out)
    return out


def kind_of(x, edges):
    """Which points the closest vector hangs on."""
    weights = np.empty(4)
    closest(x, edges, weights, np.empty((2, 4)), np.empty(3))
    return tuple(np.flatnonzero(weights))


POINT_TRIANGLE = [(0, *side) for size in (1, 2, 3) for side in combinations((1, 2, 3), size)]
EDGES = [
    (*one, *other) for one in ((0,), (1,), (0, 1)) for other in ((2,), (3,), (2, 3))
]  # fmt: skip
KINDS = [
    *((False, kind, False) for kind in POINT_TRIANGLE),
    *((True, kind, parallel) for kind in EDGES for parallel in (False, True)),
]


def pair_of(edges, kind, seed=0, distance=0.6e-3, side=8e-3):
    """Random points whose closest vector, of the given length, hangs on the points of `kind`."""
    rng = np.random.default_rng(seed)
    while True:
        x = side * rng.standard_normal((4, 3))
        weights, w = np.empty(4), np.empty(3)
        closest(x, edges, weights, np.empty((2, 4)), w)
        split = 2 if edges else 1
        x[:split] += w / np.linalg.norm(w) * (distance - np.linalg.norm(w))
        if kind_of(x, edges) == kind:
            return x


@pytest.mark.parametrize(("edges", "kind", "parallel"), KINDS)
def test_gradient_and_hessian_of_every_kind_of_pair(edges, kind, parallel):
    x = pair_of(edges, kind)
    u, v = x[1] - x[0], x[3] - x[2]
    sine = np.sum(np.cross(u, v) ** 2)
    full = 3 * sine if parallel else 0.5 * sine
    _, gradient = energy_of(x, edges, full)
    hessian = hessian_of(x, edges, full)
    assert np.abs(gradient).max() > 0
    step = 1e-8
    slopes, bends = np.empty(12), np.empty((12, 12))
    for i in range(12):
        shift = np.zeros(12)
        shift[i] = step
        ahead, behind = x + shift.reshape(4, 3), x - shift.reshape(4, 3)
        assert kind_of(ahead, edges) == kind_of(behind, edges) == kind
        (high, rise), (low, fall) = energy_of(ahead, edges, full), energy_of(behind, edges, full)
        slopes[i] = (high - low) / (2 * step)
        bends[i] = (rise - fall).ravel() / (2 * step)
    assert np.abs(slopes - gradient.ravel()).max() < 1e-6 * np.abs(gradient).max()
    assert np.abs(bends - hessian).max() < 1e-6 * np.abs(hessian).max()
    assert np.abs(hessian - hessian.T).max() < 1e-12 * np.abs(hessian).max()
    # nothing but the distance counts: no net force, no moment
    assert np.abs(gradient.sum(axis=0)).max() < 1e-12 * np.abs(gradient).max()
    moment = np.cross(x, gradient).sum(axis=0)
    assert np.abs(moment).max() < 1e-9 * np.abs(x).max() * np.abs(gradient).max()


@pytest.mark.parametrize("edges", [False, True])
def test_barrier_begins_at_the_reach_and_has_no_bound_at_the_thickness(edges):
    kind = (0, 1, 2, 3)
    values = []
    for distance in (THICKNESS + REACH, THICKNESS + 0.999 * REACH, THICKNESS * (1 + 1e-9)):
        x = pair_of(edges, kind, distance=distance * (1 + 1e-12))
        values.append(energy_of(x, edges, 0.0 if not edges else 1e-30)[0])
    assert values[0] == 0.0
    assert 0.0 < values[1] < 1e-6
    assert values[2] > 15  # -ln of the share of the span that is left
    assert np.isinf(energy_of(pair_of(edges, kind, distance=0.99 * THICKNESS), edges, 1e-30)[0])


def test_parallel_edges_exert_nothing():
    x = np.array([[0, 0, 0], [1e-2, 0, 0], [-2e-3, 0, 5e-4], [7e-3, 0, 5e-4]])
    value, gradient = energy_of(x, True, PARALLEL * 1e-4 * 8.1e-5)
    assert value == 0.0
    assert np.abs(gradient).max() < 1e-12 / REACH  # rounding of the cross product


# ------------------------------------------------------------------ the term


def flattened(rough=4e-5, thickness=THICKNESS, half_gap=5e-4):
    """A cylinder pressed flat, not quite, and its sheet."""
    patch = Patch(24, 6, np.pi * DIAMETER / 24, 0.02)
    angle = 2 * np.pi * (np.arange(24) + 0.5) / 24
    points = np.empty(patch.shape)
    points[0] = 0.15 * np.cos(angle)
    points[1] = half_gap * np.sign(np.sin(angle))
    points[2] = 0.02 * (np.arange(patch.rows) - 0.5)[:, None]
    points[0] += 0.2 * points[2]  # so that edges do not lie on edges
    points += rough * np.random.default_rng(1).standard_normal(points.shape)
    return Shell.elastic(patch, points, FEP, thickness), points


@pytest.fixture(scope="module")
def pressed():
    sheet, points = flattened()
    return SelfContact(sheet.section), points


def test_gradient_is_the_derivative_of_the_energy(pressed):
    term, points = pressed
    force, scratch = np.empty_like(points), np.empty_like(points)
    energy = term.force(points, force)
    assert energy[0] > 0
    assert len(term.closed()) > 50
    for seed in range(3):
        way = np.random.default_rng(seed).standard_normal(points.shape)
        step = 1e-8
        ahead, behind = (term.force(points + s * step * way, scratch)[0] for s in (1, -1))
        assert (ahead - behind) / (2 * step) == pytest.approx(np.sum(force * way), rel=1e-5)


def test_tangent_is_the_derivative_of_the_gradient_and_symmetric(pressed):
    term, points = pressed
    tangent = term.tangent(points)
    assert abs(tangent - tangent.T).max() < 1e-12 * abs(tangent).max()
    for seed in range(3):
        way = np.random.default_rng(seed).standard_normal(points.shape)
        ahead, behind = np.empty_like(points), np.empty_like(points)
        step = 1e-9
        term.force(points + step * way, ahead)
        term.force(points - step * way, behind)
        slope = np.moveaxis(ahead - behind, 0, -1).ravel() / (2 * step)
        expected = tangent @ np.moveaxis(way, 0, -1).ravel()
        assert np.linalg.norm(slope - expected) < 1e-4 * np.linalg.norm(expected)


def test_action_is_reaction_and_a_rigid_motion_costs_nothing(pressed):
    term, points = pressed
    force, turned_force = np.empty_like(points), np.empty_like(points)
    energy = term.force(points, force)
    arms, forces = points.reshape(3, -1).T, force.reshape(3, -1).T
    assert np.abs(forces.sum(axis=0)).max() < 1e-10 * np.abs(forces).max()
    moment = np.cross(arms, forces).sum(axis=0)
    assert np.abs(moment).max() < 1e-10 * np.abs(forces).max()
    turn = rotation([1, 2, 3], 0.7)
    turned = np.einsum("ij,jrc->irc", turn, points) + np.array([0.1, -0.2, 0.3])[:, None, None]
    assert term.force(turned, turned_force)[0] == pytest.approx(energy[0], rel=1e-9)
    expected = np.einsum("ij,jrc->irc", turn, force)
    assert np.abs(turned_force - expected).max() < 1e-9 * np.abs(force).max()


def test_force_follows_from_the_shape_alone(pressed):
    term, points = pressed
    sheet, _ = flattened()
    force, again = np.empty_like(points), np.empty_like(points)
    for seed in range(12):  # far enough for the pairs to be sought anew
        way = np.random.default_rng(seed).standard_normal(points.shape)
        term.force(points + 3e-5 * way, force)
    here = term.force(points, force)
    fresh = SelfContact(sheet.section).force(points, again)
    assert here[0] == fresh[0]
    assert np.array_equal(force, again)


def test_nothing_near_means_exactly_nothing():
    sheet = imperfect_sheet(10e-3)
    term, force = SelfContact(sheet.section), np.empty(sheet.patch.shape)
    assert term.force(sheet.reference, force)[0] == 0.0
    assert not force.any()
    assert term.tangent(sheet.reference).nnz == 0


def all_pairs(surface):
    """Every point and triangle, and every two edges, that share no knot; whether they are edges."""
    points = np.repeat(np.arange(surface.count), len(surface.triangles))
    touching = np.column_stack([points, np.tile(surface.triangles, (surface.count, 1))])
    one, other = np.triu_indices(len(surface.edges), 1)
    crossing = np.column_stack([surface.edges[one], surface.edges[other]])
    apart = np.all(touching[:, 1:] != touching[:, :1], axis=1)
    free = np.all(crossing[:, :2, None] != crossing[:, None, 2:], axis=(1, 2))
    pairs = np.concatenate([touching[apart], crossing[free]])
    return pairs, np.arange(len(pairs)) >= apart.sum()


def brute_force(pairs, edges, knots, distance):
    """Those of all pairs that are near."""
    near = distances(knots, pairs, edges) < distance
    return {(bool(e), *map(int, p)) for p, e in zip(pairs[near], edges[near], strict=True)}


def found_by(followed):
    active = followed.active()
    pairs, edges = followed.pairs[active], followed.edges[active]
    near = [(bool(e), *map(int, pair)) for e, pair in zip(edges, pairs, strict=True)]
    assert len(near) == len(set(near))
    return set(near)


def test_no_pair_is_missed_however_the_knots_move():
    patch = Patch(10, 6, 0.02, 0.02)
    surface = triangulation(patch)
    everything, rng = all_pairs(surface), np.random.default_rng(3)
    knots = rng.uniform(0, 0.06, (surface.count, 3))
    thickness, reach, skin = 1e-3, 2e-3, 4e-3
    followed = FollowedPairs(surface, knots, thickness, reach, skin)
    drift = 3e-3 * rng.standard_normal((surface.count, 3))
    found = 0
    for size in (1e-2, 3e-2, 0.1, 0.3, 0.01, 2.0):
        motion = size * drift + size * np.array([0.05, 0.0, -0.02])  # of all, too
        followed.share(motion, 0.9)
        knots = knots + motion
        followed.move(knots)
        near = found_by(followed)
        assert near == brute_force(*everything, knots, thickness + reach)
        found += len(near)
    assert found > 100


def folding(patch, way, rng):
    """A smooth tube that turns, is wrung, pressed flat and creased, from round at 0; knots."""
    around, along = np.meshgrid(
        np.linspace(0, 2 * np.pi, patch.columns, endpoint=False), np.arange(patch.rows - 1.0)
    )
    wave = sum(
        a * np.cos(k * around + b * along + c)
        for k, a, b, c in rng.normal(size=(4, 4)) * [2, 1, 1, 3]
    )
    radius = patch.columns * patch.size_around / (2 * np.pi) * (1 + 0.25 * way * wave)
    flat = 1 - 0.95 * way**2
    x, y = radius * np.cos(around), flat * radius * np.sin(around)
    z = patch.size_along * along * (1 - 0.5 * way) + 0.5 * way * y
    return np.stack([x, y, z], axis=-1).reshape(-1, 3) @ rotation([1, 2, 3], 4 * way).T


@pytest.mark.parametrize(("columns", "rows"), [(20, 9), (7, 5), (3, 4)])
def test_no_pair_of_a_sheet_that_folds_is_missed(columns, rows):
    """Where most is known of windows and blocks, and little is listed; steps of all sizes."""
    patch = Patch(columns, rows, 0.02, 0.02)
    surface = triangulation(patch)
    everything, thickness, reach, skin = all_pairs(surface), 1e-3, 2e-3, 9e-3
    steps = np.random.default_rng(1).choice([1e-3, 4e-3, 2e-2], 60 if columns > 7 else 100)
    ways = np.concatenate([[0.0], np.cumsum(steps) / np.sum(steps)])
    followed, found, listed = None, 0, []
    for n, way in enumerate(ways):
        knots = folding(patch, way, np.random.default_rng(7))
        if followed is None:
            followed = FollowedPairs(surface, knots, thickness, reach, skin)
        followed.share(knots - followed.knots, 0.9)
        followed.move(knots)
        near = found_by(followed)
        listed.append(len(followed.pairs))
        if n % 3 == 0 or len(near):
            assert near == brute_force(*everything, knots, thickness + reach)
        found += len(near)
    assert found > 5
    assert listed[0] < 0.2 * max(listed)


def test_windows_know_no_more_than_is_true():
    """Of flat ones the whole distance, of bent and skewed ones less than it, of folded ones 0."""
    patch = Patch(8, 6, 1.0, 1.0)
    surface = triangulation(patch)
    windows = Windows(surface)
    rng, known = np.random.default_rng(5), []
    for size in (0.0, 0.1, 0.3, 0.6):
        row, column = np.divmod(np.arange(surface.count), 8)
        knots = np.stack([column, row, np.zeros(surface.count)], axis=-1)
        knots = (knots + size * rng.uniform(-1, 1, knots.shape)) @ rotation([3, 1, 2], 1.0).T
        windows.near(knots, 0.0)
        for window in range(0, 6):  # those of the first row that are not torn around
            elements, _ = windows.element_pairs(np.array([window]))
            balls = Balls(surface)
            balls.renew(knots, np.unique(elements))
            pairs, edges, _ = candidates(surface, knots, 10.0, balls, elements)
            least = distances(knots, pairs, edges).min()
            value = windows.apart(window)
            assert value <= least * (1 + 1e-12)
            if size == 0.0:
                assert value == pytest.approx(np.sqrt(0.5), rel=1e-12)
            known.append(value / least)
    assert min(known) < 0 < 0.5 < np.median(known)


# ------------------------------------------------------------------ refusals


def test_a_start_that_crosses_itself_is_refused():
    sheet, points = flattened(half_gap=5e-4)
    crossing = points.copy()
    crossing[1, 3:5, 4:8] -= 1e-2
    with pytest.raises(Refusal, match="crosses itself"):
        SelfContact(sheet.section).force(crossing, np.empty_like(points))


def test_sheets_within_their_thickness_are_refused():
    sheet, points = flattened(thickness=1.5e-3)
    with pytest.raises(Refusal, match="nearer than its thickness"):
        SelfContact(sheet.section).force(points, np.empty_like(points))


def test_a_reach_too_large_for_the_mesh_is_refused():
    sheet = imperfect_sheet(10e-3)
    with pytest.raises(Refusal, match=r"larger elements than 9.97 mm; reduce the reach to 4 mm"):
        SelfContact(sheet.section, reach=5e-3)
    thick = replace(sheet.section, thickness=8e-3)
    with pytest.raises(Refusal, match="take a coarser mesh"):
        SelfContact(thick, reach=1e-3)


def test_a_way_through_the_sheet_has_infinite_energy(pressed):
    term, points = pressed
    force = np.empty_like(points)
    term.force(points, force)
    through = points.copy()
    through[1, 3:5, 4:8] -= 4e-3
    assert np.isinf(term.force(through, force)[0])
    assert np.isfinite(term.force(points, force)[0])


# ------------------------------------------------------------------ motion


def touching_mass(term, sheet):
    problem = Problem(sheet, term)
    return minding_contact(SpectralMassScaling().start(problem), problem)


def test_a_step_that_would_cross_is_shortened_with_its_momentum(pressed):
    term, points = pressed
    sheet, _ = flattened()
    mass = touching_mass(term, sheet)
    term.force(points, np.empty_like(points))
    upper = points[1, 2:-2] > 0
    down = np.zeros((3, *upper.shape))
    down[1][upper] = -1.0
    bare = SpectralMassScaling().start(Problem(sheet))
    momentum = down * 5e-3 / np.abs(bare.velocity(down)).max()
    whole = momentum.copy()
    velocity = mass.velocity(momentum).copy()
    share = np.sum(momentum * whole) / np.sum(whole * whole)
    assert 0 < share < 0.5
    assert np.allclose(momentum, share * whole, rtol=1e-12)
    there = points.copy()
    there[:, 2:-2] += velocity
    assert np.isfinite(term.force(there, np.empty_like(points))[0])
    there[:, 2:-2] += velocity * (1 / share - 1)
    term.force(points, np.empty_like(points))
    assert np.isinf(term.force(there, np.empty_like(points))[0])


def test_rings_that_alone_close_a_gap_end_the_motion(pressed):
    term, points = pressed
    sheet, _ = flattened()
    mass = touching_mass(term, sheet)
    shape, force = points.copy(), np.empty_like(points)
    still = np.zeros((3, points.shape[1] - 4, points.shape[2]))
    upper = points[1] > 0
    with pytest.raises(SolveError, match="more ramp steps"):
        for _ in range(5):
            assert np.isfinite(term.force(shape, force)[0])
            mass.velocity(still)
            shape[1][upper] -= 2e-4


def test_factor_on_the_mass_keeps_the_step_stable(pressed):
    term, points = pressed
    sheet, _ = flattened()
    mass = touching_mass(term, sheet)
    bare = SpectralMassScaling().start(Problem(sheet))
    term.force(points, np.empty_like(points))
    owned = 2 * 3 * sheet.patch.columns
    springs = term.spring_tangent(points)[owned:-owned, owned:-owned].toarray()
    shape = (sheet.patch.rows - 4, sheet.patch.columns, 3)

    def response(column):
        push = np.ascontiguousarray(np.moveaxis(column.reshape(shape), -1, 0))
        return np.moveaxis(bare.velocity(push), 0, -1).ravel()

    largest = np.linalg.eigvals(np.array([response(c) for c in springs.T]).T).real.max()
    momentum = np.zeros((3, *shape[:2]))
    for _ in range(60):
        mass.velocity(momentum)
    assert largest > 3.8 - 1.4
    assert mass.largest_factor == pytest.approx((1.1 * largest + 1.4) / 3.8, rel=0.05)


# ------------------------------------------------------------------ crumples

METHOD = Method(RelaxationPath(ramp_steps=400))
TOUCHING = replace(METHOD, contact=BarrierContact())
MESH = Mesh(14e-3)


def foil_of(overlength):
    return Foil(DIAMETER, GAP_HEIGHT * (1 + overlength), GAP_HEIGHT, 500e-6, FEP)


def test_where_nothing_comes_near_the_crumple_is_the_same_to_the_last_bit():
    foil = foil_of(0.15)
    without = crumple(foil, MESH, method=METHOD)
    touching = crumple(foil, MESH, method=TOUCHING)
    assert touching.status == "converged"
    assert np.array_equal(touching.points, without.points)
    assert touching.arrival.hessians == without.arrival.hessians


@pytest.fixture(scope="module")
def touching():
    return crumple(foil_of(1.5), MESH, method=TOUCHING)


def test_a_crumple_that_would_cross_itself_touches_instead(touching):
    assert crumple_share(crumple(foil_of(1.5), MESH, method=METHOD)) > 0.02
    assert touching.status == "converged", touching.message
    assert touching.arrival.residual <= 1e-8
    assert touching.arrival.negative_eigenvalues == 0
    assert crumple_share(touching) == 0.0
    assert touching.contact_bracket().closed > 0
    again = touching.settled()
    assert again.status == "converged"
    assert np.abs(again.points - touching.points).max() < 1e-6


def crumple_share(crumpled):
    return self_crossing_share(knot_points(crumpled.points))


def test_contacts_stiffen_in_their_order(touching):
    bracket = touching.contact_bracket()
    assert np.allclose(bracket.ignored, touching.stiffness(), rtol=1e-6)
    for direction in range(2):
        axial_or_radial = [
            values[direction]
            for values in (bracket.ignored, bracket.normal, bracket.rigid, bracket.stuck)
        ]
        assert axial_or_radial == sorted(axial_or_radial)
        assert axial_or_radial[-1] > axial_or_radial[0]


def test_what_contact_cannot_keep_is_refused():
    foil, contact = foil_of(0.15), BarrierContact()
    with pytest.raises(Refusal, match="coarsenings of the ramp to 0"):
        crumple(foil, replace(MESH, ramp_coarsenings=1), method=TOUCHING)
    with pytest.raises(Refusal, match="not by the path newton"):
        crumple(foil, MESH, method=Method(NewtonPath(), contact=contact))
    scheme = Scheme.named("spectral", "kinetic")
    with pytest.raises(Refusal, match="use adaptive_viscous"):
        crumple(foil, MESH, method=Method(RelaxationPath(scheme=scheme), contact=contact))


def test_springs_resist_no_rigid_motion(pressed):
    term, points = pressed
    rigid = [np.broadcast_to(np.eye(3)[k][:, None, None], points.shape) for k in range(3)]
    rigid += [np.cross(np.eye(3)[k], points, axisb=0, axisc=0) for k in range(3)]
    for stuck in (False, True):
        springs = term.spring_tangent(points, 1e5, stuck)
        assert np.linalg.eigvalsh(springs[:72, :72].toarray()).min() > -1e-6
        for motion in rigid:
            forces = springs @ np.moveaxis(motion, 0, -1).ravel()
            assert np.abs(forces).max() < 1e-9 * abs(springs).max() * np.abs(motion).max()
    # a whole sheet that slides along the other one: nothing along the gaps, much where it sticks
    along = np.zeros_like(points)
    along[2] = points[1] > 0
    work = [
        np.moveaxis(along, 0, -1).ravel() @ (term.spring_tangent(points, 1e5, stuck) @ slid)
        for stuck in (False, True)
        for slid in (np.moveaxis(along, 0, -1).ravel(),)
    ]
    assert work[1] > 1e2 * work[0] > 0


def test_the_barrier_is_that_of_the_toolkit_of_its_authors(pressed):
    ipctk = pytest.importorskip("ipctk", reason="the toolkit is no requirement of this project")
    term, points = pressed
    surface = triangulation(Patch(24, 6, np.pi * DIAMETER / 24, 0.02))
    force = np.empty_like(points)
    energy = term.force(points, force)[0]
    knots, rest = (np.asfortranarray(k) for k in (surface.knots(points), term._rest))
    mesh = ipctk.CollisionMesh(
        rest,
        np.asfortranarray(surface.edges.astype(np.int32)),
        np.asfortranarray(surface.triangles.astype(np.int32)),
    )
    collisions = ipctk.NormalCollisions()
    collisions.build(mesh, knots, term.reach, dmin=term.thickness)
    potential = ipctk.BarrierPotential(term.reach, 1.0)
    scale = term._size / term._span**2  # theirs is of squared distances, not of shares of a span
    assert scale * potential(collisions, mesh, knots) == pytest.approx(energy, rel=1e-12)
    theirs, ours = np.asarray(potential.gradient(collisions, mesh, knots)), np.empty_like(points)
    surface.gathered(scale * theirs.reshape(-1, 3), ours)
    assert np.abs(ours - force).max() < 1e-11 * np.abs(force).max()
    spread = surface.spread()
    hessian = spread.T @ (scale * potential.hessian(collisions, mesh, knots)) @ spread
    tangent = term.tangent(points)
    assert abs(hessian - tangent).max() < 1e-11 * abs(tangent).max()


# ------------------------------------------------------------------ the planes of the rings


@pytest.fixture(scope="module")
def leaning():
    """A cylinder whose foil bulges onto the planes of its rings, and the term of these planes."""
    patch = Patch(24, 6, np.pi * DIAMETER / 24, 0.02)
    angle = 2 * np.pi * (np.arange(24) + 0.5) / 24
    height = 0.02 * (np.arange(patch.rows) - 0.5)
    points = np.empty(patch.shape)
    bulge = 0.1 * np.ones(patch.rows)
    bulge[3:-3] = 0.12
    height[2:4], height[-4:-2] = 1e-3, 0.12 - 1e-3
    points[0] = bulge[:, None] * np.cos(angle)
    points[1] = bulge[:, None] * np.sin(angle)
    points[2] = height[:, None]
    sheet = Shell.elastic(patch, points, FEP, 1e-3)
    points = points + 2e-4 * np.random.default_rng(2).standard_normal(points.shape)
    return sheet, RingPlanes(sheet.section), points


def test_planes_push_by_the_derivatives_of_their_energy(leaning):
    _, term, points = leaning
    force, scratch = np.empty_like(points), np.empty_like(points)
    assert term.force(points, force)[0] > 0
    tangent = term.tangent(points)
    assert abs(tangent - tangent.T).max() < 1e-12 * abs(tangent).max()
    for seed in range(3):
        way = np.random.default_rng(seed).standard_normal(points.shape)
        step, other = 1e-8, np.empty_like(points)
        ahead = term.force(points + step * way, scratch)[0]
        behind = term.force(points - step * way, other)[0]
        assert (ahead - behind) / (2 * step) == pytest.approx(np.sum(force * way), rel=1e-5)
        slope = np.moveaxis(scratch - other, 0, -1).ravel() / (2 * step)
        expected = tangent @ np.moveaxis(way, 0, -1).ravel()
        assert np.linalg.norm(slope - expected) < 1e-5 * np.linalg.norm(expected)


def test_planes_move_and_turn_with_their_rings(leaning):
    _, term, points = leaning
    force, turned_force = np.empty_like(points), np.empty_like(points)
    energy = term.force(points, force)[0]
    turn = rotation([1, 2, 3], 0.9)
    turned = np.einsum("ij,jrc->irc", turn, points) + np.array([0.1, -0.2, 0.3])[:, None, None]
    assert term.force(turned, turned_force)[0] == pytest.approx(energy, rel=1e-9)
    expected = np.einsum("ij,jrc->irc", turn, force)
    assert np.abs(turned_force - expected).max() < 1e-8 * np.abs(force).max()
    # all that the planes take from the foil, their rings get
    arms, forces = points.reshape(3, -1).T, force.reshape(3, -1).T
    assert np.abs(forces.sum(axis=0)).max() < 1e-10 * np.abs(forces).max()
    assert np.abs(np.cross(arms, forces).sum(axis=0)).max() < 1e-10 * np.abs(forces).max()


def test_nothing_goes_beyond_the_planes(leaning):
    sheet, _, points = leaning
    term, force = RingPlanes(sheet.section), np.empty_like(points)
    term.force(points, force)
    knots, down = term.knots(), np.zeros_like(term.knots())
    down[24:-24, 2] = -1e-2
    share = term.passable_share(down, 0.9)
    normal = np.cross(knots[8] - knots[0], knots[16] - knots[0])
    gaps = (knots[24:-24] - knots[0]) @ normal / np.linalg.norm(normal) - term.half
    moved = gaps + share * down[24:-24] @ normal / np.linalg.norm(normal)
    assert 0 < share < 0.1
    assert (moved / gaps).min() == pytest.approx(0.1, rel=1e-9)
    beyond = points.copy()
    beyond[2, 3] -= 1e-2
    assert np.isinf(term.force(beyond, force)[0])
    with pytest.raises(Refusal, match="beyond the plane of a ring"):
        RingPlanes(sheet.section).force(beyond, force)


def test_a_plastic_foil_that_touches_is_measured_on_meshes_that_cannot_carry_its_reach(touching):
    """A finer mesh takes the plastic strain, and of contact nothing."""
    plastic = replace(touching.foil.material, law="plastic")
    foil = replace(touching.foil, material=plastic, reference_height=0.15)
    reach = 0.3 * MESH.element_size
    method = Method(METHOD.path, contact=BarrierContact(reach=reach))
    crumpled = crumple(foil, MESH, method=method)
    with pytest.raises(Refusal, match="reduce the reach"):
        crumpled.refined().contacts()
    assert np.isfinite(crumpled.mesh_limit(2).stiffness).all()
    assert crumpled.refined().arrival.state[1].accumulated.max() > 0


def test_the_warm_up_presses_a_foil_until_it_touches():
    """It raises where nothing touches, or where the shape crosses itself."""
    warmup._touching()
