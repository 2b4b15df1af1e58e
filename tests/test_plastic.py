"""Plasticity in layers: against closed forms, its derivatives, and in a crumple."""

import copy
import pickle
from dataclasses import replace

import numpy as np
import pytest
from conftest import FEP, FOIL, rotation
from scipy.integrate import solve_ivp
from wild_sheets import Foil, extrapolated, flat, unflat, wild_open_sheet, wild_shape, wild_sheet

from foilstudy.base.record import read_record
from foilstudy.config import load_config
from foilstudy.config.slips import likely_slips
from foilstudy.measure.stiffness import fixed_stiffness
from foilstudy.measure.stiffness.stress_flow import JohnsonCook, ZerilliArmstrong
from foilstudy.measure.stiffness.stress_removal import Reset
from foilstudy.model.foil import Imperfection
from foilstudy.model.patch import RING_ROWS, Patch, fitted_control_points
from foilstudy.model.shell.elements import sampling
from foilstudy.model.shell.elements.corner import Corner
from foilstudy.model.shell.elements.mean_strains import SampledMeanStrains
from foilstudy.model.shell.elements.one_point import OnePoint
from foilstudy.model.shell.material.layers import Layers, Look
from foilstudy.model.shell.material.plastic import LAYERS, Plastic, PlasticTerm, layer_heights
from foilstudy.model.shell.material.return_map import ROOM, Flow, increment
from foilstudy.model.shell.section import Section
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumple import crumple
from foilstudy.pipeline.crumpled import Crumpled
from foilstudy.pipeline.method import Mesh, Method
from foilstudy.pipeline.structures import stress_free_structure
from foilstudy.solve.equilibrium.settle import SettleOptions
from foilstudy.solve.paths.minimisation import MinimisationPath
from foilstudy.solve.paths.relaxation import RelaxationPath
from foilstudy.study.sweep.crumple import crumple_job

either_patch = pytest.mark.parametrize("make", [wild_sheet, wild_open_sheet])
either_element = pytest.mark.parametrize(
    "element", [Corner(), OnePoint(0.3)], ids=lambda element: element.name
)


# --- the return map ------------------------------------------------------------------------------


def stress_of(strain, flow):
    """Plane stress (11, 22, 12) of an elastic strain."""
    plane = flow.youngs_modulus / (1 - flow.poisson_ratio**2)
    e1, e2, e6 = strain
    nu = flow.poisson_ratio
    return plane * np.array([e1 + nu * e2, e2 + nu * e1, 0.5 * (1 - nu) * e6])


def back_stress_of(plastic, flow):
    """In-plane tensor whose deviator is 2/3 of the kinematic hardening times the plastic strain."""
    p1, p2, p6 = plastic
    return flow.kinematic * 2 / 3 * np.array([2 * p1 + p2, 2 * p2 + p1, 0.5 * p6])


def von_mises(stress):
    s1, s2, s6 = stress
    return np.sqrt(s1**2 + s2**2 - s1 * s2 + 3 * s6**2)


@pytest.mark.parametrize("nu", [-0.9, 0.0, 0.3, 0.5])
@pytest.mark.parametrize("hardening", [(0, 0), (0.05, 0), (0, 0.05), (1.0, 1.0)])
def test_flow_ends_on_the_yield_surface_along_its_normal(nu, hardening):
    flow = Flow(1.0, nu, 1e-3, *hardening)
    rng = np.random.default_rng(0)
    for excess in (0.1, 1.001, 1.5, 10.0, 1e3):
        plastic, done = 1e-3 * rng.standard_normal(3), 1e-3
        strain = plastic + 1e-3 * excess * rng.standard_normal(3)
        *flowed, more = increment(tuple(strain), tuple(plastic), done, flow)
        after = plastic + flowed
        relative = stress_of(strain - after, flow) - back_stress_of(after, flow)
        limit = flow.yield_stress + flow.isotropic * (done + more)
        if more == 0:
            assert von_mises(relative) <= limit and not np.any(flowed)
            continue
        assert von_mises(relative) == pytest.approx(limit, rel=1e-9)
        # by the normal, so that the work of the relative stress is the flow stress times the path
        work = relative @ flowed
        assert work > 0 and work == pytest.approx(limit * more, rel=1e-7)
        d1, d2, d6 = flowed
        path = np.sqrt(2 / 3 * (d1**2 + d2**2 + (d1 + d2) ** 2 + 0.5 * d6**2))
        assert path == pytest.approx(more, rel=1e-9)


def test_what_is_not_a_number_is_no_flow_but_stays_seen():
    """Such strains do not hang the iteration; the elastic force tells of them."""
    assert (
        increment((np.nan, 0.0, 0.0), (0.0, 0.0, 0.0), 0.0, Flow(1.0, 0.3, 1e-3, 0, 0)) == (0,) * 4
    )


@pytest.mark.parametrize("kinematic_share", [0.0, 0.4, 1.0])
def test_uniaxial_curve(kinematic_share):
    """An incompressible bar gets half as much thinner in width: there is no stress across."""
    limit, hardening = 1e-3, 0.05
    flow = Flow(1.0, 0.5, limit, (1 - kinematic_share) * hardening, kinematic_share * hardening)
    plastic, done = np.zeros(3), 0.0
    tangent = hardening / (1 + hardening)
    for stretch in np.linspace(0, 8 * limit, 41):
        strain = stretch * np.array([1.0, -0.5, 0.0])
        *flowed, more = increment(tuple(strain), tuple(plastic), done, flow)
        plastic, done = plastic + flowed, done + more
        along, across, _ = stress_of(strain - plastic, flow)
        expected = stretch if stretch < limit else limit + tangent * (stretch - limit)
        assert along == pytest.approx(expected, rel=1e-9, abs=1e-15)
        assert abs(across) < 1e-12
    # pulled back: the elastic range is as wide as it has become, or has moved
    width = 2 * (limit + (1 - kinematic_share) * hardening * done)
    for share, flows in ((0.999, False), (1.001, True)):
        strain = (stretch - share * width) * np.array([1.0, -0.5, 0.0])
        assert (increment(tuple(strain), tuple(plastic), done, flow)[3] > 0) == flows


class WidePlate:
    """A strip of an incompressible, perfectly plastic foil, bent as part of a wide plate."""

    def __init__(self):
        thickness, limit, nu = 1.0, 1e-3, 0.5
        self.flow = Flow(1.0, nu, limit, 0.0, 0.0)
        self.first = 2 * (2 * limit / np.sqrt(3)) * (1 - nu**2) / thickness
        self.heights = layer_heights(LAYERS, thickness)
        frame = np.array([1.0, 0, 1, 0, 0, 1, thickness]).reshape(1, 7, 1)
        self.state = Layers(frame, self.heights, self.flow).untouched()
        self.look = Look((1, 1))

    def moment(self, ratio):
        """Over the elastic limit moment, at a curvature over that of the elastic limit."""
        strain = np.zeros((1, 6, 1))
        strain[0, 3] = ratio * self.first
        self.state = self.state.foil.flowed(strain, None, self.state, self.look)
        k1, k2 = (strain - self.state.strains)[0, 3:5, 0]
        return (k1 + self.flow.poisson_ratio * k2) / self.first


def exact_moment(ratio):
    return ratio if ratio < 1 else 1.5 - 0.5 / ratio**2


def test_moment_over_curvature():
    """3/2 - 1/2 (k_y / k)^2."""
    plate = WidePlate()
    assert np.mean(plate.heights**2) == pytest.approx(1 / 12, rel=1e-14)
    for ratio in np.linspace(0.01, 6, 300):
        moment, exact = plate.moment(ratio), exact_moment(ratio)
        assert abs(moment - exact) < 0.025
        assert ratio >= 1 or abs(moment - exact) < 1e-12  # elastic bending is exact


@pytest.mark.parametrize("ratio", [0.9, 1.5, 4.0])
def test_a_bent_strip_springs_back_by_its_moment(ratio):
    """Let go, it unbends elastically: k - M(k), without flowing back."""
    plate = WidePlate()
    for each in np.linspace(0.0, ratio, 200):
        plate.moment(each)
    bent = plate.state.layers
    assert abs(plate.moment(ratio - exact_moment(ratio))) < 0.025
    assert np.array_equal(plate.state.layers, bent)


# --- the term ------------------------------------------------------------------------------------


def plastic_sheet(make, element, yield_stress=2e6, around=6, along=3):
    sheet = make(around, along, Foil(element))
    law = Plastic(replace(FEP, yield_stress=yield_stress), kinematic_share=0.5)
    section = Section(sheet.patch, sheet.reference, sheet.thickness, law)
    shell = Shell(section, element)
    (term,) = law.terms(shell)
    return shell, term


def force_of(term, points, state):
    out = np.empty_like(points)
    (energy,) = term.force(np.ascontiguousarray(points), out, state)
    return energy, out


@either_element
@either_patch
def test_derivatives_at_a_fixed_state(element, make):
    shell, term = plastic_sheet(make, element)
    points = wild_shape(shell)
    state = term.evolved(wild_shape(shell, seed=8), term.start())
    assert term.plastic_share(state) > 0.5
    _, force = force_of(term, points, state)
    tangent = term.tangent(points, state)
    assert abs(tangent - tangent.T).max() < 1e-12 * abs(tangent).max()
    way = np.random.default_rng(0).standard_normal(points.shape)

    def slope(step, part):
        ahead, behind = (force_of(term, points + s * step * way, state)[part] for s in (1, -1))
        return (ahead - behind) / (2 * step)

    step = 1e-3 * shell.patch.size_around
    error = extrapolated(lambda h: slope(h, 0), step) - (force * way).sum()
    assert abs(error) < 1e-8 * np.linalg.norm(force) * np.linalg.norm(way)
    product = unflat(tangent @ flat(way), shell.patch)
    error = extrapolated(lambda h: slope(h, 1), step) - product
    assert np.linalg.norm(error) < 1e-7 * np.linalg.norm(product)


@pytest.mark.parametrize("around", [5, 9, 131, 300])
@either_patch
def test_vectorised_mean_strains_are_the_general_ones(make, around):
    shell, _ = plastic_sheet(make, Corner(), around=around)
    points = wild_shape(shell)
    fast = shell.element.mean_strains(shell.section)
    sampled = sampling.corner(shell.element.share(shell.section))
    general = SampledMeanStrains(shell.section, sampled)
    strains = general.strains(points)
    np.testing.assert_allclose(fast.strains(points), strains, rtol=0, atol=1e-12 * strains.max())


@pytest.mark.parametrize("around", [5, 9, 131, 300])
@either_element
@either_patch
def test_shell_and_term_in_one_are_the_two(element, make, around):
    """From state to state, back again, and to the same bits where nothing has yielded."""
    shell, term = plastic_sheet(make, element, around=around)
    points = np.ascontiguousarray(wild_shape(shell))
    bent = shell.reference.copy()
    bent[:, 3:] = points[:, 3:]  # a part of it yields, then all
    few = term.evolved(bent, term.start())
    states = [few, term.evolved(points, few), few, term.start()]
    assert 0 < term.yielded_share(few) < 1 == term.yielded_share(states[1])
    together, elastic, share = (np.empty_like(points) for _ in "123")
    for state in states:
        energies = term.force_with_shell(points, together, state)
        apart = *shell.force(points, elastic), *term.force(points, share, state)
        np.testing.assert_allclose(energies, apart, rtol=1e-12, atol=1e-13 * sum(apart[:3]))
        error = np.abs(together - elastic - share).max()
        assert error < 1e-13 * max(np.abs(elastic).max(), np.abs(share).max())
    assert np.array_equal(together, elastic) and tuple(energies) == apart


def test_layers_that_are_not_looked_at_would_not_have_flowed():
    """Along a way of small steps: as by looking at all layers in every one."""
    shell, term = plastic_sheet(wild_sheet, Corner())
    watched, rng = PlasticTerm(shell, term.law), np.random.default_rng(3)
    state = other = term.start()
    points = shell.reference
    looked = 0
    for step in range(300):
        way = rng.standard_normal(points.shape)
        points = points + 2e-4 * shell.patch.size_around * way
        room = term._look.values[:, :, ROOM].copy()
        state = term.evolved(points, state)
        looked += np.count_nonzero(term._look.values[:, :, ROOM] != room) / state.slots.size
        # a state of another foil: nothing is known of it, so that all is looked at
        other = watched.evolved(points, watched.restored({"plastic_strain": other.layers}))
        assert np.array_equal(other.layers, state.layers), step
    assert term.yielded_share(state) > 0.3
    assert looked < 0.7 * 300


def test_states_stay_what_they_were_however_many_follow():
    """More states than there is room for at first, some of them kept."""
    shell, term = plastic_sheet(wild_sheet, Corner())
    rng, state, kept = np.random.default_rng(0), term.start(), []
    state = term.restored(term.recorded(term.evolved(wild_shape(shell, seed=99), state)))
    for step in range(60):
        points = wild_shape(shell, seed=step)
        state = term.evolved(points, state)
        if step % 7 == 0:
            kept.append((state, state.layers, points))
    for state, layers, points in rng.permutation(np.array(kept, dtype=object)):
        assert np.array_equal(state.layers, layers)
        assert np.array_equal(term.evolved(points, state).layers, layers)
    assert len(state.foil.values) < 60 * state.slots.size


@pytest.mark.parametrize(
    "again", [copy.copy, copy.deepcopy, lambda state: pickle.loads(pickle.dumps(state))]
)
def test_copies_of_a_state_stay_what_they_were(again):
    """When the original is gone and others have taken all the room that is free."""
    shell, term = plastic_sheet(wild_sheet, Corner())
    state = term.start()
    for seed in range(2):
        state = term.evolved(wild_shape(shell, seed=seed), state)
    copied, layers, energy = again(state), state.layers, state.energy
    follower = copied
    for seed in range(2, 12):
        state = term.evolved(wild_shape(shell, seed=seed), state)
        follower = term.evolved(wild_shape(shell, seed=seed), follower)
    assert np.array_equal(copied.layers, layers) and layers.any()
    assert copied.energy == pytest.approx(energy, rel=1e-12)


@either_element
@either_patch
def test_a_rigid_motion_costs_nothing(element, make):
    shell, term = plastic_sheet(make, element)
    turn = rotation([1, 2, 3], 0.7)

    def moved(points):
        return np.einsum("ij,jrc->irc", turn, points) + np.array([0.1, 0.2, 0.3])[:, None, None]

    state = term.evolved(moved(shell.reference), term.start())
    assert state.accumulated.max() == 0
    points = wild_shape(shell)
    state = term.evolved(points, term.start())
    again = term.evolved(moved(points), state)
    assert np.abs(again.layers - state.layers).max() < 1e-9 * np.abs(state.layers).max()
    energy, force = force_of(term, points, state)
    there, turned = force_of(term, moved(points), state)
    assert there == pytest.approx(energy, rel=1e-9)
    np.testing.assert_allclose(
        turned, np.einsum("ij,jrc->irc", turn, force), rtol=0, atol=1e-8 * np.abs(force).max()
    )


def test_energies_along_a_random_way():
    """What is left of the elastic energy is never negative, and dissipation never falls.

    The work done on the foil is what is left, what hardening keeps and what is dissipated.
    """
    shell, term = plastic_sheet(wild_sheet, Corner())
    start, rng = shell.reference, np.random.default_rng(5)
    ends = [
        start + 0.02 * shell.patch.size_around * rng.standard_normal(start.shape) for _ in "123"
    ]
    ways = zip([start, *ends], [*ends, start], strict=True)
    state, before, work, dissipated = term.start(), start, 0.0, 0.0
    elastic, share = np.empty_like(start), np.empty_like(start)
    shell.force(start, elastic)
    force, steps = elastic.copy(), 400
    for first, last in ways:
        for step in range(1, steps + 1):
            points = first + step / steps * (last - first)
            state = term.evolved(points, state)
            energy = shell.force(points, elastic).sum() + term.force(points, share, state)[0]
            assert energy >= 0
            now = elastic + share
            work += 0.5 * np.sum((force + now) * (points - before))
            force, before = now, points
            assert term.dissipated(state) >= dissipated
            dissipated = term.dissipated(state)
    assert dissipated > 0.3 * work
    assert work == pytest.approx(energy + term.spent(state), rel=1e-2)


@either_element
def test_the_force_of_a_step_is_the_derivative_of_energy_and_what_is_spent(element):
    """Along with the flow: a minimum of both is an equilibrium at the state that it leads to."""
    shell, term = plastic_sheet(wild_sheet, element)
    start = term.evolved(wild_shape(shell, seed=8), term.start())
    points, way = wild_shape(shell), np.random.default_rng(0).standard_normal(shell.patch.shape)

    def value(step):
        reached = points + step * way
        state = term.evolved(reached, start)
        return force_of(term, reached, state)[0] + term.spent(state)

    def slope(step):
        return (value(step) - value(-step)) / (2 * step)

    _, force = force_of(term, points, term.evolved(points, start))
    error = extrapolated(slope, 1e-4 * shell.patch.size_around) - (force * way).sum()
    assert abs(error) < 1e-6 * np.linalg.norm(force) * np.linalg.norm(way)


# --- in a crumple --------------------------------------------------------------------------------

COARSE = Mesh(20e-3)
QUICK = Method(RelaxationPath(ramp_steps=400))


def crumpled(law, yield_stress, method=QUICK):
    made = replace(FEP, law=law, yield_stress=yield_stress)
    return crumple(replace(FOIL, material=made), COARSE, Imperfection(seed=3), method)


def test_a_yield_stress_out_of_reach_gives_the_elastic_crumple():
    elastic, plastic = crumpled("elastic", 1e12), crumpled("plastic", 1e12)
    assert np.abs(plastic.points - elastic.points).max() < 1e-15
    assert plastic.arrival.state[1].accumulated.max() == 0


@pytest.fixture(scope="module")
def yielded():
    return crumpled("plastic", 12e6)


def test_a_plastic_crumple_rests_at_its_own_state(yielded):
    assert yielded.status == "converged", yielded.message
    problem = yielded.problem()
    term, state = problem.terms[1], problem.state[1]
    assert 0.1 < term.plastic_share(state) < 1
    assert 0 < problem.value(yielded.points) < 0.9 * yielded.energies().total
    stress = term.stresses(yielded.points, state).transpose(2, 0, 1, 3)
    back = np.stack(back_stress_of(state.layers[:, :, :3].transpose(2, 0, 1, 3), term.law.flow))
    assert von_mises(stress - back).max() <= 12e6 * (1 + 1e-9)
    again = yielded.settled()
    assert (again.arrival.steps, again.arrival.hessians) == (0, 0)


def test_a_plastic_crumple_that_settles_without_motion_keeps_its_state(yielded):
    """A path of equilibria crumples no such foil, but it settles one."""
    again = yielded.settled(Method(MinimisationPath()))
    assert again.status == "converged"
    assert np.array_equal(again.prestressed_stiffness(), yielded.prestressed_stiffness())


@pytest.mark.parametrize("rounds", [1, 10])
def test_where_a_plastic_crumple_has_not_come_to_rest_its_state_is_that_of_its_shape(rounds):
    """For want of steps, or of rounds."""
    few = SettleOptions(relaxation_steps_max=0 if rounds > 1 else 20, rounds_max=rounds)
    few = replace(few, switch_residual=0.1, hessians_per_round=1, hessians_last=1)
    stopped = crumpled("plastic", 12e6, Method(RelaxationPath(400, settling=few)))
    assert stopped.status == "not_converged" and stopped.arrival.newton_steps > 0
    problem, points = stopped.problem(), stopped.points
    here, after = problem.state, problem.followed(points)
    assert problem.spent(after) == pytest.approx(problem.spent(here), rel=1e-12)
    force = np.empty_like(points)
    problem.force(points, force)
    free = np.linalg.norm(force[:, RING_ROWS:-RING_ROWS])
    residual = free / np.sqrt(np.linalg.norm(force) ** 2 - free**2)
    assert stopped.arrival.residual == pytest.approx(residual, rel=1e-6)


def test_the_tangent_is_the_unloading_secant(yielded):
    """Pulled apart a little, the ring's force falls by the stiffness of the settled state."""
    problem, points = yielded.problem(), yielded.points.copy()
    axial, _ = yielded.prestressed_stiffness()
    pull = 20e-6
    before, after = np.empty_like(points), np.empty_like(points)
    problem.force(points, before)
    points[2, -RING_ROWS:] += pull
    settled = QUICK.path.settle(problem, points)
    assert settled.status == "converged", settled.message
    problem.force(settled.points, after)
    secant = (after - before)[2, -RING_ROWS:].sum() / pull
    assert secant == pytest.approx(axial, rel=0.02)


def test_a_record_keeps_the_state(tmp_path):
    """From a configuration to a record and back, and on to a finer mesh."""
    study = load_config(
        {
            "material": {"law": "plastic", "hardening_mpa": 50},
            "sweep": {"thickness_um": [500], "reference_height_mm": [170]},
            "mesh": {"element_size_mm": 20},
            "relaxation": {"ramp_steps": 400},
        }
    )
    crumple_job(study.crumple_task(study.cells()[0]), tmp_path / "crumple.nc")
    values, attributes = read_record(tmp_path / "crumple.nc")
    assert attributes["status"] == "converged", attributes["message"]
    back = Crumpled.recorded(tmp_path / "crumple.nc")
    problem = back.problem()
    term, state = problem.terms[1], problem.state[1]
    assert term.law.hardening == 50e6
    assert values["plastic_share"] == term.plastic_share(state)
    assert values["plastic_share"] < values["beyond_yield_share"]
    assert values["plastic_strain_max"] == state.accumulated.max() > 0.01
    assert values["dissipated_work"] == term.dissipated(state) > 0
    assert values["work_spent"] == term.spent(state) > values["dissipated_work"]  # some is kept
    assert values["plastic_relief_energy"] < 0
    # in equilibrium as it was written
    assert back.settled().arrival.hessians == 0
    finer = back.refined()
    split = finer.arrival.state[1]
    assert np.array_equal(split.layers[::2, :, :, ::2], state.layers)
    assert np.array_equal(split.layers[1::2, :, :, 1::2], state.layers)
    dissipated = finer.problem().terms[1].dissipated(split)
    assert dissipated == pytest.approx(term.dissipated(state), rel=5e-3)
    settled = finer.settled()
    assert settled.status == "converged", settled.message
    assert settled.problem().terms[1].dissipated(settled.arrival.state[1]) > dissipated


def test_hardening_without_yield_is_a_slip():
    grid = {"thickness_um": [500], "reference_height_mm": [170]}
    with pytest.raises(ValueError, match="hardening_mpa is given, but material.law is elastic"):
        load_config({"material": {"hardening_mpa": 50}, "sweep": grid})


def test_the_traps_of_plastic_foil_are_named():
    grid = {"thickness_um": [500], "reference_height_mm": [170]}

    def said(law, steps, **material):
        ramp = {"ramp_steps": steps}
        content = {"material": {"law": law, **material}, "sweep": grid, "relaxation": ramp}
        return " ".join(likely_slips(load_config(content)))

    assert not said("elastic", 500) and not said("plastic", 8000)
    assert "yields by the hurry" in said("plastic", 500)
    assert "fold flat" in said("plastic", 8000, hardening_mpa=0)
    removal = {"method": {"stress_removal": "johnson_cook"}, "sweep": grid}
    assert "leaves stress in the shape" in " ".join(likely_slips(load_config(removal)))


# --- stress removals by flow ---------------------------------------------------------------------


def stretched_strip():
    """A flat patch under a uniform strain of 1 %."""
    patch = Patch(6, 6, 0.01, 0.01, periodic=False)
    reference = fitted_control_points(patch, lambda s, z: np.stack([s, z, 0 * s]))
    shell = Shell.elastic(patch, reference, FEP, 5e-4)
    return shell, reference * np.array([1.01, 0.995, 1.0])[:, None, None]


def test_uniform_strain_flows_away_in_a_held_shape():
    shell, points = stretched_strip()
    stressed = shell.energies(points).total
    assert JohnsonCook().relieved(shell, points).residual_energy() < 1e-12 * stressed
    out_of_plane = JohnsonCook().relieved(shell, points).tangent()[2::3, 2::3]
    at_rest = Reset().relieved(shell, points).tangent()[2::3, 2::3]
    # the same but for the stretched metric, where the stress itself counts many times more
    assert abs(out_of_plane - at_rest).max() < 0.05 * abs(at_rest).max()
    assert abs(shell.tangent(points)[2::3, 2::3] - at_rest).max() > abs(at_rest).max()


def test_a_hold_that_is_too_short_leaves_all_stress():
    crumple_at = crumpled("elastic", 12e6)
    shell, points = crumple_at.stressed, crumple_at.points
    short, long = JohnsonCook(hold=1e-30), JohnsonCook()
    assert abs(short.relieved(shell, points).tangent() - shell.tangent(points)).max() == 0
    energies = [r.relieved(shell, points).residual_energy() for r in (long, short)]
    assert energies[1] == pytest.approx(crumple_at.energies().total, rel=1e-12)
    assert 0 < energies[0] < 0.7 * energies[1]
    # the two published laws come to the same residue, and neither is the exact reset
    removals = [JohnsonCook(), ZerilliArmstrong(), Reset()]
    methods = [replace(QUICK, stress_removal=removal) for removal in removals]
    recipes = [replace(crumple_at.recipe, method=method) for method in methods]
    relieved = [replace(crumple_at, recipe=recipe) for recipe in recipes]
    values = [each.stiffness() for each in relieved]
    assert values[0] == pytest.approx(values[1], rel=1e-4)
    assert np.all(np.abs(values[0] / values[2] - 1) > 0.02)
    # the same in the system with all motions, whose rings turn against the stress that is left
    for each, value in zip(relieved, values, strict=True):
        whole = fixed_stiffness(stress_free_structure(each).static.stiffness)
        assert whole == pytest.approx(value, rel=1e-6)


@pytest.mark.parametrize("hold", [1.0, 1e5, 1e9])
def test_what_a_hold_leaves(hold):
    """Against the differential equation of the stress at held strain, from 30 MPa."""
    law, modulus = JohnsonCook(), 650e6

    def rate(time, stress):
        excess = (stress / law.yield_stress - 1) / law.rate_coefficient
        return np.where(excess > 0, -modulus * law.reference_rate * np.exp(excess), 0.0)

    end = solve_ivp(rate, (0, hold), [30e6], "Radau", rtol=1e-6).y[0, -1]
    assert law.flow_stress(modulus) == 1.0
    assert replace(law, hold=hold).flow_stress(modulus) == pytest.approx(end, rel=1e-2, abs=50)
