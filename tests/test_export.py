"""Each export format, read back by its own library."""

import csv
import re
import shutil
import subprocess
from types import SimpleNamespace

import meshio
import numpy as np
import pytest
import pyuff
import xarray as xr
from conftest import DIAMETER, FOIL, GAP_HEIGHT, THICKNESS, cylinder
from scipy.io import loadmat
from scipy.linalg import eigh
from test_workflow import changed, plan

from foilstudy.base.record import read_attributes, write_record
from foilstudy.command import main
from foilstudy.config import Export, load_config
from foilstudy.config.foils import foil_of
from foilstudy.config.scene import recipe_of
from foilstudy.export.contents import Contents, surface_grid
from foilstudy.export.energies import element_energies, principal_strains
from foilstudy.export.formats import FORMATS
from foilstudy.export.write import write
from foilstudy.measure.dynamics import (
    CONDITIONS,
    DEFINITIONS,
    DynamicsOptions,
    ModalDamping,
    RayleighDamping,
    StructuralDamping,
    directional_stiffness,
    interface_dynamic_stiffness,
)
from foilstudy.measure.dynamics.damping_matrix import damping_matrix
from foilstudy.measure.dynamics.structure import INTERFACE
from foilstudy.measure.stiffness import DOF_NAMES, fixed_stiffness
from foilstudy.measure.stiffness.directional import DIRECTIONS
from foilstudy.model.patch import RING_ROWS
from foilstudy.model.shell.elements import ELEMENTS
from foilstudy.model.shell.shell import Shell
from foilstudy.pipeline.crumpled import described
from foilstudy.pipeline.shape import Shape
from foilstudy.pipeline.surface import SurfaceGrid, sheet_from_grid
from foilstudy.pipeline.surface.fit import fitted_patch
from foilstudy.study.sweep.export import contents_of, export_realisation
from foilstudy.study.sweep.origins import crumple_origin, response_origin
from foilstudy.study.sweep.quantities import quantities

MODES = 4
RATIO, BAND_HZ = 0.05, 300.0
VISCOUS = [ModalDamping(RATIO), RayleighDamping.between(RATIO, 20.0, 300.0)]


@pytest.fixture(scope="module")
def contents(coarse_crumple):
    sheet = coarse_crumple.sheet
    crumple = Shape(FOIL, sheet.patch, coarse_crumple.points, sheet.reference, sheet.element)
    options = DynamicsOptions(
        highest_hz=BAND_HZ, frequencies=25, damping=ModalDamping(RATIO), mode_shapes=MODES
    )
    return Contents(crumple, options, {"seed": "0", "created": "2026-01-01T00:00:00+00:00"})


@pytest.fixture(scope="module")
def folder(contents, tmp_path_factory):
    """Every format, written once."""
    folder = tmp_path_factory.mktemp("export")
    for name, kind in FORMATS.choices.items():
        write(contents, name, folder / kind.filename)
    return folder


def second_order_stiffness(k, m, c, frequencies):
    """Interface dynamic stiffness of M, C and K: the inverse of the receptance of the rings."""
    omega = 2 * np.pi * np.asarray(frequencies)[:, None, None]
    dynamic = k - omega**2 * m + 1j * omega * c
    inner = dynamic[:, INTERFACE:, INTERFACE:]
    carried = np.linalg.solve(inner, dynamic[:, INTERFACE:, :INTERFACE])
    return dynamic[:, :INTERFACE, :INTERFACE] - dynamic[:, :INTERFACE, INTERFACE:] @ carried


def assert_same_stiffness(ours, expected, tolerance=1e-9):
    """Every pair of motions against the two diagonal terms that belong to it."""
    diagonal = np.abs(np.einsum("fii->fi", expected))
    scale = np.sqrt(diagonal[:, :, None] * diagonal[:, None, :])
    assert (np.abs(ours - expected) / scale).max() < tolerance


# --- damping matrix ------------------------------------------------------------------------------


@pytest.mark.parametrize("damping", VISCOUS)
def test_damping_matrix_gives_the_dynamic_stiffness_of_its_damping(contents, damping):
    model = contents.model
    c = damping_matrix(model, damping)
    ours = second_order_stiffness(model.stiffness, model.mass, c, contents.frequencies)
    expected = interface_dynamic_stiffness(model, contents.frequencies, damping)
    assert_same_stiffness(ours, expected)


@pytest.mark.parametrize("damping", VISCOUS)
def test_damping_matrix_never_feeds_energy_in(contents, damping):
    c = damping_matrix(contents.model, damping)
    np.testing.assert_allclose(c, c.T, rtol=0, atol=1e-12 * np.abs(c).max())
    scale = 1 / np.sqrt(np.diag(contents.model.mass))
    values = np.linalg.eigvalsh(c * np.outer(scale, scale))
    assert values[0] > -1e-10 * values[-1]


def test_rayleigh_matrix_is_the_textbook_sum(contents):
    """alpha M + beta K, where K of the rigid motions is exactly zero."""
    model, damping = contents.model, VISCOUS[1]
    expected = damping.mass_coefficient * model.mass
    expected = expected + damping.stiffness_coefficient * model.stiffness
    scale = np.sqrt(np.outer(np.diag(expected), np.diag(expected)))
    ours = damping_matrix(model, damping)
    np.testing.assert_allclose(ours / scale, expected / scale, rtol=0, atol=1e-9)


def test_modal_damping_leaves_rigid_motions_undamped(contents):
    values, vectors = contents.model.free_modes()
    c = vectors.T @ damping_matrix(contents.model, ModalDamping(RATIO)) @ vectors
    expected = np.diag(2 * RATIO * np.sqrt(values))
    np.testing.assert_allclose(c, expected, rtol=0, atol=1e-8 * expected.max())


def test_structural_damping_has_no_matrix(contents):
    with pytest.raises(ValueError, match="not viscous"):
        damping_matrix(contents.model, StructuralDamping(0.1))


# --- reduced models ------------------------------------------------------------------------------


def test_netcdf_model_reproduces_the_dynamic_stiffness(contents, folder):
    with xr.open_dataset(folder / "reduced.nc") as file:
        k, m, c = (file[name].values for name in ("stiffness", "mass", "damping"))
        assert list(file.interface_dof.values) == list(DOF_NAMES)
        np.testing.assert_array_equal(file.interface_map.values, contents.model.interface_map)
        assert all(variable.attrs["units"] for variable in file.data_vars.values())
        assert file.attrs["seed"] == "0" and file.attrs["rigid_modes"] == 6
        assert file.attrs["reduction"] == contents.model.method
    for matrix in (k, m):
        np.testing.assert_array_equal(matrix, matrix.T)
    assert_same_stiffness(
        second_order_stiffness(k, m, c, contents.frequencies), contents.dynamic_stiffness
    )
    np.testing.assert_array_equal(
        fixed_stiffness(k[:INTERFACE, :INTERFACE]),
        fixed_stiffness(contents.model.static_stiffness),
    )


@pytest.fixture(scope="module")
def matlab(folder):
    return loadmat(folder / "reduced.mat", squeeze_me=True, simplify_cells=True)


def test_matlab_matrices_reproduce_the_dynamic_stiffness(contents, matlab):
    k, m, c, b = (matlab[name] for name in "KMCB")
    omega = 2 * np.pi * matlab["frequency_Hz"][:, None, None]
    receptance = b.T @ np.linalg.solve(k - omega**2 * m + 1j * omega * c, b)
    assert_same_stiffness(np.linalg.inv(receptance), contents.dynamic_stiffness)
    recorded = np.moveaxis(matlab["dynamic_stiffness"], 2, 0)
    np.testing.assert_array_equal(recorded, contents.dynamic_stiffness)
    assert list(matlab["motion_names"]) == list(DOF_NAMES)
    assert list(matlab["motion_units"][2:4]) == ["m", "rad"]
    assert matlab["provenance"]["seed"] == "0"


def test_matlab_state_space_is_the_receptance_of_the_rings(contents, matlab):
    a, b, c, d = (matlab["sys"][name] for name in "ABCD")
    s = 2j * np.pi * contents.frequencies[:, None, None]
    receptance = c @ np.linalg.solve(s * np.eye(len(a)) - a, b.astype(complex)) + d
    assert_same_stiffness(np.linalg.inv(receptance), contents.dynamic_stiffness)


def test_state_space_is_stable_but_for_the_rigid_motions(matlab):
    poles = np.linalg.eigvals(matlab["sys"]["A"])
    rigid = np.abs(poles) < 1e-6
    assert rigid.sum() == 12  # six double poles at zero
    assert (poles[~rigid].real < 0).all()
    damping = -poles[~rigid].real / np.abs(poles[~rigid])
    np.testing.assert_allclose(damping, RATIO, rtol=1e-6)


# --- frequency responses -------------------------------------------------------------------------


def test_universal_file_holds_every_pair_of_motions(contents, folder):
    sets = pyuff.UFF(str(folder / "frequency_response.uff")).read_sets()
    header, units, nodes, *functions = sets
    assert units["units_code"] == 1 and units["length"] == 1.0
    assert list(nodes["node_nums"]) == [1, 2]
    np.testing.assert_allclose(nodes["z"], contents.ring_heights, atol=1e-6)
    pairs = [f for f in functions if f["rsp_node"]]
    assert len(pairs) == 144
    expected = contents.dynamic_stiffness
    for function in pairs:
        i = 6 * (int(function["rsp_node"]) - 1) + int(function["rsp_dir"]) - 1
        j = 6 * (int(function["ref_node"]) - 1) + int(function["ref_dir"]) - 1
        assert DOF_NAMES[i] in function["id1"] and function["id1"].strip().endswith(DOF_NAMES[j])
        np.testing.assert_allclose(function["x"], contents.frequencies, rtol=1e-5)
        peak = np.abs(expected[:, i, j]).max()
        np.testing.assert_allclose(function["data"], expected[:, i, j], rtol=0, atol=1e-11 * peak)


def test_universal_file_names_definition_and_direction(contents, folder):
    sets = pyuff.UFF(str(folder / "frequency_response.uff")).read_sets()
    named = {f["id1"].strip(): f["data"] for f in sets[3:] if not f["rsp_node"]}
    stiffness = directional_stiffness(contents.dynamic_stiffness)
    assert len(named) == 6
    for d, definition in enumerate(DEFINITIONS):
        for e, direction in enumerate(DIRECTIONS):
            ours = named[f"{definition} {direction} dynamic stiffness"]
            np.testing.assert_allclose(ours, stiffness[d, e], rtol=1e-11)


def test_table_has_units_and_every_digit(contents, folder):
    with (folder / "frequency_response.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    values = dict(zip(header, np.array(rows, dtype=float).T, strict=True))
    np.testing.assert_array_equal(values.pop("frequency (Hz)"), contents.frequencies)
    stiffness = directional_stiffness(contents.dynamic_stiffness)
    for d, definition in enumerate(DEFINITIONS):
        for e, direction in enumerate(DIRECTIONS):
            for part in ("real", "imag"):
                column = values.pop(f"{definition} {direction} {part} (N/m)")
                np.testing.assert_array_equal(column, getattr(stiffness[d, e], part))
    assert not values


MOTIONS = [(q, c) for q in ("receptance", "accelerance") for c in CONDITIONS]


@pytest.mark.parametrize(("quantity", "condition"), MOTIONS)
def test_universal_file_for_modal_software(contents, folder, quantity, condition):
    """What its fields say, after the specification of dataset 58, and the values."""
    sets = pyuff.UFF(str(folder / f"{quantity}_{condition}.uff")).read_sets()
    header, units, nodes, *functions = sets
    assert header["model_name"].strip() == str(contents.crumple.foil)
    assert header["description"].strip() == "crumpled, seed 0"
    assert units["units_code"] == 1 and list(nodes["node_nums"]) == [1, 2]
    expected = contents.motion_per_force(quantity, condition)
    size = {"free": 12, "bottom_held": 6}[condition]
    assert len(functions) == size**2
    places = set()
    for function in functions:
        response, reference = (
            (int(function[f"{end}_node"]), int(function[f"{end}_dir"])) for end in ("rsp", "ref")
        )
        places.add((response, reference))
        i, j = (6 * (node - 1) + way - 1 for node, way in (response, reference))
        assert function["id1"].strip() == f"{quantity}: {DOF_NAMES[i]} per force on {DOF_NAMES[j]}"
        assert function["func_type"] == 4 and function["ord_data_type"] == 5
        assert function["abscissa_spec_data_type"] == 18 and function["abscissa_spacing"] == 1
        assert function["ordinate_spec_data_type"] == {"receptance": 8, "accelerance": 12}[quantity]
        assert function["orddenom_spec_data_type"] == 13
        unit = ("m" if response[1] <= 3 else "rad") + ("" if quantity == "receptance" else "/s^2")
        assert function["ordinate_axis_units_lab"].strip() == unit
        force = "N" if reference[1] <= 3 else "N m"
        assert function["orddenom_axis_units_lab"].strip() == force
        assert function["id3"].strip() == "01-JAN-26 00:00:00"
        assert function["id5"].strip() == contents.even_grid.words
        np.testing.assert_allclose(function["x"], contents.even_grid.frequencies, rtol=1e-9)
        first = 12 - size
        values = expected[:, i - first, j - first]
        np.testing.assert_allclose(function["data"].real, values.real, rtol=1e-5, atol=1e-99)
        np.testing.assert_allclose(function["data"].imag, values.imag, rtol=1e-5, atol=1e-99)
    assert len(places) == size**2
    nodes = {node for node, _ in (place for pair in places for place in pair)}
    assert nodes == ({1, 2} if condition == "free" else {2})


def test_dynamic_stiffness_in_a_universal_file_is_force_per_displacement(folder):
    sets = pyuff.UFF(str(folder / "frequency_response.uff")).read_sets()
    for function in sets[3:]:
        assert function["func_type"] == 4 and function["abscissa_spacing"] == 0
        assert function["ordinate_spec_data_type"] == 13
        assert function["orddenom_spec_data_type"] == 8
        if not function["rsp_node"]:  # exponents follow from the direction, where there is one
            assert function["ordinate_force_unit_exp"] == function["orddenom_len_unit_exp"] == 1


@pytest.mark.parametrize(("quantity", "condition"), MOTIONS)
def test_table_of_motion_per_force_has_units_and_every_digit(contents, folder, quantity, condition):
    with (folder / f"{quantity}_{condition}.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    values = dict(zip(header, np.array(rows, dtype=float).T, strict=True))
    np.testing.assert_array_equal(values.pop("frequency (Hz)"), contents.even_grid.frequencies)
    expected = contents.motion_per_force(quantity, condition)
    names = DOF_NAMES[12 - expected.shape[1] :]
    per = {"receptance": "", "accelerance": "/s^2"}[quantity]
    for i, response in enumerate(names):
        for j, reference in enumerate(names):
            unit = ("m" if "_u" in response else "rad") + per
            unit += "/N" if "_u" in reference else "/(N m)"
            for part in ("real", "imag"):
                column = values.pop(f"{response} per force on {reference} {part} ({unit})")
                np.testing.assert_array_equal(column, getattr(expected[:, i, j], part))
    assert not values


def test_matlab_file_of_motion_per_force(contents, folder):
    content = loadmat(folder / "motion_per_force.mat", squeeze_me=True, simplify_cells=True)
    np.testing.assert_array_equal(content["frequency_Hz"], contents.even_grid.frequencies)
    assert content["spacing_Hz"] == contents.even_grid.spacing
    for condition, names in (("free", DOF_NAMES), ("bottom_held", DOF_NAMES[6:])):
        part = content[condition]
        assert list(part["motion_names"]) == list(names)
        assert len(part["motion_units"]) == len(part["force_units"]) == len(names)
        for quantity in ("receptance", "accelerance"):
            ours = np.moveaxis(part[quantity], 2, 0)
            np.testing.assert_array_equal(ours, contents.motion_per_force(quantity, condition))


def test_matlab_matrices_without_the_bottom_ring_give_the_receptance_of_the_other_file(
    folder, matlab
):
    """As the page does it: K(k,k) - w^2*M(k,k) + 1i*w*C(k,k) with k = 7:size(K, 1)."""
    held = loadmat(folder / "motion_per_force.mat", squeeze_me=True, simplify_cells=True)
    at = len(held["frequency_Hz"]) // 3
    w = 2 * np.pi * held["frequency_Hz"][at]
    k, m, c = (matlab[name][6:, 6:] for name in "KMC")
    ours = np.linalg.solve(k - w**2 * m + 1j * w * c, np.eye(len(k), 6))[:6]
    expected = held["bottom_held"]["receptance"][:, :, at]
    np.testing.assert_allclose(ours, expected, rtol=0, atol=1e-8 * np.abs(expected).max())


# --- shapes --------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def mesh(folder):
    return meshio.read(folder / "shape.vtu")


def test_paraview_cells_are_the_elements(contents, mesh):
    (block,) = mesh.cells
    patch = contents.crumple.patch
    assert block.type == "quad9" and len(block.data) == patch.elements_along * patch.elements_around
    assert np.array_equal(np.unique(block.data), np.arange(len(mesh.points)))
    corners = mesh.points[block.data[:, :4]]
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    outward = corners.mean(axis=1) * [1, 1, 0]
    first_row = slice(0, patch.elements_around)  # upright at the ring
    assert ((normals * outward).sum(axis=1)[first_row] > 0).all()
    middles = mesh.points[block.data[:, 4:8]].mean(axis=1)
    size = max(patch.size_around, patch.size_along)
    assert np.linalg.norm(mesh.points[block.data[:, 8]] - middles, axis=1).max() < 0.5 * size


def test_paraview_displacement_leads_from_the_undeformed_shape_to_the_crumple(contents, mesh):
    fields = mesh.point_data
    start = fields["reference_position_m"]
    np.testing.assert_allclose(start + fields["displacement_m"], mesh.points, atol=1e-15)
    radius = [np.hypot(*points.T[:2]) for points in (mesh.points, start)]
    np.testing.assert_allclose(fields["radial_displacement_m"], radius[0] - radius[1], atol=1e-15)
    assert np.ptp(start[:, 2]) == pytest.approx(FOIL.reference_height, rel=1e-3)
    assert np.ptp(mesh.points[:, 2]) == pytest.approx(GAP_HEIGHT, rel=1e-9)


def test_energy_densities_integrate_to_the_energies_of_the_crumple(coarse_crumple, mesh):
    energies = coarse_crumple.sheet.energies(coarse_crumple.points)
    area = mesh.cell_data["reference_area_m2"][0]
    assert area.sum() == pytest.approx(np.pi * DIAMETER * FOIL.reference_height, rel=1e-3)
    for name in ("membrane", "bending", "stabilisation"):
        density = mesh.cell_data[f"{name}_energy_J_per_m2"][0]
        assert (density >= 0).all()
        assert density @ area == pytest.approx(getattr(energies, name), rel=1e-10)


@pytest.mark.parametrize("element", [ELEMENTS[name]() for name in ELEMENTS], ids=ELEMENTS)
def test_element_energies_sum_to_the_energy_of_a_sheet(coarse_crumple, element):
    sheet = coarse_crumple.sheet
    sheet = Shell.elastic(sheet.patch, sheet.reference, sheet.material, THICKNESS, element)
    energies = sheet.energies(coarse_crumple.points)
    expected = [energies.membrane, energies.bending, energies.stabilisation]
    ours = element_energies(sheet, coarse_crumple.points).sum(axis=(1, 2))
    np.testing.assert_allclose(ours, expected, rtol=1e-10)


def test_strains_of_a_stretched_and_narrowed_cylinder_are_the_exact_ones():
    """Along by 1 + s, around by 1 + w: Green strains s + s2/2 and w + w2/2, curvature w/R."""
    s, w = 0.02, -0.01
    sheet = cylinder(5e-3)
    points = sheet.reference * np.array([1 + w, 1 + w, 1 + s])[:, None, None]
    strains = principal_strains(sheet, points)
    np.testing.assert_allclose(strains.membrane_max, s + s**2 / 2, rtol=1e-9)
    # around, corner and middle are the circle's to second order in the element's angle
    np.testing.assert_allclose(strains.membrane_min, w + w**2 / 2, rtol=2e-3)
    np.testing.assert_allclose(np.abs(strains.curvature), abs(w) / (DIAMETER / 2), rtol=2e-3)


def test_mode_fields_are_orthonormal_in_mass_and_rest_at_the_rings(contents, coarse_crumple, mesh):
    names = [name for name in mesh.point_data if name.startswith("mode_")]
    frequencies, _ = contents.model.clamped_modes(MODES)
    stated = [float(name.split("_")[2]) for name in names]
    np.testing.assert_allclose(stated, frequencies, atol=0.006)
    patch = contents.crumple.patch
    shape = (2 * patch.elements_along + 1, patch.columns * 2, 3)
    controls = []
    for name in names:
        field = mesh.point_data[name].reshape(shape)
        assert not field[[0, -1]].any()
        controls.append(fitted_patch(SurfaceGrid(field.astype(float), 2))[1])
    inner = np.array(controls)[:, :, RING_ROWS:-RING_ROWS]
    inner = np.moveaxis(inner, 1, 3).reshape(MODES, -1)
    product = inner @ (coarse_crumple.mass.interior @ inner.T)
    np.testing.assert_allclose(product, np.eye(MODES), atol=1e-5)  # single precision fields
    energy = inner @ (coarse_crumple.stiffness.interior @ inner.T)
    np.testing.assert_allclose(np.sqrt(np.diag(energy)) / (2 * np.pi), frequencies, rtol=1e-3)


@pytest.mark.parametrize("name", ["shape.vtu", "shape.npz"])
def test_exported_shapes_come_back_exactly(contents, folder, name):
    back = sheet_from_grid(folder / name, THICKNESS, FOIL.material)
    lift = contents.crumple.points[2, :RING_ROWS].mean()
    expected = contents.crumple.points - np.array([0, 0, lift])[:, None, None]
    np.testing.assert_allclose(back.points, expected, atol=1e-14)


def test_calculix_nodes_lie_on_the_surface_and_the_rings_are_whole(contents, folder):
    deck = meshio.read(folder / "calculix.inp", file_format="abaqus")
    (block,) = deck.cells
    patch = contents.crumple.patch
    assert block.type == "quad8"
    assert len(block.data) == patch.elements_along * patch.elements_around
    grid = surface_grid(contents.crumple.points)
    used = np.ones(grid.shape[:2], dtype=bool)
    used[1::2, 1::2] = False
    np.testing.assert_allclose(deck.points[:-4], grid[used], atol=1e-13)
    for name, row in (("BOTTOM", 0), ("TOP", -1)):
        np.testing.assert_allclose(deck.points[deck.point_sets[name]], grid[row], atol=1e-13)
    corners = deck.points[block.data]
    for middle, (start, end) in zip((4, 5, 6, 7), ((0, 1), (1, 2), (2, 3), (3, 0))):
        away = np.linalg.norm(corners[:, middle] - corners[:, [start, end]].mean(axis=1), axis=1)
        assert away.max() < 0.25 * max(patch.size_around, patch.size_along)


def test_calculix_deck_states_foil_steps_and_what_to_expect(contents, folder):
    text = (folder / "calculix.inp").read_text()
    lines = text.splitlines()
    assert lines[lines.index("*ELASTIC") + 1] == "6.5e+08, 0.4"
    assert lines[lines.index("*DENSITY") + 1] == "2150"
    assert text.count("*STEP") == text.count("*END STEP") == 4
    assert text.count("*STATIC") == 3 and text.count("*FREQUENCY") == 1
    assert text.count("*RIGID BODY") == 2
    assert max(map(len, lines)) < 1320  # the longest line that CalculiX reads
    axial, _ = fixed_stiffness(contents.model.static_stiffness)
    assert f"axial {axial:.6g} N/m" in text


# --- superelements -------------------------------------------------------------------------------


def read_matrix(lines):
    """A symmetric matrix from its triangle, and the (node, freedom) of its rows in their order."""
    rows = [[field.strip() for field in line.split(",")] for line in lines]
    assert all(len(row[4]) <= 20 for row in rows)
    pairs = [((int(r[0]), int(r[1])), (int(r[2]), int(r[3])), float(r[4])) for r in rows]
    places = sorted({place for i, j, _ in pairs for place in (i, j)})
    at = {place: k for k, place in enumerate(places)}
    matrix = np.zeros((len(places), len(places)))
    for i, j, value in pairs:
        assert matrix[at[i], at[j]] == 0  # each entry once
        matrix[at[i], at[j]] = matrix[at[j], at[i]] = value
    return matrix, places


def read_abaqus(path):
    """Matrices of a deck by their names, and which the assembly takes for what."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("**")]
    found = {}
    for block in "\n".join(lines).split("*MATRIX INPUT, NAME=")[1:]:
        head, *rest = block.splitlines()
        data = [line for line in rest if not line.startswith("*")]
        found[head.removesuffix(", TYPE=SYMMETRIC")] = read_matrix(data)
    (assembly,) = (line for line in lines if line.startswith("*MATRIX ASSEMBLE"))
    return {role: found[name] for role, name in re.findall(r", ([A-Z ]+)=(\w+)", assembly)}


def test_the_abaqus_superelement_is_the_reduced_model(contents, folder):
    found = read_abaqus(folder / "superelement_abaqus.inp")
    (k, places), (m, _), (c, _) = (found[r] for r in ("STIFFNESS", "MASS", "VISCOUS DAMPING"))
    assert places[:INTERFACE] == [(node, 1 + d) for node in (9001, 9002) for d in range(6)]
    np.testing.assert_allclose(k, contents.model.stiffness, rtol=1e-13, atol=1e-98)
    assert_same_stiffness(
        second_order_stiffness(k, m, c, contents.frequencies), contents.dynamic_stiffness
    )


def read_calculix(path):
    """K, M and C of a deck of masses, springs, dashpots and equations, and the places of its rows.

    Every coordinate that an equation begins with is taken out by it.
    """
    kind, options, held, equation, numbers = "", {}, set(), [], []
    elements, values, equations = {}, {}, []
    for line in path.read_text().splitlines():
        if line.startswith("**"):
            continue
        if line.startswith("*"):
            kind, *rest = line.split(", ")
            options = dict(each.split("=") for each in rest)
            equation, numbers = [], []
            continue
        assert len(line) < 1320 and all(len(field.strip()) <= 20 for field in line.split(","))
        fields = [field.strip() for field in line.split(",") if field.strip()]
        if kind == "*ELEMENT":
            elements.setdefault(options["ELSET"], []).append((options["TYPE"], *map(int, fields)))
        elif kind in ("*MASS", "*SPRING", "*DASHPOT"):
            values.setdefault(options["ELSET"], []).extend(map(float, fields))
        elif kind == "*BOUNDARY":
            node, first, last = map(int, fields)
            held |= {(node, axis) for axis in range(first, last + 1)}
        elif kind == "*EQUATION":
            if not numbers:
                numbers = [int(fields[0])]
                continue
            equation += [(int(n), int(a), float(v)) for n, a, v in zip(*[iter(fields)] * 3)]
            if len(equation) == numbers[0]:
                equations.append(equation)
                numbers = []
    found = {"MASS": {}, "SPRING1": {}, "DASHPOTA": {}}
    for name, members in elements.items():
        for kind, _, node, *other in members:
            axes = {"MASS": (1, 2, 3), "SPRING1": (int(values[name][0]),)}.get(kind)
            axes = axes or (other[0] - 9004,)
            for axis in axes:
                found[kind][node, axis] = values[name][-1]
    rings = [(node, axis) for node in (9001, 9003, 9002, 9004) for axis in (1, 2, 3)]
    led = {tuple(each[0][:2]): each for each in equations}
    inner = sorted(found["MASS"].keys() - held - led.keys())
    places = rings + inner
    coordinates = inner + list(led)
    follow = np.zeros((len(coordinates), len(places)))
    for row, coordinate in enumerate(coordinates):
        if coordinate not in led:
            follow[row, places.index(coordinate)] = 1
            continue
        (_, _, own), *terms = led[coordinate]
        for node, axis, value in terms:
            follow[row, places.index((node, axis))] -= value / own
    return (
        follow.T
        @ (np.array([found[kind].get(each, 0.0) for each in coordinates])[:, None] * follow)
        for kind in ("SPRING1", "MASS", "DASHPOTA")
    )


def test_the_calculix_superelement_is_the_reduced_model(contents, folder):
    k, m, c = read_calculix(folder / "superelement.inp")
    assert_same_stiffness(
        second_order_stiffness(k, m, c, contents.frequencies), contents.dynamic_stiffness
    )


CCX = shutil.which("ccx")
NODES = (9001, 9003, 9002, 9004)
FREEDOMS = [(node, axis) for node in NODES for axis in (1, 2, 3)]


def ccx(folder, *lines):
    """What CalculiX prints of a model with the superelement in it."""
    (folder / "model.inp").write_text(
        "\n".join(
            [
                "*INCLUDE, INPUT=superelement.inp",
                f"*NSET, NSET=RINGS\n{', '.join(map(str, NODES))}",
                *lines,
            ]
        )
    )
    done = subprocess.run([CCX, "model"], cwd=folder, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and "*ERROR" not in done.stdout, done.stdout
    return (folder / "model.dat").read_text()


def displacements(printed):
    """Of the nodes of the rings, shape (times printed, 12)."""
    rows = re.findall(r"^ +(9\d{3})((?: +[-\d.E+]+){3})$", printed, re.MULTILINE)
    by_node = {node: [] for node in NODES}
    for node, values in rows:
        by_node[int(node)].append(list(map(float, values.split())))
    return np.hstack([np.array(by_node[node]) for node in NODES])


@pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not here")
def test_calculix_finds_the_static_stiffness_of_all_ring_motions(contents, folder):
    """Rings on springs, loaded one motion after the other: to the seven digits that it prints."""
    expected = contents.model.static_stiffness
    springs = np.abs(np.diag(expected))
    lines = []
    for k, (node, axis) in enumerate(FREEDOMS):
        lines += [f"*ELEMENT, TYPE=SPRING1, ELSET=S{k}", f"{k + 1}, {node}"]
        lines += [f"*SPRING, ELSET=S{k}", f"{axis}", f"{springs[k]:.13e}"]
    for (node, axis), load in zip(FREEDOMS, springs):
        lines += ["*STEP", "*STATIC", "*CLOAD, OP=NEW", f"{node}, {axis}, {load:.13e}"]
        lines += ["*NODE PRINT, NSET=RINGS", "U", "*END STEP"]
    compliance = displacements(ccx(folder, *lines)).T / springs
    found = np.linalg.inv(compliance) - np.diag(springs)
    assert np.abs((found - expected) / np.sqrt(np.outer(springs, springs))).max() < 2e-6


@pytest.mark.skipif(CCX is None, reason="CalculiX (ccx) is not here")
def test_calculix_finds_the_eigenfrequencies_and_the_driven_vibration(contents, folder):
    held = ["*BOUNDARY", "9001, 1, 3", "9003, 1, 3"]
    step = ["*STEP", "*FREQUENCY", "6", "*END STEP"]
    printed = ccx(folder, *held, "9002, 1, 3", "9004, 1, 3", *step)
    modes = re.findall(r"^ +\d+ +([\d.E+]+) +[\d.E+]+ +[\d.E+]+ +0\.0+E\+00$", printed, re.M)
    found = np.sqrt(np.array(modes, float)) / (2 * np.pi)
    np.testing.assert_allclose(found, contents.eigenfrequencies[:6], rtol=1e-6)

    count, low, high = 12, 20.0, 100.0  # of the modes that it adds up, and the ends of the band
    steps = ["*STEP", "*FREQUENCY, STORAGE=YES", f"{count}", "*END STEP"]
    steps += ["*STEP", "*STEADY STATE DYNAMICS", f"{low}, {high}, 2"]
    steps += ["*CLOAD", "9002, 3, 1.", "*NODE FILE", "U", "*NODE PRINT, NSET=RINGS", "U"]
    found = displacements(ccx(folder, *held, *steps, "*END STEP"))[[0, 1, -2, -1], 6:]
    model = contents.model
    free = slice(INTERFACE // 2, None)
    k, m, c = (
        each[free, free]
        for each in (model.stiffness, model.mass, damping_matrix(model, contents.damping))
    )
    _, vectors = eigh(k, m, subset_by_index=(0, count - 1))
    for hz, real, imaginary in ((low, *found[:2]), (high, *found[2:])):
        omega = 2 * np.pi * hz
        dynamic = vectors.T @ (k - omega**2 * m + 1j * omega * c) @ vectors
        expected = (vectors @ np.linalg.solve(dynamic, vectors[2]))[:6]
        assert np.abs(real + 1j * imaginary - expected).max() < 2e-5 * np.abs(expected).max()


# --- refusals, realisations, the command line and the study --------------------------------------


def test_unknown_format_is_refused_naming_the_known_ones(contents, tmp_path):
    with pytest.raises(ValueError, match=r"'stl' is not a known export format; use one of nc, mat"):
        write(contents, "stl", tmp_path / "shape.stl")
    assert list(tmp_path.iterdir()) == []


def test_every_format_of_the_registry_can_be_configured():
    choices = Export.model_json_schema()["properties"]["formats"]["items"]["enum"]
    assert choices == list(FORMATS)


STUDY = {
    "study": {"name": "exported"},
    "sweep": {"thickness_um": [500], "reference_height_mm": [170], "realisations": 1},
    "mesh": {"element_size_mm": 10},
    "dynamics": {"shown_max_hz": 100, "frequencies": 5, "eigenfrequencies": 3, "mode_shapes": 2},
}


@pytest.fixture
def realisation(coarse_crumple, tmp_path):
    """A finished realisation: its folder, task, and a way to change its status."""
    study = load_config(STUDY)
    (cell,) = study.cells()
    folder = tmp_path / "realisations" / cell.thickness_id / cell.overlength_id / str(cell.seed)
    task = study.crumple_task(cell)
    values = {
        "control_points": coarse_crumple.points,
        "reference_control_points": coarse_crumple.sheet.reference,
        "equilibrium_residual": coarse_crumple.result.residual,
        **dict.fromkeys(("negative_eigenvalues", "steps", "newton_steps", "hessians"), 0.0),
    }

    def record(status, message="as it should be"):
        attributes = described(foil_of(task), recipe_of(task))
        attributes |= {"status": status, "message": message}
        write_record(folder / "crumple.nc", quantities(values), attributes, crumple_origin(task))
        respond()

    def respond(**dynamics):
        """A response with other dynamics than the study's."""
        task = response.model_copy(
            update={"dynamics": response.dynamics.model_copy(update=dynamics)}
        )
        origin = response_origin(task, read_attributes(folder / "crumple.nc"))
        write_record(folder / "response.nc", {}, {}, origin)

    response = study.response_task(cell)
    record("converged")
    return SimpleNamespace(folder=folder, task=response, record=record, respond=respond)


def test_realisation_leaves_the_formats_and_what_they_are(realisation):
    out = realisation.folder / "export"
    export_realisation(realisation.task, realisation.folder / "crumple.nc", out, "csv", "npz")
    names = sorted(path.name for path in out.iterdir())
    assert names == ["README.txt", "frequency_response.csv", "manifest.json", "shape.npz"]
    readme = (out / "README.txt").read_text()
    assert all(FORMATS.choices[name].words in readme for name in ("csv", "npz"))


def test_realisation_without_equilibrium_leaves_its_reason_alone(realisation):
    realisation.record("not_converged", "residual 1e-3")
    out = realisation.folder / "export"
    export_realisation(realisation.task, realisation.folder / "crumple.nc", out, *FORMATS)
    assert {path.name for path in out.iterdir()} == {"README.txt", "manifest.json"}
    assert "not_converged (residual 1e-3)" in (out / "README.txt").read_text()
    with pytest.raises(ValueError, match="only an equilibrium is exported"):
        contents_of(realisation.task, realisation.folder / "crumple.nc")


def test_format_that_cannot_hold_the_damping_leaves_the_others(realisation):
    dynamics = realisation.task.dynamics.model_copy(update={"damping": "structural"})
    task = realisation.task.model_copy(update={"dynamics": dynamics})
    out = realisation.folder / "export"
    export_realisation(task, realisation.folder / "crumple.nc", out, "mat", "csv")
    assert {p.name for p in out.iterdir()} == {
        "README.txt", "frequency_response.csv", "manifest.json",
    }  # fmt: skip
    assert "reduced.mat: not written" in (out / "README.txt").read_text()


def test_command_line_writes_one_format_to_a_file(realisation, tmp_path):
    target = tmp_path / "mine.csv"
    main(["export", str(realisation.folder), "--format=csv", f"--output={target}"])
    assert target.read_text().startswith("frequency (Hz),transfer axial real (N/m)")


def test_command_line_writes_every_format_and_the_shape_comes_back(realisation, capsys):
    main(["export", str(realisation.folder), "--format=all"])
    paths = [realisation.folder / "exported" / kind.filename for kind in FORMATS.choices.values()]
    assert capsys.readouterr().out.splitlines() == [f"wrote {path}" for path in paths]
    record = contents_of(realisation.task, realisation.folder / "crumple.nc").crumple
    shape = dict(zip(FORMATS, paths))["npz"]
    back = sheet_from_grid(shape, THICKNESS, FOIL.material)
    lift = record.points[2, :RING_ROWS].mean()
    expected = record.points - np.array([0, 0, lift])[:, None, None]
    np.testing.assert_allclose(back.points, expected, atol=1e-14)


def test_command_line_writes_what_it_can_and_says_what_it_could_not(realisation, capsys):
    """Structural damping has no matrix C: no reduced model, all else."""
    realisation.respond(damping="structural")
    main(["export", str(realisation.folder), "--format=all"])
    out, err = capsys.readouterr()
    folder = realisation.folder / "exported"
    refused = ["reduced.mat", "reduced.nc", "superelement.inp", "superelement_abaqus.inp"]
    names = {kind.filename for kind in FORMATS.choices.values()} - set(refused)
    assert {path.name for path in folder.iterdir()} == names
    assert sorted(out.splitlines()) == sorted(f"wrote {folder / name}" for name in names)
    lines = sorted(err.splitlines())
    assert len(lines) == len(refused)
    for line, name in zip(lines, refused):
        assert line.startswith(f"{folder / name}: not written: StructuralDamping")


def test_shapes_are_written_where_no_model_is_valid(realisation, capsys, monkeypatch):
    """Without a reduced model only the points alone can be; and the reduction is tried once."""
    realisation.respond(reduction="guyan", shown_min_hz=90.0)
    tries, reduced = [], DynamicsOptions.reduced
    monkeypatch.setattr(
        DynamicsOptions, "reduced", lambda *given: tries.append(given) or reduced(*given)
    )
    main(["export", str(realisation.folder), "--format=all"])
    out, err = capsys.readouterr()
    assert out == f"wrote {realisation.folder / 'exported' / 'shape.npz'}\n"
    assert len(err.splitlines()) == len(FORMATS) - 1 and len(tries) == 1
    assert all("not written: the guyan model is wrong by" in line for line in err.splitlines())


def test_command_line_fails_only_if_nothing_was_written(realisation, monkeypatch, capsys):
    """A reason for each format, even for a fault of a writer; and no traceback."""

    def fail(*_):
        raise TypeError("no such writer")

    monkeypatch.setattr("foilstudy.export.write.write", fail)
    with pytest.raises(SystemExit) as end:
        main(["export", str(realisation.folder), "--format=all"])
    lines = end.value.code.splitlines()
    assert len(lines) == len(FORMATS)
    assert all("not written: TypeError: no such writer" in line for line in lines)
    assert capsys.readouterr().out == ""
    file = realisation.folder / "response.nc"
    with pytest.raises(SystemExit, match="is a file, and all formats need a folder"):
        main(["export", str(realisation.folder), "--format=all", f"--output={file}"])


def test_command_line_refuses_in_one_sentence(realisation):
    """`SystemExit` with a text prints it and ends with code 1."""
    with pytest.raises(SystemExit) as unknown:
        main(["export", str(realisation.folder), "--format=stl"])
    known = ", ".join(FORMATS)
    assert unknown.value.code == f"'stl' is not a known export format; use one of {known}."
    realisation.record("diverged", "step 12")
    with pytest.raises(SystemExit, match=r"its status is diverged \(step 12\)"):
        main(["export", str(realisation.folder), "--format=csv"])
    (realisation.folder / "response.nc").unlink()
    with pytest.raises(SystemExit, match=r"^\S+response.nc: cannot be read .*No such file"):
        main(["export", str(realisation.folder), "--format=csv"])


def test_study_exports_every_realisation_if_formats_are_given(tmp_path):
    jobs = plan(tmp_path, changed(export={"formats": ["mat", "vtu"]}))
    assert jobs["export"] == jobs["crumple"] == 8
