"""Writer, solver and reader together: patch tests and Hertz contact."""

from dataclasses import replace

import numpy as np
import pytest
from blocks_in_contact import block, graded_lengths, press

from meshwright.fe.blocks import Block
from meshwright.fe.deck import Deck, Part, Support, write
from meshwright.fe.hertz import elliptic_contact, line_contact
from meshwright.fe.hexahedra import CORNERS, FACES, HexMesh
from meshwright.fe.material import Material, contact_modulus, von_mises
from meshwright.fe.results import read_dat, read_frd
from meshwright.fe.solver import run_ccx

STEEL = Material(205000.0, 0.29)
MODULUS = contact_modulus(STEEL, STEEL)

# R. H. MacNeal and R. L. Harder, A proposed standard set of problems to test finite element accuracy (1985), patch
# test for solids: inner nodes, displacements 1e-3 (2x+y+z, x+2y+z, x+y+2z)/2, E = 1e6, nu = 0.25.
PATCH_INNER = np.array(
    [
        [0.249, 0.342, 0.192],
        [0.826, 0.288, 0.288],
        [0.850, 0.649, 0.263],
        [0.273, 0.750, 0.230],
        [0.320, 0.186, 0.643],
        [0.677, 0.305, 0.683],
        [0.788, 0.693, 0.644],
        [0.165, 0.745, 0.702],
    ]
)
PATCH_STRESS = np.array([2000.0, 2000.0, 2000.0, 400.0, 400.0, 400.0])


def macneal_harder_patch():
    inner = list(range(8))
    around = [[8 + n for n in face[::-1]] + [int(n) for n in face[::-1]] for face in FACES]
    return HexMesh(np.concatenate([PATCH_INNER, (CORNERS + 1) / 2]), np.array([inner, *around])), np.arange(8, 16)


def skewed_grid():
    """Parallelepipeds of unequal sizes."""
    ticks = np.array([0.0, 0.2, 0.7, 1.0])
    points = np.stack(np.meshgrid(ticks, ticks**2, ticks, indexing="ij"), axis=-1)
    shear = np.array([[1, 0.4, 0.1], [0, 1, 0.3], [0, 0, 1.0]])
    surface = np.any((points <= 0.0) | (points >= 1.0), axis=-1).ravel()
    return Block(points @ shear.T).mesh(), np.flatnonzero(surface)


def linear_field(points):
    return 0.5e-3 * (points + points.sum(axis=1, keepdims=True))


def solve_patch(ccx, folder, mesh, boundary, element_type):
    """(integration point stresses, nodal stresses, nodal displacements) under the linear boundary displacements."""
    values = linear_field(mesh.nodes[boundary])
    supports = tuple(Support("CUBE", boundary, axis + 1, values[:, axis]) for axis in range(3))
    deck = Deck("patch test", (Part("CUBE", mesh, Material(1e6, 0.25)),), supports, element_type=element_type)
    input_file = folder / "patch.inp"
    input_file.write_text(write(deck))
    assert run_ccx(ccx, input_file, 60.0).finished
    fields = read_frd(input_file.with_suffix(".frd"))
    everywhere = np.arange(1, len(mesh.nodes) + 1)
    table = read_dat(input_file.with_suffix(".dat"))["stresses", "E_CUBE"]
    return table.values, fields["STRESS"].at(everywhere), fields["DISP"].at(everywhere)


@pytest.mark.parametrize(("patch", "element"), [(skewed_grid, "C3D8I"), (macneal_harder_patch, "C3D8")])
def test_patch(ccx, tmp_path, patch, element):
    """A linear displacement field is reproduced to the digits the solver prints.

    CalculiX's C3D8I does so for parallelepipeds only; the standard patch of irregular hexahedra needs C3D8.
    """
    mesh, boundary = patch()
    points, nodes, displacements = solve_patch(ccx, tmp_path, mesh, boundary, element)
    assert np.abs(points - PATCH_STRESS).max() < 2e-3
    assert np.abs(nodes / PATCH_STRESS - 1.0).max() < 1e-4  # the solver extrapolates with coefficients of five digits
    assert np.abs(displacements - linear_field(mesh.nodes)).max() < 1e-9


def wavy_grid(count):
    """A smoothly curved grid of ``count`` elements a side."""
    ticks = np.linspace(0.0, 1.0, count + 1)
    x, y, z = np.meshgrid(ticks, ticks, ticks, indexing="ij")
    bump = 0.15 * np.sin(np.pi * x) * np.sin(np.pi * y) * np.sin(np.pi * z)
    points = np.stack([x + bump, y + bump, z + bump], axis=-1)
    return Block(points).mesh(), np.flatnonzero((bump < 1e-12).ravel())


def test_incompatible_modes_pass_the_patch_test_in_the_limit(ccx, tmp_path):
    """On a smooth mesh of curved hexahedra the stress error of C3D8I falls in proportion to the element size."""
    errors = []
    for count in (6, 12):
        points, _, _ = solve_patch(ccx, tmp_path, *wavy_grid(count), "C3D8I")
        errors.append(np.sqrt(np.mean((points - PATCH_STRESS) ** 2)))
    assert errors[1] < errors[0] / 1.8


def test_contact_patch(ccx, tmp_path):
    """A uniform pressure passes unchanged through non-matching meshes."""
    lower = block(np.linspace(0, 1, 4), np.linspace(0, 1, 3), np.linspace(0, 1, 3), None, upper=False)
    upper = block(np.linspace(0, 1, 6), np.linspace(0, 1, 5), np.linspace(0, 1, 3), lambda x, y: 0 * x, upper=True)
    free = Material(205000.0, 0.0)
    pressed = press(ccx, tmp_path, lower, upper, free, 100.0, 1e-4)
    assert pressed.force == pytest.approx(100.0, rel=1e-4)
    assert pressed.pressures == pytest.approx(np.full(pressed.pressures.size, 100.0), rel=1e-3)


def test_hertz_cylinder(ccx, tmp_path):
    force, curvature = 200.0, 0.1
    exact = line_contact(force, curvature, MODULUS, 0.29)
    plane, depth = graded_lengths(exact.semi_minor, 5.0, 40 * exact.semi_minor, layers=5)
    slice_width = 0.25 * exact.semi_minor
    width = np.array([0.0, slice_width])
    lower = block(plane, width, depth, None, upper=False)
    upper = block(plane, width, depth, lambda x, y: 0.5 * curvature * x**2, upper=True)
    pressed = press(ccx, tmp_path, lower, upper, STEEL, force * slice_width, 1e-4, plane_strain=True)
    assert pressed.force == pytest.approx(force * slice_width, rel=1e-4)
    assert pressed.peak_pressure == pytest.approx(exact.peak_pressure, rel=0.03)
    for stress in pressed.stresses:
        assert von_mises(stress).max() == pytest.approx(exact.subsurface_von_mises, rel=0.05)


@pytest.mark.validate
def test_hertz_sphere(ccx, tmp_path):
    force, curvature = 1000.0, 0.05
    exact = elliptic_contact(force, curvature, curvature, MODULUS, 0.29)
    plane, depth = graded_lengths(exact.semi_minor, 3.0, 15 * exact.semi_minor)
    lower = block(plane, plane, depth, None, upper=False)
    upper = block(plane, plane, depth, lambda x, y: 0.5 * curvature * (x**2 + y**2), upper=True)
    pressed = press(ccx, tmp_path, lower, upper, STEEL, force, 0.5 * exact.approach)
    assert pressed.force == pytest.approx(force, rel=1e-4)
    assert pressed.peak_pressure == pytest.approx(exact.peak_pressure, rel=0.03)
    for stress in pressed.stresses:
        assert von_mises(stress).max() == pytest.approx(exact.subsurface_von_mises, rel=0.05)


def test_reals_are_written_as_reals(tmp_path):
    """CalculiX reads a real without a decimal point as something else, and at most 20 characters of it."""
    mesh, boundary = skewed_grid()
    support = Support("CUBE", boundary, 1, np.full(len(boundary), -1.0 / 3.0))
    text = write(Deck("", (Part("CUBE", replace(mesh, nodes=-mesh.nodes * 1e-17), STEEL),), (support,)))
    coordinates = [line.split(", ")[1:] for line in text.split("*ELEMENT")[0].splitlines() if line[:1].isdigit()]
    values = [value for row in coordinates for value in row]
    assert all("." in value and "e" in value and len(value) <= 20 for value in values)
