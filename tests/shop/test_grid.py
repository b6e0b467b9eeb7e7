"""Nominal points and sizes over balls, against closed forms of involute and Archimedean helicoids."""

import csv
import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq, minimize

from meshwright import Drive
from meshwright.cli import main
from meshwright.shop.balls import sizes
from meshwright.shop.nominal import nominal
from meshwright.shop.tables import read_csv
from tests.quick import quick

#: Long, and of the kind of others.
LATER = pytest.mark.validate

REFERENCE = Path(__file__).resolve().parents[1] / "reference"


@pytest.fixture(scope="module")
def involute():
    return Drive.load("plain-zi")


def _involute(angle):
    return math.tan(angle) - angle


def _angle_of_involute(value):
    """The angle of an involute, by Newton's method on its tangent: falls monotonically from value + π/2."""
    tangent = value + math.pi / 2
    for _ in range(60):
        tangent -= (tangent - math.atan(tangent) - value) * (1 + tangent**2) / tangent**2
    return math.atan(tangent)


def test_points_of_an_archimedean_worm_lie_on_their_straight_edges(tmp_path):
    """ZA groove flank, +z side: z − pθ − S/2 = (ρ − r) tan α_x, S half the axial pitch, tan α_x = tan α / cos λ."""
    path = tmp_path / "worm.csv"
    arguments = ["grid", "plain-za", "--member", "pinion", "--lines", "5x9", "--ball-mm", "2", "--csv", str(path)]
    assert main(arguments) == 0
    found, remarks = read_csv(path)
    lead_angle, pressure_angle = math.radians(11.31), math.radians(20.0)
    r, p = 4.0 / math.sin(lead_angle), 4.0 / math.cos(lead_angle)
    x, y, z = found.points.T
    radius, angle = np.hypot(x, y), np.arctan2(y, x)
    height = z - math.pi * p / 4 - (radius - r) * math.tan(pressure_angle) / math.cos(lead_angle)
    turns = (height - p * angle) / (math.pi * p)  # two threads: each half lead holds one
    assert np.abs((turns - np.round(turns)) * math.pi * p).max() < 1e-9
    assert np.abs(np.linalg.norm(found.normals, axis=1) - 1).max() < 1e-12
    screw = np.einsum("ij,ij->i", np.cross([0, 0, 1], found.points) + [0, 0, p], found.normals)
    assert np.abs(screw).max() < 1e-9
    assert len(found.tooth) == 45 and remarks["margin_percent"] == "5.0"
    rows = csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#"))
    centres = np.array([[float(row[name]) for name in ("cx_mm", "cy_mm", "cz_mm")] for row in rows])
    assert centres == pytest.approx(found.points + found.normals, abs=1e-12)


def test_points_stay_off_the_ends_by_the_margin():
    """Spur gear: the lines across the face stand at 5 % … 95 % of its width, and every point off tip and root."""
    drive = Drive.load("spur-profile-shift")
    found = nominal(drive, "pinion", (5, 3), 0.05)
    assert found.points[:, 2].reshape(5, 3)[0] == pytest.approx([-9.0, 0.0, 9.0], abs=1e-9)
    whole = drive.surface("pinion", (5, 3)).points
    inner, outer = (np.hypot(p[:, 0], p[:, 1]) for p in (found.points, whole))
    assert inner.min() > outer.min() + 1e-3 and inner.max() < outer.max() - 1e-3


def test_teeth_and_flanks_are_those_of_one_wheel():
    """Tooth 2 is tooth 1 turned by a pitch; a left flank is the mirror image of the right one of a spur tooth."""
    drive = Drive.load("spur-profile-shift")
    found = nominal(drive, "wheel", (3, 3), 0.05, teeth=(1, 2), flanks=("left", "right"))
    parts = found.points.reshape(4, 9, 3)
    pitch = 2 * math.pi / 24
    turn = np.array([[math.cos(pitch), -math.sin(pitch), 0], [math.sin(pitch), math.cos(pitch), 0], [0, 0, 1]])
    assert parts[1] == pytest.approx(parts[0] @ turn.T, abs=1e-12)
    assert parts[2] == pytest.approx(parts[0] * [1, -1, 1], abs=1e-9)
    assert found.tooth.tolist() == [1] * 9 + [2] * 9 + [1] * 9 + [2] * 9
    assert found.flank == ("left",) * 18 + ("right",) * 18


@pytest.mark.parametrize("ball", quick([4.0, 5.5, 7.0], 5.5))
def test_size_over_wires_of_an_involute_worm(involute, ball):
    """inv a_K = inv a_t + d/(2 r_b sin λ_b) − S/(2 r sin λ), R = r_b/cos a_K; groove and thread are equally wide."""
    lead_angle, pressure_angle = math.radians(11.31), math.radians(20.0)
    r, p = 4.0 / math.sin(lead_angle), 4.0 / math.cos(lead_angle)
    base_lead_angle = math.acos(math.cos(lead_angle) * math.cos(pressure_angle))
    base = p / math.tan(base_lead_angle)
    groove = math.pi * 4.0 / 2
    value = _involute(math.acos(base / r)) + ball / (2 * base * math.sin(base_lead_angle))
    radius = base / math.cos(_angle_of_involute(value - groove / (2 * r * math.sin(lead_angle))))
    (found,) = sizes(involute, "pinion", [ball])
    assert found.centre_radius == pytest.approx(radius, abs=1e-9)
    assert found.size == pytest.approx(2 * radius + ball, abs=1e-9)
    assert found.wires == pytest.approx(2 * radius + ball, abs=1e-9)


def _over_balls(normal_module, teeth, helix_angle, shift, ball):
    """Diametral dimension over balls of an external involute gear, 20° (ISO 21771:2007, 8.3)."""
    normal_angle = math.radians(20.0)
    angle = math.atan(math.tan(normal_angle) / math.cos(helix_angle))
    half_space = (math.pi - 4 * shift * math.tan(normal_angle)) / (2 * teeth)
    value = ball / (normal_module * teeth * math.cos(normal_angle)) - half_space + _involute(angle)
    pitch_diameter = normal_module * teeth / math.cos(helix_angle)
    centre = pitch_diameter * math.cos(angle) / math.cos(_angle_of_involute(value))
    return centre / 2, (centre if teeth % 2 == 0 else centre * math.cos(math.pi / (2 * teeth))) + ball


@pytest.mark.parametrize(
    ("design", "member", "gear"),
    [
        ("spur-profile-shift", "pinion", (3.0, 12, 0.0, 0.6, 6.0)),
        pytest.param("spur-profile-shift", "wheel", (3.0, 24, 0.0, 0.36, 5.25), marks=LATER),
        pytest.param("crossed-helical-17-23", "pinion", (1.0, 17, math.radians(45.0), 0.0, 1.75), marks=LATER),
        ("crossed-helical-17-23", "wheel", (1.0, 23, math.radians(45.0), 0.0, 1.75)),
    ],
)
def test_size_over_balls_of_involute_gears(design, member, gear):
    (found,) = sizes(Drive.load(design), member, gear[-1:])
    radius, size = _over_balls(*gear)
    assert found.centre_radius == pytest.approx(radius, abs=1e-9)
    assert found.size == pytest.approx(size, abs=1e-9)


def test_three_wires_of_the_worm_of_a_published_table():
    """Six printed figures of one column: m_x 2, α_n 20°, one thread, d 31, wires 3.3.

    Stock Drive Products/Sterling Instrument, Elements of Metric Gear Technology, three-wire method of worm measurement,
    Tables 10-25 and 10-26 (the worm as an involute helical gear). The figures were written down without the page
    at hand; the angle and the involute at the reference cylinder, which only the table prints, bind them
    to one another.
    """
    printed = json.loads((REFERENCE / "worm-over-wires.json").read_text())["example"]
    drive = Drive.from_tables({
        "drive": "cylindrical-worm",
        "design": {
            "axial_module_mm": printed["axial_module_mm"], "worm_threads": printed["threads"], "wheel_teeth": 30,
            "worm_pitch_radius_mm": printed["reference_diameter_mm"] / 2,
            "pressure_angle_deg": printed["normal_pressure_angle_deg"],
            "worm_profile": "ZI", "hob_pitch_radius_mm": 16.0,
        },
        "blank": {"worm_tip_radius_mm": 17.5, "worm_root_radius_mm": 13.0},
    })  # fmt: skip
    (found,) = sizes(drive, "pinion", [printed["wire_diameter_mm"]])

    lead_angle = math.atan(printed["axial_module_mm"] * printed["threads"] / printed["reference_diameter_mm"])
    transverse = math.atan(math.tan(math.radians(printed["normal_pressure_angle_deg"])) / math.sin(lead_angle))
    at_wire = math.acos(printed["reference_diameter_mm"] / 2 * math.cos(transverse) / found.centre_radius)
    assert math.degrees(lead_angle) == pytest.approx(printed["lead_angle_deg"], abs=5e-7)
    assert math.degrees(transverse) == pytest.approx(printed["transverse_pressure_angle_deg"], abs=5e-6)
    assert _involute(transverse) == pytest.approx(printed["involute_of_transverse_pressure_angle"], abs=5e-7)
    # The table goes on from rounded figures here: one unit of its last place.
    assert _involute(at_wire) == pytest.approx(printed["involute_at_wire_centre"], abs=1e-6)
    assert math.degrees(at_wire) == pytest.approx(printed["angle_at_wire_centre_deg"], abs=5e-5)
    assert found.wires == pytest.approx(printed["measurement_over_wires_mm"], abs=5e-5)


def test_balls_of_a_single_thread_lie_half_an_axial_pitch_apart():
    """One thread, two balls: √(4R² + p_x²/4) + d."""
    drive = Drive.load("recess-action-full")
    (found,) = sizes(drive, "pinion", [3.5])
    lead = 2 * math.pi * 1.0 / math.cos(math.radians(3.0))
    assert found.size == pytest.approx(math.hypot(2 * found.centre_radius, lead / 2) + 3.5, abs=1e-9)


def _resting_between_straight_edges(ball):
    """Centre radius of a ball in a ZN groove (one thread, m_n 2, 3° lead angle, 10° edges, half a pitch wide, normal to
    it, but for 8 mm · tan 10° that the pitch line's shift takes), from the formula of its edge alone: the nearest point
    of one flank is half a ball off.
    """
    lead_angle, pressure_angle, half = math.radians(3.0), math.radians(10.0), 0.5 * ball
    width = 0.5 * math.pi - 4.0 * math.tan(pressure_angle)
    apex = math.sqrt(1.0 / math.sin(lead_angle) ** 2 - (width * math.sin(lead_angle)) ** 2)
    apex -= width / math.tan(pressure_angle)
    pitch = 1.0 / math.cos(lead_angle)

    def apart(centre):
        def distance(place):
            along, turn = place
            x = apex + along * math.cos(pressure_angle)
            across = along * math.sin(pressure_angle)
            y, z = -across * math.sin(lead_angle), across * math.cos(lead_angle) + pitch * turn
            point = x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn), z
            return math.dist(point, (centre, 0.0, 0.0))

        start = (centre - apex) / math.cos(pressure_angle), 0.0
        return minimize(distance, start, method="Nelder-Mead", options={"xatol": 1e-12, "fatol": 1e-14}).fun - half

    return brentq(apart, apex + 1.01 * half, apex + 8.0 * half, xtol=1e-12)


@pytest.mark.parametrize("ball", [2.0, *np.random.default_rng(4).uniform(1.0, 5.0, 3)])
def test_a_ball_rests_on_the_tooth_not_on_another_sheet_of_its_surfaces(ball):
    """Neither a tip nor a face of this worm is given, and what contact uses of its flanks faces no other flank; the
    straight edges go on through the axis, where a ball of this size touches both once more.
    """
    (found,) = sizes(Drive.load("recess-action-full"), "pinion", [ball])
    assert found.centre_radius == pytest.approx(_resting_between_straight_edges(ball), abs=1e-8)
    assert (found.contacts[:, 0] > 0.0).all()


def test_a_ball_in_a_wheel_touches_both_flanks_and_cuts_neither(involute):
    """The centre lies in the middle of the space, half a ball from both flanks."""
    (found,) = sizes(involute, "wheel", [6.0])
    distance = np.linalg.norm(found.contacts, axis=1)
    for touched, other in zip(found.contacts, found.contacts[::-1], strict=True):
        assert touched[2] == pytest.approx(-other[2], abs=1e-9)
    assert distance[0] == pytest.approx(distance[1], abs=1e-9)
    middle = found.contacts.mean(axis=0)
    angle = math.atan2(middle[1], middle[0])
    centre = found.centre_radius * np.array([math.cos(angle), math.sin(angle), 0.0])
    assert np.linalg.norm(found.contacts - centre, axis=1) == pytest.approx([3.0, 3.0], abs=1e-9)
    assert angle / (math.pi / 41) % 2 == pytest.approx(0.0, abs=1e-9)  # the tooth stands at half a turn, 41 is odd


def test_the_other_hand_has_the_same_size(involute):
    left = involute.with_(design={"hand": "left"})
    assert sizes(left, "pinion", [6.0])[0].size == pytest.approx(sizes(involute, "pinion", [6.0])[0].size, abs=1e-11)


def test_a_ball_that_does_not_rest_is_an_answer(capsys):
    assert main(["grid", "plain-zi", "--member", "pinion", "--over-balls", "0.5,6", "--json", "-"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["schema"] == "meshwright.size/1"
    small, fits = document["sizes"]
    assert small["size_over_balls_mm"] is None and "root" in small["reason"]
    assert fits["ball_mm"] == 6.0 and fits["size_over_balls_mm"] > 0.0 and fits["reason"] is None


BAD = {
    "neither": (["--member", "wheel"], "neither --lines nor --over-balls"),
    "lines": (["--member", "wheel", "--lines", "1x5"], "--lines 1x5: not NxM"),
    "margin": (["--member", "wheel", "--lines", "3x5", "--margin-percent", "50"], "--margin-percent 50"),
    "tooth": (["--member", "wheel", "--lines", "3x5", "--teeth", "42"], "teeth 1 to 41"),
    "teeth": (["--member", "wheel", "--lines", "3x5", "--teeth", "a"], "--teeth a"),
    "json": (["--member", "wheel", "--lines", "3x5", "--json", "-"], "--json holds sizes"),
}


@pytest.mark.parametrize("kind", BAD)
def test_bad_options_are_refused(kind, capsys):
    arguments, words = BAD[kind]
    assert main(["grid", "plain-zi", *arguments]) == 2
    assert words in capsys.readouterr().err


def test_flanks_that_are_designs_of_their_own_have_no_size_over_balls(capsys):
    assert main(["grid", "face-worm-conical-convex", "--member", "wheel", "--over-balls", "2"]) == 2
    assert "design of its own" in capsys.readouterr().err
