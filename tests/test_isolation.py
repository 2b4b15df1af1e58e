"""A payload on mounts with foil links: theory of mounts, transmissibility, design limits."""

from __future__ import annotations

import numpy as np
import pytest
import yaml
from synthetic import make_cube

from foilstudy.config import ConfigError, Isolation, load_config
from foilstudy.measure.isolation import (
    FLOOR,
    PAYLOAD,
    IdealMount,
    ResonantMount,
    Spring,
    decibels,
    foil_link,
    in_parallel,
    kept_up_to,
    stiffness_share,
    transmissibility,
)
from foilstudy.present.configuration import isolation_options
from foilstudy.present.figures import FIGURES
from foilstudy.present.report.isolation import isolation_findings
from foilstudy.present.statistics.isolation import isolation_table, payload_transmissibility
from foilstudy.present.statistics.mounts import mounts, static_spring

MASS = 40.0
SUSPENSION_HZ = 3.0
FREQUENCIES = np.geomspace(0.03, 3000.0, 400)
STATIC = Spring.suspending(MASS, SUSPENSION_HZ)
SWEEP = {"thickness_um": [50, 500], "reference_height_mm": [135, 250]}


def damped_mounts():
    lossy = Spring.suspending(MASS, SUSPENSION_HZ, loss_factor=0.1)
    viscous = Spring.suspending(MASS, SUSPENSION_HZ, damping_ratio=0.2)
    return {
        "structural": IdealMount(lossy),
        "viscous": IdealMount(viscous),
        "resonant": ResonantMount.with_resonance(lossy, 80.0, 0.5),
        "two springs": ResonantMount(viscous, Spring(3e5, 0.05), 0.5),
    }


def ideal_transmissibility(damping_ratio, frequency):
    """Textbook transmissibility of a mass on a spring and a viscous damper to the floor."""
    r = frequency / SUSPENSION_HZ
    return (1 + 2j * damping_ratio * r) / (1 - r**2 + 2j * damping_ratio * r)


def system(**sections):
    return load_config({"sweep": SWEEP, **sections})


def cube_with(transfer, static, **isolation):
    """Cube in which every link has a given stiffness, over the static one of the ideal mount.

    `transfer` is a function of the frequency in Hz; all definitions are given its values.
    """
    cube = make_cube(thickness_um=(50.0, 500.0), reference_height_mm=(135.0, 250.0), seeds=3)
    cube.attrs["config"] = yaml.safe_dump({"isolation": isolation})
    stiffness = static_spring(isolation_options(cube), "axial").stiffness
    curve = stiffness * transfer(cube["frequency"].to_numpy())
    cube["dynamic_stiffness"][:] = curve
    cube["static_stiffness"][:] = static * stiffness
    return cube


@pytest.mark.parametrize("mount", damped_mounts().values(), ids=damped_mounts())
def test_payload_follows_a_floor_that_moves_slowly(mount):
    stiffness = mount.dynamic_stiffness(FREQUENCIES)
    motion = transmissibility(stiffness, FREQUENCIES, MASS)
    assert motion[0] == pytest.approx(1, abs=2e-4)


def test_undamped_ideal_mount_isolates_with_the_square_of_the_frequency():
    stiffness = IdealMount(STATIC).dynamic_stiffness(FREQUENCIES)
    motion = transmissibility(stiffness, FREQUENCIES, MASS)
    far = FREQUENCIES > 100 * SUSPENSION_HZ
    np.testing.assert_allclose(
        np.abs(motion[far]), (SUSPENSION_HZ / FREQUENCIES[far]) ** 2, rtol=2e-4
    )
    crossover = np.sqrt(2) * SUSPENSION_HZ
    at = IdealMount(STATIC).dynamic_stiffness([crossover])
    assert abs(transmissibility(at, [crossover], MASS)[0]) == pytest.approx(1)


@pytest.mark.parametrize("ratio", [0.01, 0.2, 1.0])
def test_viscous_mount_has_the_textbook_transmissibility(ratio):
    mount = IdealMount(Spring.suspending(MASS, SUSPENSION_HZ, damping_ratio=ratio))
    motion = transmissibility(mount.dynamic_stiffness(FREQUENCIES), FREQUENCIES, MASS)
    np.testing.assert_allclose(motion, ideal_transmissibility(ratio, FREQUENCIES), rtol=1e-12)


def test_structural_and_viscous_damping_of_the_study_agree_at_resonance():
    mount = mounts(Isolation(damping_percent=7.0), "axial")["ideal"]
    motion = transmissibility(mount.dynamic_stiffness([2.0]), [2.0], 100.0)
    assert abs(motion[0]) == pytest.approx(np.sqrt(1 + 0.14**2) / 0.14)


def test_two_equal_springs_in_parallel_are_twice_as_stiff():
    one = IdealMount(STATIC).dynamic_stiffness(FREQUENCIES)
    np.testing.assert_array_equal(in_parallel([(1, one), (1, one)]), 2 * one)
    np.testing.assert_array_equal(in_parallel([(2, one)]), 2 * one)
    motion = transmissibility(in_parallel([(2, one)]), FREQUENCIES, 2 * MASS)
    np.testing.assert_allclose(motion, transmissibility(one, FREQUENCIES, MASS))


def test_internal_mass_isolates_once_more_above_its_resonance():
    mount = ResonantMount.with_resonance(STATIC, 80.0, 0.5)
    far = np.array([8000.0, 16000.0])
    transfer = -mount.dynamic_stiffness(far)[:, PAYLOAD, FLOOR]
    mass_line = mount.lower.stiffness * mount.upper.stiffness / (0.5 * (2 * np.pi * far) ** 2)
    np.testing.assert_allclose(transfer, -mass_line, rtol=1e-3)


def test_resonant_mount_has_the_static_stiffness_and_the_poles_asked_for():
    mount = ResonantMount.with_resonance(STATIC, 80.0, 0.5)
    assert mount.lower.stiffness < mount.upper.stiffness
    static = mount.dynamic_stiffness([0.0])[0]
    k = STATIC.stiffness
    np.testing.assert_allclose(static, k * np.array([[1, -1], [-1, 1]]), rtol=1e-9)
    # Poles of D: both ends held, (k1 + k2) / m_i.
    held = np.sqrt((mount.lower.stiffness + mount.upper.stiffness) / 0.5) / (2 * np.pi)
    assert held == pytest.approx(80.0)
    # Poles of T: floor held, payload free; roots of the characteristic polynomial.
    k1, k2 = mount.lower.stiffness, mount.upper.stiffness
    squares = np.roots([0.5 * MASS, -(0.5 * k2 + MASS * (k1 + k2)), k1 * k2])
    for pole in np.sqrt(squares) / (2 * np.pi):
        close = pole * (1 + np.array([-1e-7, 1e-7]))
        motion = transmissibility(mount.dynamic_stiffness(close), close, MASS).real
        assert np.abs(motion).min() > 1e3 and motion[0] * motion[1] < 0


def test_resonant_mount_equals_the_three_masses_that_it_is_made_of():
    mount = ResonantMount(Spring(2e4, 0.1), Spring(3e5, 0.02, 15.0), 0.5)
    frequency = 61.0
    lower, upper = mount.lower.at(frequency), mount.upper.at(frequency)
    inertia = (2 * np.pi * frequency) ** 2
    full = np.array([[lower, 0, -lower], [0, upper, -upper], [-lower, -upper, lower + upper]])
    full -= inertia * np.diag([0, MASS, 0.5])
    motion = np.linalg.solve(full[1:, 1:], -full[1:, 0])[0]
    reduced = transmissibility(mount.dynamic_stiffness([frequency]), [frequency], MASS)[0]
    assert reduced == pytest.approx(motion)


def test_light_internal_mass_makes_an_ideal_mount():
    mount = ResonantMount.with_resonance(STATIC, 1e5, 1.0)
    slow = FREQUENCIES[FREQUENCIES < 100]
    np.testing.assert_allclose(
        mount.dynamic_stiffness(slow)[:, PAYLOAD, FLOOR], -STATIC.stiffness, rtol=1e-5
    )


@pytest.mark.parametrize("mount", damped_mounts().values(), ids=damped_mounts())
def test_no_mount_feeds_energy(mount):
    stiffness = mount.dynamic_stiffness(FREQUENCIES)
    loss = (stiffness - np.conj(np.swapaxes(stiffness, -1, -2))) / 2j
    lowest = np.linalg.eigvalsh(loss)[:, 0]
    assert (lowest >= -1e-9 * np.abs(stiffness).max(axis=(1, 2))).all()
    np.testing.assert_array_equal(stiffness, np.swapaxes(stiffness, -1, -2))


def test_impossible_mounts_are_refused_with_a_reason():
    with pytest.raises(ValueError, match="use at least 4.[0-9]+ kg, or a higher resonance"):
        ResonantMount.with_resonance(Spring(4e3), 10.0, 0.1)
    with pytest.raises(ValueError, match="viscous damper"):
        ResonantMount.with_resonance(Spring(1e3, viscous_damping=1.0), 80.0, 0.5)
    with pytest.raises(
        ValueError,
        match="loss factor of a mount's spring is -0.1; give a finite number of at least 0",
    ):
        Spring(1e3, loss_factor=-0.1)
    for what, make in (
        ("stiffness of a mount's spring", lambda: Spring(0.0)),
        ("suspended mass", lambda: Spring.suspending(-1.0, 2.0)),
        ("internal mass", lambda: ResonantMount(STATIC, STATIC, np.nan)),
    ):
        with pytest.raises(ValueError, match=f"the {what}"):
            make()


def test_supports_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match="at least one support"):
        in_parallel([(0, np.eye(2))])
    with pytest.raises(ValueError, match="counted -1 times"):
        in_parallel([(1, np.eye(2)), (-1, np.eye(2))])
    with pytest.raises(ValueError, match="must end in 2 x 2"):
        in_parallel([(1, np.ones((5, 3)))])
    with pytest.raises(ValueError, match="payload mass is nan kg"):
        transmissibility(np.eye(2)[None], [1.0], np.nan)


def test_no_links_leave_the_mount_alone():
    mount = damped_mounts()["resonant"].dynamic_stiffness(FREQUENCIES)
    link = foil_link(np.full((4, FREQUENCIES.size), 1e4), np.full((4, FREQUENCIES.size), 9e3))
    motion = transmissibility(in_parallel([(1, mount), (0, link)]), FREQUENCIES, MASS)
    np.testing.assert_array_equal(motion, motion[:1].repeat(4, axis=0))
    np.testing.assert_allclose(motion[0], transmissibility(mount, FREQUENCIES, MASS))


def test_links_raise_the_motion_by_one_plus_their_share_well_above_resonance():
    mount = IdealMount(STATIC).dynamic_stiffness(FREQUENCIES)
    stiffness = np.full(FREQUENCIES.size, 0.05 * STATIC.stiffness)
    both = in_parallel([(1, mount), (3, foil_link(stiffness, stiffness))])
    raised = np.abs(
        transmissibility(both, FREQUENCIES, MASS) / transmissibility(mount, FREQUENCIES, MASS)
    )
    share = stiffness_share(stiffness, mount[:, PAYLOAD, FLOOR], links=3)
    np.testing.assert_allclose(share, 0.15)
    far = FREQUENCIES > 100 * SUSPENSION_HZ
    np.testing.assert_allclose(decibels(raised[far]), decibels(1.15), atol=1e-3)


def test_share_is_kept_up_to_its_first_crossing_and_as_far_as_it_is_known():
    frequencies = np.geomspace(1, 1000, 31)
    slope = 0.01 * frequencies  # reaches 0.5 at 50 Hz
    dip = np.where(frequencies < 300, slope, 0.0)
    unknown = np.where(frequencies < 30, slope, np.nan)
    curves = np.array([slope, dip, 0 * slope + 0.4, 0 * slope + 0.6, unknown, np.nan * slope])
    kept = kept_up_to(frequencies, curves, 0.5)
    np.testing.assert_allclose(kept[:4], [50, 50, 1000, 0])
    assert kept[4] == frequencies[frequencies < 30][-1] and np.isnan(kept[5])
    assert kept_up_to(frequencies, np.where(frequencies > 90, 1.0, 0.0), 0.5) < 100


def test_share_without_frequencies_of_its_own_is_refused():
    with pytest.raises(ValueError, match="one share for each"):
        kept_up_to(np.arange(1.0, 4.0), np.ones((2, 4)), 0.1)
    with pytest.raises(ValueError, match="allowed share is 0"):
        kept_up_to(np.arange(1.0, 4.0), np.ones(3), 0)


def test_design_table_finds_the_frequency_where_a_rising_link_takes_its_share():
    cube = cube_with(lambda f: 1e-3 * f, 1e-3, links=4, stiffness_share_percent=20, up_to_hz=40.0)
    table = isolation_table(cube)
    assert len(table) == 2 * 2 * 4
    ideal = table[table["mount"] == "ideal"]
    # |D| of a structurally damped mount is k |1 + 2 i zeta|.
    crossing = 1e3 * 0.2 / 4 * np.hypot(1, 0.1)
    np.testing.assert_allclose(ideal["kept_to_hz_median"], crossing, rtol=1e-6)
    np.testing.assert_allclose(ideal["static_share_worst"], 4e-3)
    assert ideal["kept"].all() and not ideal["n_whole_band"].any()
    assert (isolation_table(cube, "driving") == table).all(axis=None)


def test_design_table_tells_the_worst_realisation_from_the_median():
    cube = cube_with(lambda f: 1e-3 * f, 1e-3, up_to_hz=90.0)
    cube["dynamic_stiffness"][0, 0, 2] *= 2
    cube["static_stiffness"][1, 1, 0] *= 200
    table = isolation_table(cube).query("mount == 'ideal' and direction == 'axial'")
    np.testing.assert_allclose(
        table["kept_to_hz_worst"] / np.hypot(1, 0.1), [50, 100, 100, 0], rtol=1e-6
    )
    np.testing.assert_allclose(table["kept_to_hz_median"] / np.hypot(1, 0.1), 100, rtol=1e-6)
    assert table["kept"].tolist() == [False, True, True, False]


def test_design_table_holds_a_link_against_the_resonant_mount_above_its_resonance():
    cube = cube_with(lambda f: 0 * f + 0.05, 0.05)
    table = isolation_table(cube).query("direction == 'radial'")
    by_mount = table.groupby("mount")["kept_to_hz_worst"].first()
    assert by_mount["ideal"] == 800 and (table["n_whole_band"] == 3).sum() == 4
    options = isolation_options(cube)
    mount = mounts(options, "radial")["resonant"]
    at = mount.dynamic_stiffness([by_mount["resonant"]])[0, PAYLOAD, FLOOR]
    assert abs(at) == pytest.approx(0.5 * static_spring(options, "radial").stiffness, rel=0.02)
    assert by_mount["resonant"] > 60


def test_cell_without_a_result_is_counted_and_spoils_no_other():
    cube = cube_with(lambda f: 1e-3 * f, 1e-3)
    cube["status"][0, 0, :] = "failed"
    cube["status"][0, 1, 0] = "diverged"
    table = isolation_table(cube)
    assert table.loc[:3, "n"].tolist() == [0, 2, 3, 3]
    assert np.isnan(table["kept_to_hz_worst"][0]) and not table["kept"][0]
    motion = payload_transmissibility(cube, "axial")["ideal"]
    assert np.isnan(motion.linked[0, 0]).all() and np.isfinite(motion.linked[1]).all()
    for name in ("design_chart", "transmissibility"):
        FIGURES[name].draw(cube=cube)


def test_frequency_asked_for_is_judged_within_the_band():
    table = isolation_table(cube_with(lambda f: 0 * f + 0.01, 0.01, up_to_hz=5000.0))
    assert (table["up_to_hz"] == 800).all() and table["kept"].any()


def test_findings_say_what_the_table_says():
    cube = cube_with(lambda f: 1e-3 * f, 1e-3, links=2, up_to_hz=30.0)
    table = isolation_table(cube)
    demand, axial, _ = isolation_findings(table, isolation_options(cube))
    assert "transfer stiffness of 2 foil links is to stay below 10 %" in demand
    assert "up to 30 Hz" in demand and "by 0.8 dB" in demand
    assert "in 4 of 4 configurations on the ideal mount, none thicker than 500" in axial
    assert "at rest" not in axial.lower()
    assert axial.endswith("is 0.20 to 0.20 % of the mount's.")
    cube["static_stiffness"][0, 1, 2] *= 200
    _, axial, _ = isolation_findings(isolation_table(cube), isolation_options(cube))
    assert "in 3 of 4 configurations on the ideal mount" in axial
    assert "At rest already, some realisation does not in 1." in axial
    cube["status"][:] = "failed"
    assert isolation_findings(isolation_table(cube), isolation_options(cube)) == []


def test_cube_of_a_study_without_the_section_takes_its_defaults():
    cube = make_cube(seeds=1)
    assert isolation_options(cube) == Isolation()
    assert len(isolation_table(cube)) == 2 * 2 * 20


def test_isolation_is_no_part_of_any_realisation():
    refined = {"stiffness": {"relaxed_refinements": 1}}
    one = system(**refined)
    other = system(isolation={"payload_mass_kg": 7.0, "links": 3}, **refined)
    for first, second in zip(one.cells(), other.cells()):
        assert one.crumple_task(first) == other.crumple_task(second)
        assert one.response_task(first) == other.response_task(second)
        assert one.refine_task(first) == other.refine_task(second)


def test_internal_resonance_that_the_mass_cannot_have_is_refused():
    with pytest.raises(ConfigError) as caught:
        system(isolation={"internal_resonance_hz": 10.0})
    (problem,) = caught.value.problems
    assert problem.startswith("isolation.internal_mass_percent is 1 %, too light")
    remedy = float(problem.partition("use at least ")[2].split(" ")[0])
    options = system(
        isolation={"internal_resonance_hz": 10.0, "internal_mass_percent": remedy}
    ).isolation
    assert set(mounts(options, "radial")) == {"ideal", "resonant"}
