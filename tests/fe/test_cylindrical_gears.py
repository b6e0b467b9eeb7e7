"""Teeth and loaded contact of cylindrical gears against involute geometry and Hertz's closed form."""

import json

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.fe.body import mesh_body, placed_tooth, tooth_order
from meshwright.fe.grading import MeshDensity
from meshwright.fe.hertz import elliptic_contact
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.model import Load
from meshwright.fe.solids import gear_pair

DENSITY = MeshDensity(coarse_rows=(4, 8, 12), coarse_fillet_rows=6)
MODULE, PRESSURE_ANGLE = 3.0, np.radians(20.0)
CROWNING = {"pinion_lead_crowning_um": 15.0}


def base_radius(teeth):
    return 0.5 * MODULE * teeth * np.cos(PRESSURE_ANGLE)


@pytest.fixture(scope="module")
def spur():
    """The pair with profile shift, 12 and 24 teeth of 3 mm, with a lead crowning that makes its contact a point."""
    return Drive.load("spur-profile-shift").with_(design=CROWNING)


@pytest.mark.parametrize("flank", ["left", "right"])
@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_teeth_of_a_helical_pair(member, flank):
    """Valid elements between root, tip and faces of the blank; the crowning rack plunges deeper towards the faces."""
    drive = Drive.load("helical-crowned").with_(flank=flank)
    of, size = getattr(gear_pair(drive), member), drive.design.sizes
    order = tooth_order(of, 0.0, (-1, 0, 1))
    body = mesh_body([placed_tooth(of, 0.0, k, None) for k in order], DENSITY)
    assert body.mesh.smallest_jacobian() > 0.2
    assert of.working == flank
    middle = body.nodes(order.index(0), f"flank_{flank}")
    radii, heights = np.hypot(*body.mesh.nodes[middle, :2].T), body.mesh.nodes[middle, 2]
    assert radii.max() == pytest.approx(drive.design.value(f"{member}_tip_radius_mm", "blank"), abs=1e-9)
    assert radii.min() == pytest.approx(size[f"{member}_limit_radius_mm"], abs=0.02)
    assert (heights.min(), heights.max()) == pytest.approx((-12.0, 12.0), abs=1e-9)
    at_mid_face = getattr(of.tooth(0.0), flank).root_end(np.zeros(1))
    assert np.hypot(*at_mid_face[0, :2]) == pytest.approx(size[f"{member}_root_radius_mm"], abs=1e-9)


def test_thickness_on_the_reference_circle(spur):
    """m (π/2 + 2 x tan α) on the arc."""
    form = gear_pair(spur).pinion.tooth(0.0)
    profile = np.linspace(-2.2, -1.6, 201)
    azimuths = []
    for side in (form.left, form.right):
        points = side.flank.points(np.zeros(1), profile[None])[0]
        radii = np.hypot(points[:, 0], points[:, 1])
        azimuths.append(np.interp(18.0, radii, np.arctan2(points[:, 1], points[:, 0])))
    thickness = MODULE * (0.5 * np.pi + 2.0 * 0.6 * np.tan(PRESSURE_ANGLE))
    assert 18.0 * (azimuths[0] - azimuths[1]) == pytest.approx(thickness, abs=2e-5)


@pytest.mark.parametrize("place", [-0.1, 0.0, 0.15])
def test_a_single_pair_has_the_pressure_of_hertz(spur, place):
    """Force T/r_b; curvatures 1/ϱ1 + 1/ϱ2 of the involutes across and 8 C/b² of the crowning along the contact."""
    gear = gear_pair(spur)
    found = loaded_contact(gear, place * gear.pinion.pitch, 1, Load(20e3, "pinion"), None)
    (pair,) = found.pairs
    r_b1, r_b2 = base_radius(12), base_radius(24)
    assert pair.force == pytest.approx(20e3 / r_b1, rel=1e-3)
    rolled = np.sqrt(np.hypot(*pair.contact.touch.point[:2]) ** 2 - r_b1**2)
    line_of_action = np.sqrt(spur.design.value("center_distance_mm") ** 2 - (r_b1 + r_b2) ** 2)
    across = 1.0 / rolled + 1.0 / (line_of_action - rolled)
    along = 8.0 * 0.015 / 20.0**2
    modulus, poisson = 206e3, 0.3  # steel, as a design without [material] has it
    closed = elliptic_contact(20e3 / r_b1, along, across, 0.5 * modulus / (1.0 - poisson**2), poisson)
    assert pair.hertz.peak_pressure == pytest.approx(closed.peak_pressure, rel=1e-3)
    assert pair.peak_pressure == pytest.approx(closed.peak_pressure, rel=0.01)


def test_two_pairs_share_the_torque(spur):
    """Forces times the base radius add up to the torque where two pairs touch."""
    gear = gear_pair(spur)
    found = loaded_contact(gear, -0.35 * gear.pinion.pitch, 3, Load(20e3, "pinion"), None)
    forces = np.array([pair.force for pair in found.pairs])
    assert len(forces) == 2 and forces.sum() * base_radius(12) == pytest.approx(20e3, rel=1e-3)


@pytest.mark.validate
def test_loaded_helical_pairs_share_the_torque(capsys):
    """Moments about the pinion's axis, r_b cos β_b times each force, add up to the torque, shares to 1."""
    command = ["loaded", "helical-crowned", "--torque-nm", "60", "--phi-deg=0,5", "--json", "-"]
    assert main(command) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["torque_on"] == "pinion" and document["assumed_blank"] == {}
    size = Drive.load("helical-crowned").design.sizes
    arm = size["pinion_base_radius_mm"] * np.cos(np.radians(size["pinion_base_helix_angle_deg"]))
    assert [len(point["pairs"]) > 1 for point in document["points"]].count(True) >= 1
    for point in document["points"]:
        assert sum(pair["share"] for pair in point["pairs"]) == pytest.approx(1.0, abs=1e-12)
        assert sum(pair["force_n"] for pair in point["pairs"]) * arm == pytest.approx(60e3, rel=2e-3)


def test_an_undercut_tooth_is_solid_down_to_its_root():
    """Twelve teeth without profile shift are undercut at 20 degrees: flank and fillet meet above the base circle."""
    drive = Drive.load("spur-profile-shift").with_(design=CROWNING | {
        "pinion_profile_shift_coefficient": 0.0, "wheel_profile_shift_coefficient": 0.0,
    })  # fmt: skip
    pinion = gear_pair(drive).pinion
    form = pinion.tooth(0.0)
    values = np.linspace(*form.faces, 7)
    for side in (form.left, form.right):
        flank, fillet = (of.points(values, end(values)[:, None])[:, 0] for of, end in (
            (side.flank, side.flank.first), (side.fillet, side.fillet.last),
        ))  # fmt: skip
        assert np.linalg.norm(flank - fillet, axis=1).max() < 1e-6
        assert (np.hypot(flank[:, 0], flank[:, 1]) > base_radius(12) + 1e-3).all()
    body = mesh_body([placed_tooth(pinion, 0.0, k, None) for k in tooth_order(pinion, 0.0, (0,))], DENSITY)
    assert body.mesh.smallest_jacobian() > 0.2
