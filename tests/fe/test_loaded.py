"""Semi-analytic loaded contact and its parts against closed forms."""

import json
import math
from dataclasses import replace

import numpy as np
import pytest
from test_solver_chain import linear_field, macneal_harder_patch

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands import loading
from meshwright.fe import cells
from meshwright.fe import pair as pairs
from meshwright.fe.blocks import Block
from meshwright.fe.cells import Cells
from meshwright.fe.compliance import ToothCompliance, spline_weights, tooth_compliance
from meshwright.fe.elastic import assemble, flexibility
from meshwright.fe.gap import ContactPlane
from meshwright.fe.halfspace import between_cells, mean_displacement, rectangle_displacement
from meshwright.fe.hexahedra import nodal_areas
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.material import Material
from meshwright.fe.model import Load
from meshwright.fe.pair import touches
from meshwright.fe.solids import gear_pair
from meshwright.fe.strip import Strip, Window
from tests.fe.flat_grid import flat_grid

TORQUE = Load(100e3, "pinion")
MATES = {"concave": 1054, "spur": 1364, "convex": 1542}


@pytest.fixture(scope="module")
def concave():
    return gear_pair(Drive.load("spherical-table-4-4-concave"))


@pytest.fixture(scope="module")
def compliance(concave):
    return {name: tooth_compliance(getattr(concave, name)) for name in ("pinion", "wheel")}


def test_square_under_uniform_pressure():
    """Centre 8 ln(1 + sqrt 2) a/(pi E'), corner half of it; far away that of a point force."""
    centre = rectangle_displacement(np.array([0.0, 1.0, 300.0]), np.array([0.0, 1.0, 400.0]), 1.0, 1.0, 2.0)
    assert centre[0] == pytest.approx(8 * np.log(1 + np.sqrt(2)) / (2 * np.pi), rel=1e-14)
    assert centre[1] == pytest.approx(centre[0] / 2, rel=1e-14)
    assert centre[2] == pytest.approx(4 / (np.pi * 2 * 500), rel=1e-5)


def test_mean_displacement_of_a_loaded_square():
    """Mean 0.473 side p/E'·2 of a uniformly loaded square (Timoshenko and Goodier, 0.95 p sqrt(A)/E')."""
    mean = mean_displacement(np.zeros(1), np.zeros(1), 0.5, 0.5, 1.0)
    assert mean[0] == pytest.approx(0.95, abs=0.005)


def test_cells_move_one_another_as_rectangles_do():
    """Near by exactly, far away to 2e-4; a plane that is bent about its own line keeps what is far apart there."""
    at = np.array([[0.0, 0.0], [0.4, 0.1], [0.0, -0.3], [0.9, 1.1], [3.0, -4.0]])
    grid = flat_grid(at, (0.1, 0.05), np.full_like(at, 0.5))
    found = between_cells(grid, 1e5)
    apart = at[:, None] - at
    exact = rectangle_displacement(apart[..., 0], apart[..., 1], 0.1, 0.05, 1e5)
    assert found == pytest.approx(exact, rel=2e-4)
    assert found[0, :2] == pytest.approx(exact[0, :2], rel=1e-14)
    folded = replace(grid, points=grid.points + np.array([0.0, 0.0, 5.0]) * (np.arange(5) == 4)[:, None])
    distance = np.hypot(5.0, 5.0)
    assert between_cells(folded, 1e5)[4, 0] == pytest.approx(0.02 / (np.pi * 1e5 * distance), rel=1e-3)


def test_elements_pass_the_patch_test():
    """No inner nodal forces under a linear field on the standard patch of irregular hexahedra."""
    mesh, _ = macneal_harder_patch()
    forces = (assemble(mesh, Material(1e6, 0.25)) @ linear_field(mesh.nodes).ravel()).reshape(-1, 3)
    assert np.abs(forces[:8]).max() < 1e-12 * np.abs(forces).max()


def test_cantilever():
    """Tip deflection of a slender beam, two elements deep: F L^3/3EI with the shear term, within 1 %."""
    length, side, force, steel = 20.0, 1.0, 1.0, Material(2e5, 0.3)
    points = np.stack(
        np.meshgrid(np.linspace(0, length, 41), np.linspace(0, side, 3), np.linspace(0, side, 3), indexing="ij"),
        axis=-1,
    )
    block = Block(points)
    mesh = block.mesh()
    nodes, areas = nodal_areas(mesh.nodes, mesh.face_nodes(block.side("i1")))
    loads = np.zeros((len(nodes), 3, 1))
    loads[:, 1, 0] = force * areas[:, 0] / areas[:, 0].sum()
    held = np.unique(mesh.face_nodes(block.side("i0")))
    deflection = flexibility(mesh, steel, held, 2, nodes, loads)[0, 0] / force
    shear = 1.2 * force * length / (steel.youngs_modulus / 2.6 * side**2)
    assert deflection == pytest.approx(force * length**3 / (3 * steel.youngs_modulus * side**4 / 12) + shear, rel=0.01)


@pytest.mark.parametrize("mate", MATES)
def test_half_spaces_give_hertz(mate):
    """Rigid teeth with elastic half-spaces: Hertz pressure and approach at the pitch point."""
    gear = gear_pair(Drive.load(f"spherical-table-4-4-{mate}"))
    found = loaded_contact(gear, 0.0, 1, TORQUE, None)
    (pair,) = found.pairs
    arm = 66.0 * np.cos(np.radians(20.0))
    assert pair.force == pytest.approx(100e3 / arm, rel=1e-3)
    assert pair.peak_pressure == pytest.approx(MATES[mate], rel=2e-3)
    assert pair.hertz.peak_pressure == pytest.approx(MATES[mate], rel=1e-3)
    assert found.rotation * arm == pytest.approx(pair.hertz.approach, rel=3e-3)


def test_two_pairs_share_the_torque(concave, compliance):
    """Moments add up to the torque; the driven wheel lags; two pairs are stiffer than one."""
    both = loaded_contact(concave, 0.35 * concave.pinion.pitch, 3, TORQUE, compliance)
    one = loaded_contact(concave, 0.0, 3, TORQUE, compliance)
    arm = 66.0 * np.cos(np.radians(20.0))
    assert len(both.pairs) == 2 and len(one.pairs) == 1
    assert sum(pair.force for pair in both.pairs) * arm == pytest.approx(TORQUE.torque, rel=1e-3)
    assert both.mesh_stiffness > 1.3 * one.mesh_stiffness
    assert one.transmission_error == pytest.approx(-concave.ratio * one.rotation, rel=1e-6)


@pytest.mark.validate
def test_every_pitch_is_loaded_like_the_first(concave):
    """Whole pitches later other teeth do the same: forces, and the error of the loaded wheel."""
    pitch = concave.pinion.pitch
    first, *others = (
        loaded_contact(concave, (0.35 + pitches) * pitch, 3, TORQUE, None) for pitches in (0, 1, 2, -7, 100)
    )
    for pitches, found in zip((1, 2, -7, 100), others, strict=True):
        assert [pair.contact.pairs_later - pitches for pair in found.pairs] == [0, 1]
        assert [pair.force for pair in found.pairs] == pytest.approx([pair.force for pair in first.pairs], rel=1e-9)
        assert found.rotation == pytest.approx(first.rotation, rel=1e-9)


def test_loads_do_the_same_work_on_one_anothers_displacements(concave, compliance, monkeypatch):
    """Betti's theorem, of cells of both pairs with edges nearby, and cells that bear one another's loads stably: what
    is factorised pair by pair tells the pressures under which cells move as they do.
    """
    seen = []

    def kept(every, used):
        seen.append((every, used, of(every, used)))
        return seen[-1][-1]

    of = Cells.bearing
    monkeypatch.setattr(Cells, "bearing", kept)
    both = loaded_contact(concave, 0.35 * concave.pinion.pitch, 3, TORQUE, compliance)
    assert sum(pair.force > 0.0 for pair in both.pairs) == 2
    for every, used, bearing in seen[-1:]:
        areas = np.concatenate([pair.areas for pair in every.pairs])
        moved = [every.under(unit)[used] for unit in np.eye(sum(every.sizes))[used]]
        work = areas[used, None] * np.column_stack(moved)
        assert (np.abs(work - work.T) <= np.maximum(1e-9 * np.abs(work.T), 1e-12 * work.max())).all()
        assert np.linalg.eigvalsh(work)[0] > 0.0
        pressures = np.random.default_rng(5).normal(size=(len(work), 2))
        assert bearing.pressures(work @ pressures) == pytest.approx(pressures, abs=1e-8)


def test_few_ways_span_what_close_places_weigh():
    """Splines are parabolas in a patch: within one, three ways along and three across tell all of their patches apart;
    no place tells any.
    """
    tooth = ToothCompliance((6, 20), np.zeros((120, 120)), (), (1.0, 1.0))
    profile, face = np.random.default_rng(6).uniform([[3.0 / 6.0], [7.0 / 20.0]], [[4.0 / 6.0], [8.0 / 20.0]], (2, 50))
    ways, weights = tooth.span(profile, face), tooth.weights(profile, face)
    assert ways.shape == (120, 9)
    assert ways.T @ ways == pytest.approx(np.eye(9), abs=1e-12)
    assert weights @ ways @ ways.T == pytest.approx(weights, abs=1e-11)
    assert tooth.span(np.empty(0), np.empty(0)).shape == (120, 0)


def test_teeth_are_softer_than_half_spaces(concave, compliance):
    """And bend most below the middle of the load: the peak is lower than Hertz's, by less than 1 %."""
    with_teeth = loaded_contact(concave, 0.0, 1, TORQUE, compliance)
    without = loaded_contact(concave, 0.0, 1, TORQUE, None)
    assert with_teeth.rotation > 1.1 * without.rotation
    assert 0.99 < with_teeth.pairs[0].peak_pressure / without.pairs[0].peak_pressure < 1.0


def test_torque_on_either_member(concave):
    """Equal moments on either axis give the same pressure, and rotations in the ratio of the teeth."""
    on_pinion = loaded_contact(concave, 0.0, 1, Load(100e3, "pinion"), None)
    on_wheel = loaded_contact(concave, 0.0, 1, Load(100e3 * 47 / 33, "wheel"), None)
    assert on_wheel.pairs[0].peak_pressure == pytest.approx(on_pinion.pairs[0].peak_pressure, rel=1e-4)
    assert on_wheel.transmission_error == pytest.approx(on_pinion.transmission_error, rel=1e-3)


def test_command(capsys, monkeypatch):
    """At 40 degrees the teeth are taken to be broken out."""
    there, broken = pairs.first_touches, math.radians(40)
    monkeypatch.setattr(pairs, "first_touches", lambda g, angle, n: there(g, angle, n) if angle < broken else ())
    status = main(["loaded", "spherical-table-4-4-concave", "--torque-nm", "100", "--phi-deg=0,3,40", "--json", "-"])
    document = json.loads(capsys.readouterr().out)
    assert status == 1
    assert document["schema"] == "meshwright.loaded/1"
    single, double, none = document["points"]
    assert set(single) >= {"pinion_angle_deg", "loaded_transmission_error_arcsec", "mesh_stiffness_n_per_um", "pairs"}
    assert [pair["share"] for pair in single["pairs"]] == [1.0]
    assert sum(pair["share"] for pair in double["pairs"]) == pytest.approx(1.0)
    assert none["status"] == "no_contact" and none["pairs"] == [] and none["loaded_transmission_error_arcsec"] is None


@pytest.mark.validate
def test_tooth_compliance_is_that_of_finer_meshes(concave):
    """Extrapolated from the usual meshes and from half as fine again: 3 % of the largest entry at most between them.

    Under load they tell the same peak of pressure to 0.2 %, and the same rotation to 1 %.
    """
    usual, finer = (
        {name: tooth_compliance(getattr(concave, name), 0, per_patch) for name in ("pinion", "wheel")}
        for per_patch in (1, 2)
    )
    assert np.abs(usual["pinion"].own - finer["pinion"].own).max() < 0.03 * np.abs(finer["pinion"].own).max()
    one, other = (loaded_contact(concave, 0.0, 1, TORQUE, teeth) for teeth in (usual, finer))
    assert one.pairs[0].peak_pressure == pytest.approx(other.pairs[0].peak_pressure, rel=2e-3)
    assert one.rotation == pytest.approx(other.rotation, rel=1e-2)


def test_compliance_from_the_means_of_patches():
    """A bell of two patches, narrow as that of a thread, is had again from its means: 1 % anywhere but at the edges."""
    count, width = 12, 2.0
    gauss, weights = np.polynomial.legendre.leggauss(8)

    def bell(seen, pressed):
        return np.exp(-0.5 * ((seen[:, None] - pressed) * count / width) ** 2)

    places = ((np.arange(count)[:, None] + 0.5 * (1.0 + gauss)) / count).ravel()
    between = bell(places, places).reshape(count, 8, count, 8)
    means = np.einsum("iajb,a,b->ij", between, 0.5 * weights, 0.5 * weights)
    seen, pressed = np.random.default_rng(2).uniform(0.1, 0.9, (2, 200))
    found = spline_weights(count, seen) @ means @ spline_weights(count, pressed).T
    assert np.abs(found - bell(seen, pressed)).max() < 0.01


@pytest.mark.parametrize("name", ["pinion", "wheel"])
def test_places_are_fractions_of_the_arc_length(concave, name):
    """Where the normals meet a flank, against the length of its section from the junction measured point by point."""
    angle = 0.2 * concave.pinion.pitch
    (contact,) = touches(concave, angle, 1)
    strip = Strip.of(ContactPlane.of(concave, contact, (angle, contact.wheel_angle)))
    grid = strip.grid(Window(1e-3, 2.0), 9, 9)
    member = getattr(concave, name)
    to_body = np.linalg.inv(member.pose(angle if name == "pinion" else contact.wheel_angle))
    middle = 4 * 9 + np.arange(9)
    feet = grid.points[middle] @ to_body[:3, :3].T + to_body[:3, 3]
    curves = member.tooth(0.0).side(member.working).flank
    section = np.atleast_1d(curves.section.at(feet).mean())
    first, last = curves.first(section)[0], curves.last(section)[0]
    line = curves.points(section, np.linspace(first, last, 20001)[None])[0]
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    nearest = [np.argmin(np.linalg.norm(line - foot, axis=1)) for foot in feet]
    assert grid.place[name][middle, 0] == pytest.approx(lengths[nearest] / lengths[-1], abs=1e-3)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--torque-nm", "0"], "--torque-nm"),
        (["--torque-nm", "nan"], "--torque-nm"),
        (["--torque-nm", "1", "--pairs", "0"], "--pairs"),
        (["--torque-nm", "1", "--rim-mm", "99"], "--rim-mm"),
        (["--torque-nm", "1", "--set", "material.poisson_ratio=0.5"], "material.poisson_ratio"),
    ],
)
def test_bad_input(capsys, arguments, said):
    assert main(["loaded", "spherical-table-4-4-concave", *arguments]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.validate
def test_a_load_that_no_flank_carries_is_said_to_be_so(capsys):
    """Flanks that touch all over are a spring: they would hold any torque, turned out of all reason."""
    design, turned = ["loaded", "spherical-table-4-4-concave", "--phi-deg", "0", "--json", "-"], []
    for torque in ("1e9", "1e12"):
        assert main([*design, "--torque-nm", torque]) == 1
        (point,) = json.loads(capsys.readouterr().out)["points"]
        assert point["status"] == "rotation_not_small" and "smaller torque" in point["message"]
        assert point["pairs"] == [] and point["loaded_transmission_error_arcsec"] is None
        turned.append(float(point["message"].split(" rad")[0].split()[-1]))
    assert turned[1] == pytest.approx(1000.0 * turned[0], rel=0.02)


@pytest.mark.validate
def test_a_rotation_that_is_not_small_is_said_to_be_so(capsys):
    """3 kN m turn the pinion by less than 0.01 rad and have figures, more than any tooth bears has none."""
    design = ["spherical-table-4-4-concave", "--phi-deg", "0"]

    def point(torque):
        status = main(["loaded", *design, "--torque-nm", str(torque), "--json", "-"])
        return status, json.loads(capsys.readouterr().out)["points"][0]

    held, too_much = point(3e3), point(1e9)
    assert held[0] == 0 and held[1]["status"] == "converged" and 1e-3 < held[1]["rotation_rad"] < 0.01
    status, refused = too_much
    assert status == 1 and refused["status"] == "rotation_not_small" and "smaller torque" in refused["message"]
    assert refused["pairs"] == [] and refused["loaded_transmission_error_arcsec"] is None
    assert main(["loaded", *design, "--torque-nm", "1e9"]) == 1
    assert "rotation_not_small" in capsys.readouterr().out


def test_a_contact_cut_off_by_an_edge_is_named(concave, monkeypatch):
    """Where the contact leaves a tip half of the ellipse is missing, and the pressure peaks at the edge.

    If both teeth ended there, with free edges that mirror each load, half of the ellipse of twice the force would be
    left, with 2^(1/3) of Hertz's pressure; the wheel goes on beyond the pinion's tip, which makes it more. Were the
    tip held as the half-space is, it would be more than twice that pressure, and draw load from the other pair.
    """
    found = loaded_contact(concave, np.radians(-1.8182), 3, TORQUE, None)
    cut, whole = found.pairs
    assert cut.cut_off and cut.peaks_at_edge and cut.edges == ("tip of the pinion",)
    highest = cut.pressures.max()
    assert highest > 2.0 ** (1.0 / 3.0) * cut.hertz.peak_pressure
    assert highest > cut.peak_pressure > cut.hertz.peak_pressure
    (load,) = cut.edge_zone.loads
    assert load.edge == "the tip of the pinion" and 0.25 * cut.force < load.force < 0.5 * cut.force
    assert not whole.cut_off and not whole.peaks_at_edge and whole.edges == ()
    assert whole.peak_pressure == pytest.approx(whole.hertz.peak_pressure, rel=2e-3)
    monkeypatch.setattr(cells, "free_edge_displacements", lambda *_: None)
    held = loaded_contact(concave, np.radians(-1.8182), 3, TORQUE, None).pairs[0]
    assert held.pressures.max() > 2.0 * held.hertz.peak_pressure and held.pressures.max() > highest
    assert held.force > cut.force


@pytest.mark.validate
def test_edges_in_text_and_json(capsys):
    arguments = ["loaded", "spherical-table-4-4-concave", "--torque-nm", "100", "--phi-deg=-1.8182,0"]
    assert main([*arguments, "--json", "-"]) == 0
    cut, whole = json.loads(capsys.readouterr().out)["points"]
    assert "pair -1 is cut off by the tip of the pinion" in cut["message"] and "(Hertz)" in cut["message"]
    assert [pair["cut_off_by"] for pair in cut["pairs"]] == [["tip of the pinion"], []]
    assert [pair["peak_at_edge"] for pair in cut["pairs"]] == [True, False]
    assert whole["message"] == "" and whole["pairs"][0]["cut_off_by"] == []
    assert main(arguments) == 0
    assert cut["message"] in capsys.readouterr().out


@pytest.mark.validate
def test_contact_lines_of_helical_teeth_are_generators_of_the_base_helix(capsys, monkeypatch):
    """ISO 21771:2007: contact lines lie in the plane of action at the base helix angle, sin β_b = sin β cos α_n."""
    monkeypatch.setattr(loading, "compliances", lambda *_: None)
    plain = ("design.pinion_tip_relief_um=0", "design.wheel_tip_relief_um=0", "misalignment.horizontal_deg=0")
    settings = [word for setting in plain for word in ("--set", setting)]
    assert main(["loaded", "helical-crowned", "--torque-nm", "60", "--phi-deg=2", "--json", "-", *settings]) == 0
    document = json.loads(capsys.readouterr().out)
    design = Drive.load("helical-crowned").design
    helix = np.sin(design.value("pinion_helix_angle_deg")) * np.cos(design.value("pressure_angle_deg"))
    carrying = [pair for pair in document["points"][0]["pairs"] if pair["share"] > 0.0]
    assert carrying
    for pair in carrying:
        for member in ("pinion", "wheel"):
            line = np.array(pair["line_mm"][member])
            along = line[-1] - line[0]
            assert abs(along[2]) / np.linalg.norm(along) == pytest.approx(np.cos(np.arcsin(helix)), abs=1e-4)


@pytest.mark.validate
def test_a_left_hand_drive_under_load_is_the_mirror_image_of_the_right_hand_one(capsys, monkeypatch):
    """On half-spaces of rigid teeth, which is all that the hand has to do with."""
    monkeypatch.setattr(loading, "compliances", lambda *_: None)

    def at(angle, *hand):
        words = ["loaded", "plain-za", "--torque-nm", "50", "--pairs", "1", f"--phi-deg={angle}", "--json", "-", *hand]
        assert main(words) == 0
        (point,) = json.loads(capsys.readouterr().out)["points"]
        return point

    right, left = at(4.0), at(-4.0, "--set", "design.hand=left")
    assert left["loaded_transmission_error_arcsec"] == pytest.approx(-right["loaded_transmission_error_arcsec"])
    (theirs,), (ours,) = right["pairs"], left["pairs"]
    assert ours["peak_pressure_mpa"] == pytest.approx(theirs["peak_pressure_mpa"])
    for member in ("pinion", "wheel"):
        assert np.array(ours["line_mm"][member]) * [1, -1, 1] == pytest.approx(np.array(theirs["line_mm"][member]))
