"""Thread, wheel teeth and semi-analytic contact of cylindrical worm drives."""

import re

import numpy as np
import pytest
from on_flank import distance_from_flank

from meshwright import Drive
from meshwright.cli import main
from meshwright.fe.body import mesh_body, placed_tooth, tooth_order
from meshwright.fe.generated import about_z
from meshwright.fe.grading import MeshDensity
from meshwright.fe.loaded import loaded_contact
from meshwright.fe.model import Load
from meshwright.fe.pair import touches
from meshwright.fe.solids import gear_pair
from tests.quick import full, quick, some
from tests.worm.designs import without_blank
from tests.worm.hob_tip import Balls

DENSITY = MeshDensity(coarse_rows=(4, 8, 12), coarse_fillet_rows=6)
ANGLES = {"recess-action-full": np.radians(1200.0), "zk-zn-60": 0.2, "plain-zn": 0.0}


@pytest.fixture(scope="module", params=quick(ANGLES, "recess-action-full", "plain-zn"))
def drive_and_gear(request, tmp_path_factory):
    """A drive with a whole blank, its gear pair and a worm angle at which it is in mesh; one blank is all assumed."""
    bare = request.param.startswith("zk")
    drive = Drive.load(without_blank(request.param, tmp_path_factory.mktemp("bare")) if bare else request.param)
    return whole(drive), gear_pair(drive), ANGLES[request.param]


def whole(drive):
    """The drive with the standard proportions where its blank is open."""
    return Drive(drive.design.with_whole_blank()[0])


def body_of(member, angle):
    order = tooth_order(member, angle, (-1, 0, 1))
    return mesh_body([placed_tooth(member, angle, k, None) for k in order], DENSITY), order


def places(drive, member, turn):
    """Parameters (S, 2) around a place on the flank of a member, away from its singular lines on their inner side."""
    flank = drive.flank(member)
    grid = drive.surface(member, (9, 9)).values
    profile, along = np.meshgrid(np.linspace(grid[:, 0].min(), grid[:, 0].max(), 12), np.linspace(-1.6, 1.6, 33))
    assert len(flank.parameters) == 2
    around = np.stack([profile.ravel(), turn + along.ravel()], axis=1)
    # on such a line no step leads on, and from beyond it every step leads to the other sheet
    return around[flank(around).regular > 1e-6]


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
        every = 1 if full() else 4  # not by the rows of the mesh
        away = [balls.nearest(point) for point in fillet[:: 5 * every]]
        assert away == pytest.approx([rounding] * len(away), abs=1e-7)
        assert min(balls.nearest(point) for point in flank[:: 7 * every]) > rounding - 1e-7


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


@pytest.mark.validate
def test_what_the_blank_leaves_open_is_said(capsys, tmp_path):
    """And that, being so narrow (contact ratio 0.69), it has edges of its faces alone in contact at some angles."""
    bare = without_blank("zk-zn-60", tmp_path)
    assert main(["loaded", bare, "--torque-nm", "20", "--phi-deg=-60,0", "--pairs", "1"]) == 0
    assumed, *_, between, beside, inside = capsys.readouterr().out.splitlines()
    assert "wheel_face_width_mm = " in assumed
    assert between.split()[0] == "-60" and inside.split()[0] == "0"
    first = re.findall(r"pair (\S+) touches first with the edge of the wheel \((?:left|right) face\)", beside)
    assert first == ["-1", "+0"]


def test_contact_ratio_of_the_whole_blank():
    """The window of a pair over the pitch; below 1 there are gaps, which a wider face closes."""
    drive = Drive.load("zk-zn-60")
    narrow, wide = (gear_pair(drive.with_(blank={"wheel_face_width_mm": width})) for width in (8.8, 18))
    angles = np.linspace(-0.5, 0.5, 9) * narrow.pinion.pitch
    assert narrow.contact_ratio < 1.0 < wide.contact_ratio and narrow.ends == ("face of the wheel",)
    assert not all(touches(narrow, angle, 3) for angle in angles)
    assert all(touches(wide, angle, 3) for angle in angles)


@pytest.mark.parametrize("name", quick(["plain-za", "plain-zc", "plain-zi", "plain-zk", "plain-zn"], "plain-zn"))
def test_tip_of_a_wide_wheel_is_that_of_its_blank(name):
    """Throat and outside cylinder, though at the faces the tooth is lower than the middle of its flank at mid face."""
    drive = whole(Drive.load(name))
    value = drive.design.value
    distance, throat = value("center_distance_mm"), value("wheel_throat_radius_mm", "blank")
    sections = np.linspace(-16.0, 16.0, 17)
    to_throat = distance - np.sqrt((distance - throat) ** 2 - sections**2)
    wanted = np.minimum(to_throat, value("wheel_tip_radius_mm", "blank"))
    form = gear_pair(drive).wheel.tooth(0.0)
    for side in (form.left, form.right):
        tip = side.flank.points(sections, side.flank.last(sections)[:, None])[:, 0]
        assert np.hypot(*tip[:, :2].T) == pytest.approx(wanted, abs=1e-8)


@pytest.mark.validate
@pytest.mark.parametrize(("name", "width"), some([("zk-zn-90", 26.0), ("plain-za", 36.0)], ("plain-za", 36.0)))
def test_face_beyond_the_hob_is_refused_with_the_widest_one(capsys, name, width):
    """The hob's flank ends within these faces; the width named in the remedy can be had."""
    assert main(["loaded", name, "--torque-nm", "20", "--set", f"blank.wheel_face_width_mm={width}"]) == 2
    message = capsys.readouterr().err
    assert f"blank.wheel_face_width_mm = {width}" in message
    widest = float(re.search(r"at most ([\d.]+)", message)[1])
    assert 0.5 * width < widest < width
    form = gear_pair(Drive.load(name).with_(blank={"wheel_face_width_mm": widest})).wheel.tooth(0.0)
    assert form.faces == pytest.approx((-0.5 * widest, 0.5 * widest))


@pytest.mark.parametrize(
    ("tip", "said"),
    [
        (60.0, "blank.wheel_tip_radius_mm = 60.0: the flank of the wheel is empty"),
        (90.0, "the flank of the wheel does not reach its tip"),
    ],
)
def test_a_tip_off_the_flank_at_every_width_is_refused(capsys, tip, said):
    """At 90 degrees the flank in the middle plane lies between these radii; the hob's tip leaves a root of 61.4 mm."""
    blank = ["--set", f"blank.wheel_tip_radius_mm={tip}", "--set", "blank.worm_root_radius_mm=4"]
    assert main(["loaded", "zk-zn-90", "--torque-nm", "20", *blank]) == 2
    message = capsys.readouterr().err
    assert said in message and "change blank.wheel_tip_radius_mm" in message


@pytest.mark.parametrize("rounding", [1.2, 30.0])
def test_rounding_without_room_on_the_hob_is_refused(capsys, rounding):
    """A fully round tip has 1.03 mm; a ball of 30 mm finds no place at all."""
    size = f"blank.hob_tip_rounding_mm={rounding}"
    assert main(["loaded", "recess-action-full", "--torque-nm", "20", "--set", size]) == 2
    message = capsys.readouterr().err
    assert "hob_tip_rounding_mm" in message and "face_width" not in message
