"""Teeth that the regions of flanks and fillets make: bevel and hypoid gears, and others that have sizes beside them."""

import json

import numpy as np
import pytest
from on_flank import distance_from_flank

from meshwright import Drive
from meshwright.cli import main
from meshwright.fe import loaded
from meshwright.fe.body import mesh_body, placed_tooth, tooth_order
from meshwright.fe.closed_body import gear_tooth
from meshwright.fe.compliance import tooth_compliance
from meshwright.fe.elastic import assemble
from meshwright.fe.grading import MeshDensity
from meshwright.fe.hertz import elliptic_contact
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.model import Load
from meshwright.fe.region_teeth import region_teeth
from meshwright.fe.solids import gear_pair, teeth_of
from meshwright.flank.known_side import KnownSide
from tests.quick import quick

LOAD = Load(50e3, "wheel")


PAIRS = ("bevel-crowned-both", "bevel-face-hobbed", "bevel-hypoid", "bevel-formate")


@pytest.fixture(scope="module", params=quick(PAIRS))
def pair(request):
    drive = Drive.load(request.param)
    return drive, gear_pair(drive)


@pytest.fixture(scope="module")
def middle(pair):
    """The angle of the pair in the middle of its path: a hypoid's lies far from 0."""
    window = pair[0].contact_ratio()
    return 0.5 * (window.begin.angle + window.end.angle)


def test_half_spaces_bear_the_torque_and_tend_to_hertz(pair, middle):
    """Rigid teeth of bevel gears: the moment of all pressures is the torque. Ellipses some millimetres long reach where
    flanks curve otherwise than at the contact: what Hertz does not know goes as their length squared, the force to 2/3.
    """
    _, gear = pair
    origin, axis = gear.wheel.axis
    for part, off in ((0.5, 0.01), (0.1, 0.004)):
        found = loaded_contact(gear, middle, 1, Load(part * LOAD.torque, "wheel"), None)
        moment = 0.0
        for one in found.pairs:
            arms = np.cross(one.grid.points - origin, one.grid.frame[:, 2]) @ axis
            moment += float((one.grid.area * one.pressures) @ arms)
            assert one.peak_pressure == pytest.approx(one.hertz.peak_pressure, rel=off)
        assert abs(moment) == pytest.approx(part * LOAD.torque, rel=1e-9)


def test_torques_that_do_the_same_work_press_alike(pair, middle):
    """T1 dφ1 = T2 dφ2 of rigid teeth: torque on the pinion, or what keeps it in balance on the wheel.

    A torque so small that the lever arms of its ellipse are those of the point of contact.
    """
    drive, gear = pair
    step = 1e-3
    before, after = drive.tca(np.array([middle - step, middle + step])).wheel_angles
    rate = (after - before) / (2.0 * step)
    loads = Load(50.0, "wheel"), Load(50.0 * rate, "pinion")
    found = [loaded_contact(gear, middle, 1, load, None).pairs[0] for load in loads]
    assert found[1].force == pytest.approx(found[0].force, rel=1e-4)
    assert found[1].peak_pressure == pytest.approx(found[0].peak_pressure, rel=1e-3)


def test_nodes_lie_on_the_generated_flanks(pair):
    """To 1e-9 mm, of positive elements in three teeth side by side."""
    drive, gear = pair
    for name in ("pinion", "wheel"):
        member = getattr(gear, name)
        order = tooth_order(member, 0.0, (-1, 0, 1))
        body = mesh_body([placed_tooth(member, 0.0, k, None) for k in order], MeshDensity())
        assert body.mesh.smallest_jacobian() > 0.2
        grid = drive.surface(name, (33, 65))  # beside the cusp of an undercut flank other starts lead beyond it
        starts = grid.values[np.isfinite(grid.points).all(axis=1)]
        nodes = body.mesh.nodes[body.nodes(order.index(0), f"flank_{member.working}")]
        assert distance_from_flank(drive.flank(name), nodes, starts).max() < 1e-9


def test_rigid_motions_and_even_strain_cost_no_forces(pair):
    """Inside two teeth side by side: of the elements as they are, with nodes common to both along the cut."""
    _, gear = pair
    for member in (gear.pinion, gear.wheel):
        order = tooth_order(member, 0.0, (0, 1))
        mesh = mesh_body([placed_tooth(member, 0.0, k, None) for k in order], MeshDensity()).mesh
        faces = np.sort(np.concatenate([mesh.elements[:, list(f)] for f in mesh_faces()]), axis=1)
        distinct, count = np.unique(faces, axis=0, return_counts=True)
        inside = np.setdiff1d(np.arange(len(mesh.nodes)), distinct[count == 1])
        stiffness = assemble(mesh, member.material)
        about = mesh.nodes - mesh.nodes.mean(axis=0)
        for field, where in (
            (np.broadcast_to([1.0, -2.0, 0.5], about.shape), slice(None)),
            (np.cross([0.3, -1.0, 0.7], about), slice(None)),
            (about @ np.array([[1.0, 0.2, -0.4], [0.2, 0.5, 0.3], [-0.4, 0.3, -0.8]]), inside),
        ):
            moved = stiffness @ field.ravel()
            size = abs(stiffness) @ np.abs(field).ravel()
            assert np.abs(moved.reshape(-1, 3)[where]).max() < 1e-12 * size.max()


def mesh_faces():
    return (0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)


def whole(design):
    """With a whole blank, of the standard proportions where the design leaves it open."""
    return Drive(Drive.load(design).design.with_whole_blank()[0])


def changes(known):
    """Numbers of the known sections after which lines end for other reasons."""
    return np.flatnonzero(np.any([why[1:] != why[:-1] for why in known.ends.values()], axis=0))


@pytest.mark.parametrize(
    ("design", "member"), quick((("bevel-hypoid", "pinion"), ("bevel-hypoid", "wheel"), ("plain-zc", "wheel")))
)
def test_ends_in_any_section_are_those_that_the_region_has(design, member):
    """Undercut or not, beside a change of what ends the lines or not, to 1e-9 mm; flank and fillet meet to the
    micrometre's thousandth. Polynomials tell the profile's parameter there to 1e-9 of its size, in most sections.
    """
    tooth, _ = gear_tooth(whole(design), member, None)
    values = np.random.default_rng(3).uniform(*tooth.faces, 12)
    for side in tooth.sides:
        known = KnownSide.of(side, tooth.faces)
        beside = np.ravel([known.values[changes(known) + k] + (0.5 - k) * 1e-4 for k in (0, 1)])
        values = np.sort(np.concatenate([values, beside]))
        known.profiles("flank", np.linspace(*tooth.faces, 1001))
        assert known.pieces[0].at(np.linspace(*tooth.faces, 1001))[1].mean() > 0.95
        for near, exact in zip(known.at(values), side.at(values), strict=True):
            for end in ("lower", "upper"):
                places = [of.region.flank(getattr(of, end)).points for of in (near, exact)]
                assert places[0] == pytest.approx(places[1], abs=1e-9)
        for name, exact in zip(("flank", "fillet"), side.at(values), strict=True):
            of = exact.region.profile
            for told, end in zip(known.profiles(name, values), (exact.lower, exact.upper), strict=True):
                assert told == pytest.approx(end[:, of], abs=1e-9 * exact.region.chart.sizes[of])


def test_sections_are_known_close_to_where_the_reasons_change():
    """So that few lines are left to the side itself; there are such changes on the wheel of a ZC worm."""
    tooth, _ = gear_tooth(whole("plain-zc"), "wheel", None)
    sides = [KnownSide.of(side, tooth.faces) for side in tooth.sides]
    assert any(len(changes(known)) for known in sides)
    for known in sides:
        assert (np.diff(known.values) > 0.0).all() and len(known.flank.along) == len(known.values)
        assert (np.diff(known.values)[changes(known)] < 1e-4 * np.ptp(tooth.faces)).all()


@pytest.mark.parametrize("member", quick(("pinion", "wheel"), "pinion"))
def test_regions_and_sizes_make_the_same_tooth(member):
    """Helical gears have both: fillet and flank of either side in common sections, cuts and bore, to 1e-6 mm."""
    drive = Drive.load("helical-crowned").with_(design={f"{m}_{k}_um": 0.0 for m, k in (
        ("pinion", "lead_crowning"), ("pinion", "profile_crowning"), ("pinion", "tip_relief"), ("wheel", "tip_relief"),
    )})  # fmt: skip
    rim = 11.25
    by_sizes, by_regions = teeth_of(drive, member, rim), region_teeth(drive, member, rim)
    assert by_sizes.working == by_regions.working
    one, other = by_sizes.at(0.0), by_regions.at(0.0)
    assert other.faces == pytest.approx(one.faces, abs=1e-9)
    values, shares = np.linspace(*one.faces, 5), np.tile(np.linspace(0.0, 1.0, 7), (5, 1))
    for name in ("left", "right"):
        for part in ("fillet", "flank"):
            places = [getattr(form.side(name), part).rail(values).at(shares) for form in (one, other)]
            assert places[1] == pytest.approx(places[0], abs=1e-5)
            assert places[1][:, [0, -1]] == pytest.approx(places[0][:, [0, -1]], abs=1e-6)
    for cut in ("left_cut", "right_cut"):
        assert getattr(other, cut)(values) == pytest.approx(getattr(one, cut)(values), abs=1e-6)


@pytest.mark.validate
def test_compliance_of_bevel_teeth_is_that_of_finer_meshes(pair):
    """Extrapolated from the usual meshes and from half as fine again: 4 % of the largest entry at most between them."""
    _, gear = pair
    for member in (gear.pinion, gear.wheel):
        usual, finer = (tooth_compliance(member, 0, per_patch).own for per_patch in (1, 2))
        assert np.abs(usual - finer).max() < 0.04 * np.abs(finer).max()


@pytest.mark.validate
def test_a_low_torque_has_the_pressure_of_hertz(pair, middle):
    """Elastic teeth, an ellipse well inside the flanks: peak and force in closed form, from the drive's tangency."""
    drive, gear = pair
    torque, steel = 2e3, gear.wheel.material
    tca = drive.tca([middle])
    origin, axis = gear.wheel.axis
    force = torque / abs(axis @ np.cross(tca.points[0] - origin, tca.normals[0]))
    modulus = 0.5 * steel.youngs_modulus / (1.0 - steel.poisson_ratio**2)
    hertz = elliptic_contact(force, *tca.curvatures[0], modulus, steel.poisson_ratio)
    teeth = {name: tooth_compliance(getattr(gear, name)) for name in ("pinion", "wheel")}
    (found,) = loaded_contact(gear, middle, 1, Load(torque, "wheel"), teeth).pairs
    assert not found.cut_off
    assert found.force == pytest.approx(force, rel=1e-3)
    assert found.peak_pressure == pytest.approx(hertz.peak_pressure, rel=3e-3)


@pytest.mark.validate
def test_forces_do_not_depend_on_the_cells(pair, middle, monkeypatch):
    """Half as many again along and across: the wheel's lag under load within 0.5 %."""
    _, gear = pair
    usual = loaded_contact(gear, middle, 3, LOAD, None).rotation
    monkeypatch.setattr(loaded, "_CELLS", ((31, 21), (45, 31)))
    assert loaded_contact(gear, middle, 3, LOAD, None).rotation == pytest.approx(usual, rel=5e-3)


@pytest.mark.validate
def test_a_hypoid_pair_under_load(capsys):
    """Shares add up to the whole; teeth are softer than half-spaces; more torque, more lag."""
    words = ["loaded", "bevel-hypoid", "--phi-deg=43,50", "--json", "-", "--pairs", "3"]
    lags = []
    for torque in ("50", "200"):
        assert main([*words, "--torque-nm", torque]) == 0
        points = json.loads(capsys.readouterr().out)["points"]
        for point in points:
            assert sum(one["share"] for one in point["pairs"]) == pytest.approx(1.0)
        errors = [[p[f"{key}_transmission_error_arcsec"] for key in ("unloaded", "loaded")] for p in points]
        lags.append([abs(one - other) for one, other in errors])
    assert all(less < more < 4.0 * less for less, more in zip(*lags, strict=True))


@pytest.mark.validate
def test_a_bevel_pair_carries_along_lines(capsys):
    """All pairs of a crown gear's mates touch along lines at once, and share the torque by them."""
    assert main(["loaded", "bevel-crown-pair", "--torque-nm", "20", "--phi-deg=0", "--json", "-"]) == 0
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert [(pair["kind"], pair["gap_um"] < 1e-6) for pair in point["pairs"]] == [("line", True)] * 3
    assert all(pair["force_n"] > 0.0 for pair in point["pairs"])
    assert sum(pair["share"] for pair in point["pairs"]) == pytest.approx(1.0)


@pytest.mark.validate
def test_finite_elements_refuse_lines_with_the_remedy(capsys, tmp_path):
    words = ["fe", "bevel-crown-pair", "--torque-nm", "20", "--phi-deg=0", "--folder", str(tmp_path / "fe")]
    assert main(words) == 2
    assert "crown a flank" in capsys.readouterr().err
