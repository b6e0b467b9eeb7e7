"""Thread, wheel teeth and semi-analytic contact of cylindrical worm drives."""

import numpy as np
import pytest
from on_flank import distance_from_flank

from meshwright import Drive
from meshwright.cli import main
from meshwright.fe.body import mesh_body, placed_tooth, tooth_order
from meshwright.fe.cylindrical_worm import completed
from meshwright.fe.generated import about_z
from meshwright.fe.grading import MeshDensity
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.model import Load
from meshwright.fe.solids import gear_pair
from tests.worm.hob_tip import Balls

DENSITY = MeshDensity(coarse_rows=(4, 8, 12), coarse_fillet_rows=6)
ANGLES = {"recess-action-full": np.radians(1200.0), "zk-zn-60": 0.2}


@pytest.fixture(scope="module", params=ANGLES)
def drive_and_gear(request):
    """A drive with a whole blank, its gear pair and a worm angle at which it is in mesh."""
    drive = Drive.load(request.param)
    return completed(drive)[0], gear_pair(drive), ANGLES[request.param]


def body_of(member, angle):
    order = tooth_order(member, angle, (-1, 0, 1))
    return mesh_body([placed_tooth(member, angle, k, None) for k in order], DENSITY), order


def places(drive, member, turn):
    """Parameters (S, 2) around a place on the flank of a member."""
    flank = drive.flank(member)
    grid = drive.surface(member, (9, 9)).values
    profile, along = np.meshgrid(np.linspace(grid[:, 0].min(), grid[:, 0].max(), 12), np.linspace(-1.6, 1.6, 33))
    assert len(flank.parameters) == 2
    return np.stack([profile.ravel(), turn + along.ravel()], axis=1)


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_teeth(drive_and_gear, member):
    """Valid elements, and both flanks on the generated surfaces: the worm's second one that of the next groove."""
    drive, gear, angle = drive_and_gear
    worm = member == "pinion"
    of = getattr(gear, member)
    own_angle = angle if worm else angle * gear.ratio
    body, order = body_of(of, own_angle)
    assert body.mesh.smallest_jacobian() > 0.2
    other = drive.with_(flank="left" if drive.design.flank > 0 else "right")
    sides = {of.working: (drive, 0.0), ("right" if of.working == "left" else "left"): (other, -drive.pitch())}
    for side, (source, groove) in sides.items():
        nodes = body.mesh.nodes[body.nodes(order.index(0), f"flank_{side}")]
        turn = groove if worm else 0.0
        starts = places(source, member, -angle - turn if worm else 0.0)
        assert distance_from_flank(source.flank(member), nodes @ about_z(-turn)[:3, :3].T, starts).max() < 1e-9


def test_wheel_root_is_as_deep_as_the_hob_reaches(drive_and_gear):
    """In the middle plane: cutting distance less the hob's tip radius."""
    drive, gear, _ = drive_and_gear
    value = drive.design.value
    deepest = value("cutting_center_distance_mm") - value("hob_pitch_radius_mm") - value("hob_tip_addendum_mm", "blank")
    form = gear.wheel.tooth(0.0)
    roots = np.concatenate([side.root_end(np.zeros(1)) for side in (form.left, form.right)])
    assert np.hypot(*roots[:, :2].T) == pytest.approx([deepest, deepest], abs=1e-9)


def test_wheel_tooth_is_what_the_tip_of_the_hob_leaves(drive_and_gear):
    """Fillet nodes are a ball's radius from the nearest place that a ball of the hob's tip comes to, flank nodes not
    less: the wheel of the recess-action drive, and the one at 60 degrees, which the hob undercuts.
    """
    drive, gear, angle = drive_and_gear
    body, order = body_of(gear.wheel, angle * gear.ratio)
    rounding = drive.design.value("hob_tip_rounding_mm", "blank")
    other = drive.with_(flank="left" if drive.design.flank > 0 else "right")
    sides = {gear.wheel.working: drive, ("right" if gear.wheel.working == "left" else "left"): other}
    for side, source in sides.items():
        balls, form = Balls(source, rounding), gear.wheel.tooth(0.0).side(side)
        undercut = np.abs(form.flank.first(np.zeros(1)) - balls.t) > 1.0
        assert undercut.all() == (drive.design.tables["name"] == "zk-zn-60")
        fillet, flank = (body.mesh.nodes[body.nodes(order.index(0), f"{part}_{side}")] for part in ("fillet", "flank"))
        away = [balls.nearest(point) for point in fillet]
        assert away == pytest.approx([rounding] * len(fillet), abs=1e-7)
        assert min(balls.nearest(point) for point in flank) > rounding - 1e-7


def test_half_spaces_give_hertz(drive_and_gear):
    """A single pair on rigid teeth carries the moment under Hertz's pressure."""
    _, gear, angle = drive_and_gear
    found = loaded_contact(gear, angle, 1, Load(50e3, "wheel"), None)
    (pair,) = found.pairs
    touch = pair.contact.touch
    origin, axis = gear.wheel.axis
    arm = abs(np.dot(axis, np.cross(touch.point - origin, touch.normal)))
    assert pair.force * arm == pytest.approx(50e3, rel=2e-3)
    assert pair.peak_pressure == pytest.approx(pair.hertz.peak_pressure, rel=0.01)


def test_what_the_blank_leaves_open_is_said(capsys):
    assert main(["loaded", "zk-zn-60", "--torque-nm", "20", "--phi-deg=0", "--pairs", "1"]) == 0
    assert "wheel_face_width_mm = " in capsys.readouterr().out


def test_face_beyond_the_hob_is_refused(capsys):
    """At 90 degrees the hob's flank ends within a face of 23 mm."""
    assert main(["loaded", "zk-zn-90", "--torque-nm", "20", "--set", "blank.wheel_face_width_mm=23"]) == 2
    assert "blank.wheel_face_width_mm" in capsys.readouterr().err


@pytest.mark.parametrize("rounding", [1.2, 30.0])
def test_rounding_without_room_on_the_hob_is_refused(capsys, rounding):
    """A fully round tip has 1.03 mm; a ball of 30 mm finds no place at all."""
    size = f"blank.hob_tip_rounding_mm={rounding}"
    assert main(["loaded", "recess-action-full", "--torque-nm", "20", "--set", size]) == 2
    message = capsys.readouterr().err
    assert "hob_tip_rounding_mm" in message and "face_width" not in message
