"""Factorisation, inertia and eigenpairs against dense linear algebra."""

import os
import subprocess
import sys

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sparse
from conftest import cylinder

from foilstudy.linalg import (
    BlockKrylov,
    SolveError,
    SymmetricBlocks,
    backend,
    dissection,
    factorisation,
    factorise,
    lowest_modes,
    mass_orthonormal,
    modes_below,
    pardiso,
    projected,
    shifted,
)
from foilstudy.linalg.pardiso import PardisoFactorisation
from foilstudy.linalg.superlu import SuperLUFactorisation
from foilstudy.measure.stiffness import InterfaceSystem, Rings
from foilstudy.model.shell.elements.sampled import STAGGERED
from foilstudy.model.shell.held import held_blocks
from foilstudy.model.shell.tangent import mass_matrix

BACKENDS = [
    pytest.param(
        PardisoFactorisation,
        marks=pytest.mark.skipif(not pardiso.available(), reason="no MKL runtime"),
        id="pardiso",
    ),
    pytest.param(SuperLUFactorisation, id="superlu"),
]


def plate(rows, columns, shift=0.0):
    """Biharmonic operator on a grid: symmetric, sparse, with the stencil of a plate."""

    def second(n):
        return sparse.diags_array([-np.ones(n - 1), 2 * np.ones(n), -np.ones(n - 1)],
                                  offsets=[-1, 0, 1])  # fmt: skip

    laplacian = sparse.kronsum(second(rows), second(columns))
    return (laplacian @ laplacian - shift * sparse.eye_array(rows * columns)).tocsr()


def clamped_cylinder(element_size=20e-3):
    """Stiffness and mass of the interior of a clamped cylinder."""
    sheet = cylinder(element_size)
    rings = Rings.of(sheet.patch, sheet.reference)
    masses = sheet.material.density * sheet.thickness * sheet.section.areas
    matrices = sheet.tangent(), mass_matrix(sheet.patch, masses)
    return tuple(InterfaceSystem.split(matrix, rings).interior for matrix in matrices)


@pytest.fixture(params=BACKENDS)
def solver(request, monkeypatch):
    """Every solver in turn, also behind `factorise`."""
    name = "pardiso" if request.param is PardisoFactorisation else "superlu"
    monkeypatch.setattr(factorisation, "backend", lambda: name)
    return request.param


@pytest.mark.parametrize("shift", [0.0, 3.0])
def test_solution_agrees_with_dense(solver, shift):
    matrix = plate(9, 11, shift)
    rhs = np.random.default_rng(0).standard_normal((99, 5))
    factor = solver(matrix)
    expected = np.linalg.solve(matrix.toarray(), rhs)
    error = 10 * np.finfo(float).eps * np.linalg.cond(matrix.toarray()) * np.abs(expected).max()
    np.testing.assert_allclose(factor.solve(rhs), expected, rtol=0, atol=error)
    np.testing.assert_allclose(factor.solve(rhs[:, 0]), expected[:, 0], rtol=0, atol=error)


def test_complex_symmetric_solution_agrees_with_dense(solver):
    matrix = (plate(9, 8) * (1 + 0.1j) - 3.0 * sparse.eye_array(72)).tocsr()
    factor = factorise(matrix)
    rhs = np.random.default_rng(0).standard_normal((72, 3)) + 1j
    np.testing.assert_allclose(factor.solve(rhs), np.linalg.solve(matrix.toarray(), rhs), rtol=1e-9)
    assert factor.negative_eigenvalues is None


def test_complex_loads_on_a_real_matrix_are_refused(solver):
    with pytest.raises(TypeError, match="give both parts"):
        factorise(plate(5, 4)).solve(np.ones(20) * 1j)


def test_block_krylov_space_is_orthonormal_and_holds_what_is_new():
    stiffness, mass = clamped_cylinder()
    load = np.random.default_rng(1).standard_normal((stiffness.shape[0], 4))
    load = np.hstack([load, load[:, :1]])  # the last one is known already
    space, inverse = BlockKrylov(mass), factorise(stiffness)
    for _ in range(12):
        load = space.append(inverse, load)
    assert space.size == 48
    gram = space.vectors.T @ (mass @ space.vectors)
    np.testing.assert_allclose(gram, np.eye(48), atol=1e-12)
    known = space.vectors @ np.ones((48, 2))
    new = mass_orthonormal(np.hstack([known, load, 0 * load[:, :1]]), mass, space.vectors)
    assert new.shape[1] == 4
    np.testing.assert_allclose(space.vectors.T @ (mass @ new), 0, atol=1e-10)


def test_a_krylov_space_of_two_shifts_is_orthonormal_and_begins_with_what_is_known():
    """Blocks that wait for each other, a new shift, and a projection that grows with the space."""
    stiffness, mass = clamped_cylinder()
    rng = np.random.default_rng(1)
    space, projection = BlockKrylov(mass), np.empty((0, 0))
    for shift, blocks in ((0.0, 21), (1e6, 9)):
        inverse = shifted(stiffness, mass, shift)[0]
        load = rng.standard_normal((stiffness.shape[0], 5))
        for _ in range(blocks):
            load = space.append(inverse, load)
        projection = projected(stiffness, space.vectors, projection)
    vectors = space.vectors
    assert vectors.shape[1] == space.size == 150
    np.testing.assert_allclose(vectors.T @ (mass @ vectors), np.eye(150), atol=1e-12)
    np.testing.assert_allclose(projection, vectors.T @ (stiffness @ vectors), atol=1e-3, rtol=1e-9)
    more = BlockKrylov(mass, vectors)
    for _ in range(3):
        load = more.append(inverse, load)
    assert np.array_equal(more.vectors[:, :150], vectors) and more.size == 165
    np.testing.assert_allclose(more.vectors.T @ (mass @ more.vectors), np.eye(165), atol=1e-12)


@pytest.mark.parametrize("count", [5, 400])
def test_lowest_modes(solver, count):
    stiffness, mass = clamped_cylinder()
    modes = lowest_modes(stiffness, mass, factorise(stiffness), count)
    exact = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)[:count]
    np.testing.assert_allclose(modes.eigenvalues, exact, rtol=1e-8)
    gram = modes.shapes.T @ (mass @ modes.shapes)
    np.testing.assert_allclose(gram, np.eye(count), atol=1e-8)


def test_solvers_agree_on_a_shell():
    if not pardiso.available():
        pytest.skip("no MKL runtime")
    stiffness, _ = clamped_cylinder()
    rhs = np.random.default_rng(0).standard_normal(stiffness.shape[0])
    first, second = (s(stiffness).solve(rhs) for s in (PardisoFactorisation, SuperLUFactorisation))
    condition = np.linalg.cond(stiffness.toarray())
    assert np.linalg.norm(first - second) < 1e-15 * condition * np.linalg.norm(first)


@pytest.mark.parametrize("shift", [0.0, 0.5, 3.0, 17.3, 100.0])
def test_inertia_of_a_shifted_operator(solver, shift):
    matrix = plate(9, 11, shift)
    expected = int((np.linalg.eigvalsh(matrix.toarray()) < 0).sum())
    assert solver(matrix).negative_eigenvalues == expected


@pytest.mark.parametrize("seed", range(5))
def test_inertia_of_a_random_indefinite_matrix(solver, seed):
    random = sparse.random_array((80, 80), density=0.05, rng=np.random.default_rng(seed))
    matrix = (random + random.T + sparse.diags_array(np.linspace(-2, 2, 80))).tocsr()
    expected = int((np.linalg.eigvalsh(matrix.toarray()) < 0).sum())
    assert solver(matrix).negative_eigenvalues == expected


def test_inertia_where_the_diagonal_offers_no_pivot(solver):
    """A saddle point: the negative eigenvalues do not show on any diagonal."""
    constraint = np.random.default_rng(0).standard_normal((4, 12))
    dense = np.block([[np.zeros((12, 12)), constraint.T], [constraint, np.zeros((4, 4))]])
    dense += np.diag(np.r_[np.tile([1.0, 0.0], 6), np.zeros(4)])
    expected = int((np.linalg.eigvalsh(dense) < 0).sum())
    try:
        found = solver(sparse.csr_array(dense)).negative_eigenvalues
    except SolveError:
        return  # refusing is honest, a wrong count is not
    assert found == expected


def test_inertia_of_a_shell_counts_its_modes(solver):
    stiffness, mass = clamped_cylinder(25e-3)
    values = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)
    gaps = np.flatnonzero(np.diff(values) > 1e-3 * values[:-1])  # not between the two of a pair
    limits = [0.5 * values[0], *(0.5 * (values[gaps[:20]] + values[gaps[:20] + 1]))]
    for limit in limits:
        expected = int((values < limit).sum())
        assert solver((stiffness - limit * mass).tocsr()).negative_eigenvalues == expected


def periodic_chain():
    ring = 2 * np.eye(50) - np.roll(np.eye(50), 1, axis=0) - np.roll(np.eye(50), -1, axis=0)
    return sparse.csr_array(ring)


SINGULAR = {
    "periodic chain": periodic_chain,
    "sheet without rings": lambda: cylinder(20e-3).tangent(),
    "empty row": lambda: sparse.diags_array(np.r_[1.0, 0.0, np.ones(8)]).tocsr(),
}


@pytest.mark.parametrize("make", SINGULAR.values(), ids=SINGULAR)
def test_a_singular_matrix_is_refused(solver, make):
    with pytest.raises(SolveError):
        factorise(make())


@pytest.mark.parametrize("shift", [0.0, 0.4])
def test_unknowns_may_have_units_far_apart(solver, shift):
    """As forces and the moments of rings of a millimetre: regular, whatever Pardiso calls small."""
    matrix = plate(4, 4) - shift * sparse.eye_array(16)
    units = np.where(np.arange(16) < 13, 1.0, 1e-6)
    apart = (sparse.diags_array(units) @ matrix @ sparse.diags_array(units)).tocsr()
    factor, loads = factorise(apart), np.linspace(1, 2, 16)
    negative = (np.linalg.eigvalsh(matrix.toarray()) < 0).sum()
    assert factor.negative_eigenvalues == negative
    expected = np.linalg.solve(matrix.toarray(), loads)
    for rhs in (units * loads, np.stack([units * loads] * 2, axis=1)):
        solution = units * factor.solve(rhs).T
        np.testing.assert_allclose(solution, np.broadcast_to(expected, solution.shape), rtol=1e-9)


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_refused_before_any_solver_sees_them(
    solver, number, monkeypatch
):
    """Native code may never come back from them, or die."""
    matrix, loads = plate(4, 4), np.ones((16, 2))
    factor = factorise(matrix)
    loads[3, 1] = number
    with pytest.raises(SolveError, match="right-hand side holds 1 numbers that are not finite"):
        factor.solve(loads)
    monkeypatch.setattr(pardiso, "_job_for", None)
    monkeypatch.setattr("foilstudy.linalg.superlu.splu", None)
    matrix.data[5] = number
    with pytest.raises(SolveError, match="matrix holds 1 numbers that are not finite"):
        factorise(matrix)


def test_mode_searches_and_krylov_spaces_refuse_numbers_that_are_not_finite():
    stiffness, mass = clamped_cylinder(25e-3)
    factor = factorise(stiffness)
    holed = mass.copy()
    holed.data[7] = np.nan
    with pytest.raises(SolveError, match="not finite"):
        modes_below(stiffness, holed, 1e6)
    with pytest.raises(SolveError, match="not finite"):
        lowest_modes(stiffness, holed, factor, 4)
    load = np.ones((stiffness.shape[0], 2))
    with pytest.raises(SolveError, match="not finite"):
        BlockKrylov(holed).append(factor, load)
    load[:, 1] = 0.0  # a direction of no length is nothing, not a number over zero
    assert BlockKrylov(mass).append(factor, load).shape[1] == 1


def test_the_same_bits_every_time(solver):
    stiffness, mass = clamped_cylinder()
    rhs = np.random.default_rng(0).standard_normal((stiffness.shape[0], 12))
    assert np.array_equal(factorise(stiffness).solve(rhs), factorise(stiffness).solve(rhs))
    limit = (2 * np.pi * 500) ** 2
    first, second = (modes_below(stiffness, mass, limit) for _ in range(2))
    assert np.array_equal(first.eigenvalues, second.eigenvalues)
    assert np.array_equal(first.shapes, second.shapes)


def test_the_solver_in_use_is_named():
    assert backend() == ("pardiso" if pardiso.available() else "superlu")


def assert_are_all_modes(modes, stiffness, mass, limit):
    """Against the dense spectrum: exactly those below the limit, orthonormal, true pairs."""
    values = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)
    expected = values[values < limit]
    assert modes.eigenvalues.size == expected.size
    assert modes.shapes.shape == (stiffness.shape[0], expected.size)
    # Ritz values err by the square of the residual tolerance, dense ones by their largest value
    atol = 1e-11 * limit + 100 * np.finfo(float).eps * values[-1]
    np.testing.assert_allclose(modes.eigenvalues, expected, rtol=0, atol=atol)
    assert (np.diff(modes.eigenvalues) >= 0).all()
    gram = modes.shapes.T @ (mass @ modes.shapes)
    # one Gram-Schmidt pass between blocks loses some digits
    np.testing.assert_allclose(gram, np.eye(expected.size), rtol=0, atol=1e-10)
    reduced = modes.shapes.T @ (stiffness @ modes.shapes)
    np.testing.assert_allclose(reduced, np.diag(modes.eigenvalues), rtol=0, atol=1e-5 * limit)


@pytest.mark.parametrize("limit_hz", [150, 400, 900])
def test_modes_of_a_clamped_cylinder(solver, limit_hz):
    """Its modes come in pairs, cos and sin of the same wave."""
    stiffness, mass = clamped_cylinder()
    limit = (2 * np.pi * limit_hz) ** 2
    modes = modes_below(stiffness, mass, limit)
    assert_are_all_modes(modes, stiffness, mass, limit)


def test_most_modes_of_a_small_system(solver):
    """More modes than a Krylov space could hold apart."""
    stiffness, mass = clamped_cylinder(25e-3)
    values = scipy.linalg.eigh(stiffness.toarray(), mass.toarray(), eigvals_only=True)
    limit = 0.5 * (values[len(values) // 2] + values[len(values) // 2 + 1])
    modes = modes_below(stiffness, mass, limit)
    assert_are_all_modes(modes, stiffness, mass, limit)


def test_modes_of_a_free_cylinder(solver):
    """Six rigid modes at zero, then pairs."""
    sheet = cylinder(20e-3)
    masses = sheet.material.density * sheet.thickness * sheet.section.areas
    stiffness, mass = sheet.tangent(), mass_matrix(sheet.patch, masses)
    limit = (2 * np.pi * 60) ** 2
    modes = modes_below(stiffness, mass, limit)
    assert_are_all_modes(modes, stiffness, mass, limit)
    assert (np.abs(modes.eigenvalues[:6]) < 1e-6 * limit).all()
    assert modes.eigenvalues[6] > 1e-3 * limit


def test_modes_far_below_all_others_are_found(solver):
    """After one solution with them all vectors look alike, as with foil very thin for its mesh."""
    stiffness = sparse.diags_array(np.r_[1.0, 2.0, np.geomspace(1e12, 1e14, 98)]).tocsr()
    modes = modes_below(stiffness, sparse.eye_array(100).tocsr(), 3.0)
    np.testing.assert_allclose(modes.eigenvalues, [1, 2], rtol=1e-9)
    np.testing.assert_allclose(np.abs(modes.shapes[:2]), np.eye(2), atol=1e-6)


def test_a_mode_search_that_breaks_down_says_what_to_do(solver):
    """Nothing is orthonormal by a mass that is mostly negative."""
    stiffness = sparse.diags_array(np.geomspace(1, 2, 100)).tocsr()
    mass = sparse.diags_array(np.r_[np.full(4, 1.0), np.full(96, -1.0)]).tocsr()
    with pytest.raises(SolveError, match="broke down.* finer mesh"):
        modes_below(stiffness, mass, 1.05)


@pytest.mark.parametrize("copies", [2, 3, 8])
def test_repeated_eigenvalues_are_all_found(solver, copies):
    one = plate(8, 12)
    stiffness = sparse.kron(sparse.eye_array(copies), one).tocsr()
    mass = sparse.diags_array(np.full(96 * copies, 2.0)).tocsr()
    limit = 2.0
    modes = modes_below(stiffness, mass, limit)
    assert modes.eigenvalues.size % copies == 0
    assert_are_all_modes(modes, stiffness, mass, limit)


def test_no_mode_below_the_limit(solver):
    stiffness, mass = clamped_cylinder()
    modes = modes_below(stiffness, mass, 1.0)
    assert modes.eigenvalues.shape == (0,)
    assert modes.shapes.shape == (stiffness.shape[0], 0)


@pytest.mark.skipif(not pardiso.available(), reason="needs MKL")
def test_a_kept_analysis_changes_no_bit():
    """The second matrix of a pattern is factored with the analysis of the first."""
    sheet = cylinder(20e-3)
    rings = Rings.of(sheet.patch, sheet.reference)
    points = sheet.reference * np.array([1.0, 1.0, 0.999])[:, None, None]
    first, second = (
        InterfaceSystem.split(sheet.tangent(p), rings).interior for p in (None, points)
    )
    probe = np.cos(np.arange(first.shape[0], dtype=float))
    alone = factorise(second)
    expected, inertia = alone.solve(probe), alone.negative_eigenvalues
    del alone
    pardiso._analysed.clear()  # leaks a little, on purpose: nothing is to be found
    factor = factorise(first)
    assert not pardiso._analysed  # it is in use
    del factor
    assert len(pardiso._analysed) == 1
    again = factorise(second)
    assert not pardiso._analysed  # taken
    assert np.array_equal(again.solve(probe), expected)
    assert again.negative_eigenvalues == inertia


@pytest.mark.parametrize("closed", [True, False])
@pytest.mark.parametrize("rows, columns", [(1, 7), (3, 50), (40, 5), (34, 126)])
def test_dissection_orders_every_point_once(rows, columns, closed):
    order = dissection(rows, columns, 2, closed)
    assert np.array_equal(np.sort(order), np.arange(rows * columns))


def test_dissection_parts_the_grid():
    """What stands before the separators at the end falls into two parts that do not touch."""
    rows, columns, reach = 30, 60, 2
    order = dissection(rows, columns, reach, closed=True)
    around = np.zeros(columns, dtype=bool)
    around[order[: -2 * reach * rows] % columns] = True
    assert around.sum() == columns - 2 * reach
    assert np.abs(np.diff(around.astype(int))).sum() == 3  # open in the middle and at the seam
    assert not around[columns - reach :].any()


def definite_blocks(element_size=20e-3, element=None):
    """Stiffness of a clamped cylinder as blocks and as a sparse matrix."""
    sheet = cylinder(element_size, element=element)
    rings = Rings.of(sheet.patch, sheet.reference)
    whole = InterfaceSystem.split(sheet.tangent(), rings).interior
    return held_blocks(sheet.patch, sheet.tangent_blocks()), whole


def test_blocks_are_the_matrix_between_the_rings():
    blocks, whole = definite_blocks()
    assert blocks.shape == whole.shape
    np.testing.assert_allclose(blocks.full().toarray(), whole.toarray(), rtol=0, atol=1e-9)
    np.testing.assert_array_equal(blocks.diagonal(), whole.diagonal())
    vector = np.cos(np.arange(whole.shape[0], dtype=float))
    np.testing.assert_allclose(blocks @ vector, whole @ vector, rtol=0, atol=1e-8)
    np.testing.assert_allclose(abs(blocks) @ vector, abs(whole) @ vector, rtol=0, atol=1e-8)


def test_blocks_are_solved_as_the_matrix_is(solver):
    blocks, whole = definite_blocks()
    load = np.random.default_rng(0).standard_normal((whole.shape[0], 3))
    factor = factorise(blocks)
    assert isinstance(factor, solver)
    expected = factorise(whole).solve(load)
    error = 1e-8 * np.abs(expected).max()
    np.testing.assert_allclose(factor.solve(load), expected, rtol=0, atol=error)
    assert factor.negative_eigenvalues == 0


def test_blocks_that_are_not_definite_are_refused(solver):
    blocks, _ = definite_blocks()
    values = blocks.values.copy()
    values[blocks.pattern.starts[7]] *= -1
    with pytest.raises(SolveError):
        factorise(SymmetricBlocks(blocks.pattern, values))


@pytest.mark.skipif(not pardiso.available(), reason="needs MKL")
def test_a_kept_analysis_of_blocks_changes_no_bit():
    """The staggered element is factored with the analysis of the corner one on the same mesh."""
    first, _ = definite_blocks()
    second, _ = definite_blocks(element=STAGGERED)
    probe = np.cos(np.arange(first.shape[0], dtype=float))
    pardiso._analysed.clear()
    expected = PardisoFactorisation(second).solve(probe)
    pardiso._analysed.clear()  # leaks a little, on purpose: nothing is to be found
    PardisoFactorisation(first)
    assert len(pardiso._analysed) == 1
    again = PardisoFactorisation(second)
    assert not pardiso._analysed  # taken
    assert np.array_equal(again.solve(probe), expected)


@pytest.mark.skipif(not pardiso.available(), reason="no MKL runtime")
@pytest.mark.parametrize(
    "variable", ["MKL_INTERFACE_LAYER=ILP64", "MKL_INTERFACE_LAYER=GNU", "MKL_THREADING_LAYER=TBB"]
)
def test_layers_of_mkl_that_a_shell_asks_for_are_not_taken(variable):
    """Longer integers made it refuse the matrix, a layer that is not installed end the process."""
    code = (
        "import scipy.sparse as s; from foilstudy.linalg.pardiso import PardisoFactorisation as P; "
        "print(P(s.csr_matrix([[4.0, 1.0], [1.0, 2.0]])).solve(__import__('numpy').ones(2)).sum())"
    )
    name, _, value = variable.partition("=")
    run = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {name: value},
        capture_output=True,
        text=True,
        check=True,
    )
    assert float(run.stdout) == pytest.approx(4 / 7)
