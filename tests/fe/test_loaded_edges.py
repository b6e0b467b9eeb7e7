"""Edges under load: gears so far out of line that the ends of their faces touch before any tangency."""

import json
from dataclasses import replace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands import loading
from meshwright.contact.results import ARCSEC
from meshwright.cycle.pairs import Mesh
from meshwright.fe import loaded
from meshwright.fe.blocks import Block
from meshwright.fe.cells import positive
from meshwright.fe.compliance import ToothCompliance, without_negative
from meshwright.fe.elastic import flexibility
from meshwright.fe.free_edges import free_edge_displacements
from meshwright.fe.halfspace import between_cells, image_factor, mean_displacement, symmetric
from meshwright.fe.hexahedra import nodal_areas
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.material import Material
from meshwright.fe.model import Load
from meshwright.fe.pair import first_touches
from meshwright.fe.solids import gear_pair
from tests.fe.flat_grid import flat_grid
from tests.independent.first_touch import FirstTouch
from tests.quick import quick

OUT_OF_LINE = {"horizontal_deg": 0.08}


@pytest.fixture(scope="module")
def drive():
    return Drive.load("helical-crowned").with_(misalignment=OUT_OF_LINE)


@pytest.fixture(scope="module")
def gear(drive):
    return gear_pair(drive)


def _load(newton_metres):
    return Load(1000.0 * newton_metres, "pinion")


def _moment(gear, found):
    """Moment of all pressures about the pinion's axis, N mm."""
    origin, axis = gear.pinion.axis
    return sum(
        float((pair.grid.area * pair.pressures) @ (np.cross(pair.grid.points - origin, pair.grid.frame[:, 2]) @ axis))
        for pair in found.pairs
    )


@pytest.mark.parametrize("pitches", quick([0.0, 0.3, 0.7], 0.3))
def test_the_limit_without_load_is_the_error_of_rigid_teeth(drive, gear, pitches):
    """Over all pairs, edges included; within 1e-6 arcsec, and a load that tends to nothing leads there."""
    angle = pitches * gear.pinion.pitch
    (rigid,) = Mesh.of(drive).rigid.transmitted([angle])
    found = [loaded_contact(gear, angle, 3, _load(t), None) for t in (1e-2, 1e-5, 1e-9)]
    assert [f.unloaded_error / ARCSEC for f in found] == pytest.approx([rigid / ARCSEC] * 3, abs=1e-6)
    lags = [(f.unloaded_error - f.transmission_error) / ARCSEC for f in found]
    assert lags[0] > 10.0 * lags[1] > 100.0 * lags[2] > 0.0
    assert lags[2] < 1e-4


@pytest.mark.validate
def test_the_limit_without_load_is_that_of_a_brute_force_search(drive, gear):
    """The first touch of the bounded flanks of every pair by turning the wheel, without an equation of contact."""
    angle, mesh = 0.3 * gear.pinion.pitch, Mesh.of(drive)
    side = mesh.sense
    found = []
    for number in (-1, 0, 1):
        own = angle - number * gear.pinion.pitch
        known = mesh.window.path.unknowns[np.argmin(np.abs(mesh.window.path.angles - own))]
        wheel = drive.region("wheel").flank
        grid = drive.surface("wheel", (9, 9))
        values = grid.values[np.isfinite(grid.points).reshape(-1, 3).all(axis=1)]
        room = 0.05 * np.ptp(values, axis=0)
        assert len(wheel.parameters) == 2
        search = FirstTouch(drive, own, known, side)
        found.append(search.highest(np.stack([values.min(axis=0) - room, values.max(axis=0) + room])))
    rigid = side * max(side * error for error in found)
    at = loaded_contact(gear, angle, 3, _load(1.0), None)
    assert at.unloaded_error / ARCSEC == pytest.approx(rigid / ARCSEC, abs=1e-6)


@pytest.mark.parametrize("newton_metres", [0.1, 60.0])
def test_the_pressures_of_edges_and_tangencies_bear_the_torque(gear, newton_metres):
    found = loaded_contact(gear, 0.0, 3, _load(newton_metres), None)
    assert abs(_moment(gear, found)) == pytest.approx(1000.0 * newton_metres, rel=1e-9)
    for pair in found.pairs:
        assert (pair.pressures >= 0.0).all()


def test_an_edge_that_leads_carries_a_small_load_alone_and_shares_a_large_one(gear):
    """And the neighbour's edge, some µm away, comes in when the teeth have given way by as much."""
    small, large = (loaded_contact(gear, 0.3 * gear.pinion.pitch, 3, _load(t), None) for t in (0.1, 200.0))
    edge = next(pair for pair in small.pairs if pair.contact.touch.edge)
    assert edge.contact.touch.edge == "edge of the wheel (left face)" and edge.apart == 0.0 and edge.hertz is None
    assert edge.force == sum(pair.force for pair in small.pairs) > 0.0
    carrying = [pair for pair in large.pairs if pair.force > 0.0]
    assert len(carrying) > 1 and any(not pair.contact.touch.edge for pair in carrying)
    lead = next(pair for pair in large.pairs if pair.contact == edge.contact)
    assert lead.force < 0.95 * sum(pair.force for pair in large.pairs)


def test_a_rising_torque_moves_the_load_from_the_edge_to_the_tangency(gear):
    """The centre of pressure of the pair leaves the end of its face, along the flank, with every step of the torque."""
    angle = 0.3 * gear.pinion.pitch
    (edge,) = [c for c in first_touches(gear, angle, 1) if c.pairs_later == 0]
    away = []
    for newton_metres in (0.1, 1.0, 10.0, 60.0):
        found = loaded_contact(gear, angle, 1, _load(newton_metres), None)
        pair = next(pair for pair in found.pairs if pair.contact.pairs_later == 0)
        centre = pair.pressures @ pair.grid.points / pair.pressures.sum()
        away.append(float(np.linalg.norm(centre - edge.touch.point)))
    assert away[0] > 0.0 and (np.diff(away) > 0.0).all() and away[-1] > 5.0 * away[0]


def test_a_gap_that_the_load_does_not_close_carries_nothing(gear):
    found = loaded_contact(gear, 0.0, 3, _load(0.1), None)
    assert {pair.contact.pairs_later for pair in found.pairs if pair.force > 0.0} == {0}


@pytest.mark.validate
def test_forces_and_error_do_not_depend_on_the_cells(gear, monkeypatch):
    """Half as many again along and across: force on the edge within 2 %, the wheel's lag within 1 %."""
    usual = loaded_contact(gear, 0.0, 3, _load(60.0), None)
    monkeypatch.setattr(loaded, "_CELLS", ((31, 21), (45, 31)))
    finer = loaded_contact(gear, 0.0, 3, _load(60.0), None)
    forces = [{pair.contact.pairs_later: pair.force for pair in f.pairs} for f in (usual, finer)]
    assert forces[0][-1] > 0.0
    assert forces[0] == pytest.approx(forces[1], rel=0.02, abs=1.0)
    assert usual.rotation == pytest.approx(finer.rotation, rel=0.01)


def test_nothing_is_added_far_from_edges():
    """To cells in the middle of the flank; beside a face each sinks further by its image, most at the face."""
    ticks = np.linspace(-0.2, 0.2, 5)
    centres = np.stack([axis.ravel() for axis in np.meshgrid(ticks, ticks, indexing="ij")], axis=1)

    def grid(face):
        place = np.stack([0.4 + 0.05 * centres[:, 0], face + centres[:, 1] / 240.0], axis=1)
        return flat_grid(centres, (0.05, 0.05), place)

    steel = Material(2.06e5, 0.3)
    far, _ = free_edge_displacements(grid(0.5), "wheel", steel, None)
    added, known = free_edge_displacements(grid(1.0 - 0.25 / 240.0), "wheel", steel, None)
    assert known is None
    assert (added > 0.0).all() and added == pytest.approx(added.T)
    assert np.abs(far).max() < 1e-9 * added.min()
    own = np.diag(added).reshape(5, 5) / 0.1**2
    assert (np.diff(own, axis=1) > 0.0).all()
    factor = image_factor(0.3)
    expected = factor * 4.0 * 0.05**2 / (np.pi * steel.plane_strain_modulus * 2.0 * (0.25 + 0.2))
    assert own[2, 0] == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("size", [0.05, 0.4, 3.0])
@pytest.mark.parametrize("degrees", [0.0, 30.0])
def test_no_load_lifts_what_it_presses(size, degrees):
    """Loads of any kind beside a tip and a face, on cells finer and coarser than the patches of the tooth, do work."""
    shape, half = (6, 8), (0.4, 1.6)
    lengths = 2.0 * np.array(half) * shape
    material = Material(2.06e5, 0.3)
    random = np.random.default_rng(4)
    rough = random.normal(size=(48, 48))
    tooth = ToothCompliance(shape, 1e-7 * (rough + rough.T), (), half)  # no mesh is as bad as that
    turn = np.radians(degrees)
    ticks = size * (np.arange(13) - 6.0)
    centres = np.stack([axis.ravel() for axis in np.meshgrid(ticks, ticks, indexing="ij")], axis=1)
    along = centres @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    place = (along + lengths - 2.0 * size) / lengths
    inside = (np.abs(place - 0.5) < 0.5).all(axis=1)
    place = place[inside]
    grid = flat_grid(centres[inside], (0.5 * size, 0.5 * size), place)
    free, known = free_edge_displacements(grid, "wheel", material, tooth)
    assert np.abs(free - free.T).max() <= 1e-12 * np.abs(free).max() and np.abs(known - known.T).max() < 1e-18
    weights, smooth = tooth.weights(*place.T), without_negative(tooth.own - known)
    half_space = symmetric(between_cells(grid, material.plane_strain_modulus), grid.area)
    whole = positive(half_space, [free]) + size**4 * weights @ smooth @ weights.T
    assert np.linalg.eigvalsh(whole)[0] > 0.0


def _spaced(start, end, first, growth):
    places = [start]
    while places[-1] < end:
        places.append(places[-1] + first)
        first *= growth
    return np.array([*places[:-1], end])


@pytest.mark.validate
@pytest.mark.parametrize("poisson_ratio", [0.29, 0.2])
def test_the_image_makes_a_quarter_space_of_the_half_space(poisson_ratio):
    """Squares of side 1 in a row from the edge of a block and in the middle of a face, by finite elements: what the
    edge adds to their mean displacements is that of images, to 20 % right at the edge and 10 % of the whole.
    """
    material, squares, per = Material(1.0, poisson_ratio), 3, 4
    along = np.concatenate([np.linspace(0, squares, squares * per + 1), _spaced(squares, 40, 0.4, 1.5)[1:]])
    across = np.concatenate([-_spaced(0.5, 40, 0.25, 1.5)[:0:-1], np.linspace(-0.5, 0.5, per + 1)])
    across = np.concatenate([across, _spaced(0.5, 40, 0.25, 1.5)[1:]])
    depth = -_spaced(0.0, 40, 0.125, 1.4)[::-1]

    def sunk(x, sides):
        block = Block(np.stack(np.meshgrid(x, across, depth, indexing="ij"), axis=-1))
        mesh = block.mesh()
        faces = mesh.face_nodes(block.side("k1"))
        middle = mesh.nodes[faces].mean(axis=1)
        rows = [faces[(np.abs(middle[:, 0] - k - 0.5) < 0.5) & (np.abs(middle[:, 1]) < 0.5)] for k in range(squares)]
        loaded_nodes = np.unique(np.concatenate(rows))
        forces = np.zeros((len(loaded_nodes), 3, squares))
        for case, of in enumerate(rows):
            used, areas = nodal_areas(mesh.nodes, of)
            forces[np.searchsorted(loaded_nodes, used), :, case] = -areas / np.linalg.norm(areas.sum(axis=0))
        held = np.unique(np.concatenate([mesh.face_nodes(block.side(s)).ravel() for s in sides]))
        return flexibility(mesh, material, held, len(depth) - 1, loaded_nodes, forces)

    quarter = sunk(along, ("i1", "j0", "j1", "k0"))
    half = sunk(np.concatenate([-_spaced(0.0, 40, 0.25, 1.5)[:0:-1], along]), ("i0", "i1", "j0", "j1", "k0"))
    offsets = np.add.outer(np.arange(squares), np.arange(squares)) + 1.0
    image = mean_displacement(offsets, np.zeros_like(offsets), 0.5, 0.5, material.plane_strain_modulus)
    added = image_factor(poisson_ratio) * image
    assert np.abs(added - (quarter - half)).max() < 0.2 * (quarter - half).max()
    assert np.abs(half + added - quarter).max() < 0.1 * quarter.max()
    assert quarter[0, 0] > 1.5 * half[0, 0]


def test_the_command_names_edges_and_gaps(capsys, monkeypatch):
    monkeypatch.setattr(loading, "compliances", lambda *_: None)
    words = ["loaded", "helical-crowned", "--torque-nm", "60", "--phi-deg=0", "--json", "-"]
    assert main([*words, "--set", "misalignment.horizontal_deg=0.08"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    edge = next(pair for pair in point["pairs"] if pair["pairs_later"] == -1)
    assert (edge["kind"], edge["first_contact"]) == ("edge", "edge of the pinion (left face)")
    assert edge["gap_um"] == pytest.approx(2.74, abs=0.01) and edge["force_n"] > 100.0
    assert edge["hertz_pressure_mpa"] is None
    assert "pair -1 touches first with the edge of the pinion (left face)" in point["message"]
    assert point["unloaded_transmission_error_arcsec"] > point["loaded_transmission_error_arcsec"]
    assert sum(pair["share"] for pair in point["pairs"]) == pytest.approx(1.0)


def test_finite_elements_about_tangencies_refuse_an_edge_that_is_first(capsys, tmp_path):
    words = ["--torque-nm", "60", "--phi-deg=2.6", "--set", "misalignment.horizontal_deg=0.08"]
    assert main(["fe", "helical-crowned", *words, "--folder", str(tmp_path / "fe")]) == 2
    assert "edge of the wheel (left face)" in capsys.readouterr().err


@pytest.mark.parametrize("bend", [0.0, 0.02, 0.1])
def test_images_beside_a_bent_edge_are_those_beside_a_straight_one(bend):
    """Slender cells along an edge that cuts a contact off, bent as a worm's tip is: what matters is how far away it is.

    Cells lie along the parabola of the edge, which is 8 mm long and up to 1.6 mm from a straight one.
    """
    along, away = np.meshgrid(np.linspace(-4.0, 4.0, 41), np.linspace(0.01, 0.39, 20), indexing="ij")
    slope = 2.0 * bend * along.ravel()
    length = np.hypot(1.0, slope)
    centres = np.stack([along.ravel(), bend * along.ravel() ** 2 - away.ravel()], axis=1)
    place = np.stack([1.0 - 0.1 * away.ravel(), np.full(along.size, 0.5)], axis=1)
    ways = np.stack([[np.ones_like(slope), slope], [-slope, np.ones_like(slope)]]).transpose(2, 0, 1)
    grid = replace(
        flat_grid(centres, (0.1, 0.01), place, ((0, 1.0),)),
        rectangle=np.stack([0.1 * length, 0.01 / length], axis=1),
        ways=ways / length[:, None, None],
    )
    added, _ = free_edge_displacements(grid, "wheel", Material(2.06e5, 0.3), None)
    straight = replace(
        flat_grid(np.stack([along.ravel(), -away.ravel()], axis=1), (0.1, 0.01), place, ((0, 1.0),)),
    )
    wanted, _ = free_edge_displacements(straight, "wheel", Material(2.06e5, 0.3), None)
    middle = np.abs(along.ravel()) < 1.0
    assert np.diag(added)[middle] == pytest.approx(np.diag(wanted)[middle], rel=0.05)
